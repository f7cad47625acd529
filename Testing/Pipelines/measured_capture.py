"""The diagnosis of real measurements: a camera fitted to one medium, the answers to another."""

import csv
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).parent


def gap_of(folder):
    """rms of real minus simulated, by the formula of the capture."""
    def rows(name):
        with open(folder / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    camera = rows("camera.csv")
    dark = json.loads((folder / "capture.json").read_text(encoding="utf-8"))["dark"]
    channels = [name for name in camera[0] if name != "wavelength"]
    squares = []
    for sample in rows("samples.csv"):
        for k, channel in enumerate(channels):
            simulated = dark[k] + sum(float(curve[channel]) * float(sample[f"R{curve['wavelength']}"])
                                      for curve in camera)
            squares.append((float(sample[channel]) - simulated) ** 2)
    return math.sqrt(sum(squares) / len(squares))


def main():
    launcher, pvbatch, output = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    data = os.environ.get("MULTISPECTRAL_DATA")
    if not data:
        print("skipped: MULTISPECTRAL_DATA is not set")
        sys.exit(77)
    shutil.rmtree(output, ignore_errors=True)
    faults = []
    for chart, target in (("paper", "cotton"), ("cotton", "paper")):
        folder = output / f"{chart}-{target}"
        tables = [pathlib.Path(data) / "hkpolyu" / f"{name}.csv" for name in (chart, target)]
        subprocess.run([pvbatch, HERE / "fit_capture.py", *tables, folder / "capture"], check=True)
        subprocess.run([launcher, "diagnose", folder / "capture", "--output", folder / "out"], check=True)
        report = json.loads((folder / "out" / "report.json").read_text(encoding="utf-8"))
        expected = gap_of(folder / "capture")
        before = report["gap"]["rms_before"]
        if abs(before - expected) > 1e-6 * expected:
            faults.append(f"{chart}, {target}: rms_before {before}, by the formula {expected}")
        if not report["gap"]["rms_after"] < before:
            faults.append(f"{chart}, {target}: held-out rms {report['gap']['rms_after']} after, {before} before")
        for words in ("No noise model and one reading a sample", "One medium only", "No positions",
                      "No capture order"):
            if not any(words in note for note in report["notes"]):
                faults.append(f"{chart}, {target}: nothing is said about '{words}'")
    print("\n".join(faults) or "as the formula says")
    sys.exit(1 if faults else 0)


main()
