#!/usr/bin/env python3
"""One table of all benchmarks of a run, with the ratios to a plain copy of memory and to the peers.

usage: bench_table.py FOLDER [FILE]      FOLDER: Google Benchmark's JSON files; FILE: .json, else CSV

Benchmarks are named GROUP/NAME. GROUP/memcpy is the copy of the same bytes; the same name in a file whose context
names a peer is the peer's time of the same work.
"""
import csv
import json
import pathlib
import sys

MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
COLUMNS = ("name", "ms", "copies", "peer", "peer_ms", "peer_ratio")


def read(folder):
    """Times in ms by name, of ours and of the peers."""
    ours, peers = {}, {}
    for path in sorted(pathlib.Path(folder).glob("*.json")):
        run = json.loads(path.read_text())
        peer = run["context"].get("peer")
        for entry in run["benchmarks"]:
            if entry.get("run_type") == "aggregate":
                continue
            time = entry["real_time"] * MILLISECONDS[entry["time_unit"]]
            if peer:
                peers[entry["name"]] = (peer, time)
            else:
                ours[entry["name"]] = time
    return ours, peers


def rows(ours, peers):
    for name, time in ours.items():
        copy = ours.get(name.split("/")[0] + "/memcpy")
        peer, peer_time = peers.get(name, ("", None))
        yield {"name": name, "ms": time, "copies": time / copy if copy else None, "peer": peer,
               "peer_ms": peer_time, "peer_ratio": peer_time / time if peer_time else None}


def text(value):
    if value is None:
        return ""
    return value if isinstance(value, str) else f"{value:.4g}"


def main():
    table = list(rows(*read(sys.argv[1])))
    lines = [("benchmark", "ms", "in copies", "peer", "peer ms", "peer / ours")]
    lines += [tuple(text(row[column]) for column in COLUMNS) for row in table]
    widths = [max(len(line[i]) for line in lines) for i in range(len(COLUMNS))]
    for line in lines:
        cells = [line[i].ljust(widths[i]) if i in (0, 3) else line[i].rjust(widths[i])
                 for i in range(len(COLUMNS))]
        print("  ".join(cells).rstrip())
    if len(sys.argv) > 2:
        output = pathlib.Path(sys.argv[2])
        aside = output.with_name(output.name + ".part")
        if output.suffix == ".json":
            aside.write_text(json.dumps(table, indent=1) + "\n")
        else:
            with open(aside, "w", newline="") as file:
                writer = csv.DictWriter(file, COLUMNS)
                writer.writeheader()
                writer.writerows(table)
        aside.replace(output)


if __name__ == "__main__":
    main()
