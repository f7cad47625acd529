#!/usr/bin/env python3
"""The table of benchmarks from files whose figures are known.

usage: test_bench_table.py
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

TABLE = pathlib.Path(__file__).resolve().with_name("bench_table.py")


def benchmark(name, cpu_time, unit="ms", **more):
    return {"name": name, "cpu_time": cpu_time, "real_time": 7 * cpu_time + 1, "time_unit": unit, **more}


def main():
    faults = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "ours.json").write_text(json.dumps({"context": {}, "benchmarks": [
            benchmark("CIEDE2000/float blocks", 2e6, "ns", items_per_second=50e6),
            benchmark("CIEDE2000/Little CMS", 40e6, "ns", items_per_second=2.5e6),
            benchmark("image/memcpy", 100), benchmark("image/BSQ", 200),
            benchmark("image/BSQ", 999, run_type="aggregate"), benchmark("sRGB/float blocks", 3, "us"),
            benchmark("two threads/Filter", 60), benchmark("two threads/Filter", 108, peer="one thread")]}))
        (folder / "peer.json").write_text(json.dumps({"context": {"peer": "Spectral Python 1"}, "benchmarks": [
            benchmark("image/BSQ", 0.5, "s")]}))
        expected = [
            {"name": "CIEDE2000/float blocks", "value": 50.0, "unit": "Mitems/s", "peer": "Little CMS", "peer_value": 2.5,
             "ratio": 20.0, "limit": 30.0},
            {"name": "image/BSQ", "value": 200.0, "unit": "ms", "peer": "memcpy", "peer_value": 100.0, "ratio": 0.5,
             "limit": None},
            {"name": "image/BSQ", "value": 200.0, "unit": "ms", "peer": "Spectral Python 1", "peer_value": 500.0,
             "ratio": 2.5, "limit": None},
            {"name": "sRGB/float blocks", "value": 0.003, "unit": "ms", "peer": "", "peer_value": None, "ratio": None,
             "limit": None},
            {"name": "two threads/Filter", "value": 60.0, "unit": "ms", "peer": "one thread", "peer_value": 108.0, "ratio": 1.8,
             "limit": None}]
        results = folder / "results"
        results.mkdir()
        for kind in ("json", "csv"):
            done = subprocess.run([sys.executable, TABLE, folder, results / f"table.{kind}"], text=True, capture_output=True)
            if done.returncode != 0 or "below the limit" not in done.stdout.splitlines()[1] or \
                    "1 limits, 1 not reached" not in done.stdout:
                faults.append(f"{kind}: status {done.returncode}: {done.stdout}{done.stderr}")
        got = json.loads((results / "table.json").read_text())
        if [{key: round(value, 9) if isinstance(value, float) else value for key, value in row.items()}
                for row in got] != expected:
            faults.append(f"the JSON is {got}")
        with open(results / "table.csv", newline="") as file:
            if [row["ratio"] for row in csv.DictReader(file)] != ["20.0", "0.5", "2.5", "", "1.8"]:
                faults.append("the CSV has other ratios")
    print("\n".join(faults) or "the table of benchmarks is right")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
