"""`estimate` on a real filter-wheel capture: calibrated on half of the patches, judged on the other half."""

import csv
import os
import pathlib
import subprocess
import sys

FILES = ("rgb.png", "error-rms.png", "error-dE00-D65.png", "error-dE00-F2.png", "reflectance.exr",
         "reflectance-transform.csv", "patches.csv", "errors-of-patches.csv",
         "errors-of-pixels.csv", "state.pvsm", "report.html")


def main():
    launcher, output = sys.argv[1], pathlib.Path(sys.argv[2])
    data = os.environ.get("MULTISPECTRAL_DATA")
    if not data:
        print("skipped: MULTISPECTRAL_DATA is not set")
        sys.exit(77)
    capture = pathlib.Path(data) / "filterwheel-cc24"
    subprocess.run([launcher, "estimate", "--image", *map(str, capture.glob("channel_*.tif")),
                    "--labels", str(capture / "labels.png"), "--patches", str(capture / "patches.csv"),
                    "--output", str(output)], check=True)
    faults = [f"no {name}" for name in FILES if not (output / name).is_file()]
    with open(output / "errors-of-patches.csv", newline="", encoding="utf-8") as file:
        rows = {(row["metric"], row["illuminant"]): row for row in csv.DictReader(file)}
    # The mean spectrum of the chart as an estimate for all patches has an rms of about 0.2.
    if not 0.0 < float(rows["rms", ""]["mean"]) < 0.1:
        faults.append(f"rms of the held-out patches is {rows['rms', '']['mean']}")
    if int(float(rows["dE00", "D65"]["count"])) != 12:
        faults.append(f"{rows['dE00', 'D65']['count']} patches were held out, expected 12")
    print("\n".join(faults) or "the held-out half is estimated")
    sys.exit(1 if faults else 0)


main()
