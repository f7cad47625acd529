#!/usr/bin/env python3
"""One table of all benchmarks of a run, beside their peers of the same run and what is aimed at.

usage: bench_table.py FOLDER [FILE]      FOLDER: Google Benchmark's JSON files; FILE: .json, else CSV

Columns: name; value in unit (ms, or Mitems/s where the benchmark counts pixels or pairs); peer and peer_value, the same work
by another program or the plain way (a copy of the bytes is the peer "memcpy"), in processor time, so that a busy machine
counts less, but the group "two threads" in real time; ratio, how many times as fast as the peer; limit, the least ratio
aimed at (limits.csv). A benchmark has a row for each of its peers.

Benchmarks are named GROUP/NAME. The names in PEERS are peers of all others of their group; the same name in a file whose
context names a peer, or in an entry that names one, is that peer's time.
"""
import csv
import json
import pathlib
import sys

MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
COLUMNS = ("name", "value", "unit", "peer", "peer_value", "ratio", "limit")
PEERS = {"memcpy": "memcpy", "copy of the reflectance": "memcpy", "Little CMS": "Little CMS",
         "plain Eigen product": "Eigen", "by a reflectance image": "reflectance image", "sorting a copy": "sorting a copy"}
LIMITS = pathlib.Path(__file__).resolve().with_name("limits.csv")


def read(folder):
    """Benchmarks by name: ours, and those of peers with the peer's name."""
    ours, peers = {}, {}
    for path in sorted(pathlib.Path(folder).glob("*.json")):
        run = json.loads(path.read_text())
        peer = run["context"].get("peer")
        for entry in run["benchmarks"]:
            if entry.get("run_type") == "aggregate" or entry.get("error_occurred"):
                continue
            time = entry["cpu_time"] * MILLISECONDS[entry["time_unit"]]
            if entry.get("peer", peer):
                peers.setdefault(entry["name"], []).append((entry.get("peer", peer), time))
            else:
                ours[entry["name"]] = time, entry.get("items_per_second")
    return ours, peers


def limits(path=LIMITS):
    """The least ratios by name and peer; versions of peers do not count."""
    with open(path, newline="") as file:
        return {(row["name"], row["peer"]): float(row["limit"]) for row in csv.DictReader(file)}


def rows(ours, peers, aims):
    known = set()
    for name, (time, items) in ours.items():
        group, _, own = name.partition("/")
        if own in PEERS:
            continue
        beside = [(label, ours[f"{group}/{other}"][0]) for other, label in PEERS.items() if f"{group}/{other}" in ours]
        beside += peers.get(name, [])
        for peer, peer_time in beside or [("", None)]:
            ratio = peer_time / time if peer_time else None
            value = items / 1e6 if items else time
            aim = next(((key, limit) for key, limit in aims.items() if key[0] == name and peer.startswith(key[1])), None)
            if aim:
                known.add(aim[0])
            yield {"name": name, "value": value, "unit": "Mitems/s" if items else "ms", "peer": peer,
                   "peer_value": None if ratio is None else value / ratio if items else peer_time, "ratio": ratio,
                   "limit": aim[1] if aim else None}
    for name, peer in aims.keys() - known:
        print(f"bench_table.py: note: no figure for the limit of {name} beside {peer}", file=sys.stderr)


def text(value):
    if value is None:
        return ""
    return value if isinstance(value, str) else f"{value:.4g}"


def missed(row):
    return row["limit"] is not None and row["ratio"] < row["limit"]


def main():
    table = list(rows(*read(sys.argv[1]), limits()))
    lines = [COLUMNS] + [tuple(text(row[column]) for column in COLUMNS) for row in table]
    widths = [max(len(line[i]) for line in lines) for i in range(len(COLUMNS))]
    for line, row in zip(lines, [None] + table):
        cells = [cell.rjust(width) if column in ("value", "peer_value", "ratio", "limit") else cell.ljust(width)
                 for cell, width, column in zip(line, widths, COLUMNS)]
        print("  ".join(cells).rstrip() + ("  below the limit" if row and missed(row) else ""))
    below = sum(map(missed, table))
    print(f"{len([row for row in table if row['limit'] is not None])} limits, {below} not reached")
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
