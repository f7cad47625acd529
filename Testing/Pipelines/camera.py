"""`camera`: fits a camera on the demo's chart, keeps it, and simulates it with an effect on the demo's fabric."""

import csv
import json
import pathlib
import re
import subprocess
import sys


def run(launcher, *arguments):
    return subprocess.run([launcher, "camera", *map(str, arguments)], check=False, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def main():
    launcher, output = sys.argv[1], pathlib.Path(sys.argv[2])
    samples = pathlib.Path(launcher).parent / "Data" / "Samples"
    faults = []

    fitted = output / "fitted"
    first = run(launcher, "--samples", samples / "demo-chart.csv", "--fit", "--draws", 10,
                "--output", fitted)
    if first.returncode != 0:
        sys.exit(first.stderr)
    for name in ("camera.json", "camera.csv", "uncertainty.csv", "fit.csv", "channels.csv",
                 "responsivities.png", "difference-channels.png", "samples.png", "report.html"):
        if not (fitted / name).is_file():
            faults.append(f"no {name}")
    page = (fitted / "report.html").read_text(encoding="utf-8")
    for part in ("class='lead'>The simulated camera differs from the real one by rms 0.00", "rms of held-out samples (1 = white)"):
        if part not in page:
            faults.append(f"report.html does not say '{part}'")
    if re.search(r"\bC\d+\b|e-1\d\b", words := re.sub(r"<[^>]*>", " ", page)) or "400 nm" not in words:
        faults.append("report.html names channels as columns, or tells what rounding leaves")
    # The demo's camera has noise of about 0.003 of white: its own chart is predicted as well as that.
    for row in rows(fitted / "difference-channels.csv"):
        if not float(row["rms"]) < 0.01 or abs(float(row["gain"]) - 1.0) > 0.01:
            faults.append(f"channel {row['channel']} of the chart: rms {row['rms']}, gain {row['gain']}")

    effects = output / "effects.json"
    effects.write_text(json.dumps([{"effect": "exposure_gain", "parameters": {"gain": 0.5}}]))
    table = output / "reflectance.csv"
    with open(samples / "demo-fabric.csv", newline="", encoding="utf-8") as file:
        lines = list(csv.reader(file))
    kept = [i for i, name in enumerate(lines[0]) if not (name[0] == "C" and name[1:].isdigit())]
    table.write_text("\n".join(",".join(line[i] for i in kept) for line in lines) + "\n")
    changed = output / "changed"
    second = run(launcher, "--samples", table, "--camera", fitted / "camera.json",
                 "--effects", effects, "--output", changed)
    if second.returncode != 0:
        sys.exit(second.stderr)
    # The ideal camera over one with half the exposure: the line has the slope 2.
    for row in rows(changed / "difference-channels.csv"):
        if abs(float(row["gain"]) - 2.0) > 1e-9 or float(row["rms_around_line"]) > 1e-9:
            faults.append(f"channel {row['channel']} at half exposure: gain {row['gain']}")

    effects.write_text('[{"effect": "ghosts"}]')
    wrong = run(launcher, "--samples", table, "--camera", fitted / "camera.json", "--effects",
                effects, "--output", output / "wrong")
    if wrong.returncode != 1 or "there is no effect of this name" not in wrong.stderr \
            or wrong.stderr.count("\n") != 1:
        faults.append(f"an unknown effect ends with {wrong.returncode}: {wrong.stderr}")
    missing = run(launcher, "--samples", table)
    if missing.returncode != 2 or "give --camera, --fit or both" not in missing.stderr:
        faults.append(f"no camera ends with {missing.returncode}: {missing.stderr}")
    print("\n".join(faults) or "fitted, kept, simulated with an effect")
    sys.exit(1 if faults else 0)


main()
