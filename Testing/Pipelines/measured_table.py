"""`evaluate` on real measurements of two media gives the figures of a separate NumPy program.

The figures (rms mean over 40 draws, and the standard error of a mean over 20 draws) were measured with that program
on the same public data; see Documentation/Reproduction.md."""

import csv
import os
import pathlib
import subprocess
import sys

# (calibration, target, channels): {method: (rms mean, standard error)}
MEASURED = {
    ("paper", "cotton", 16): {"direct": (.0086, 0), "pinv": (.069, .026), "pooled": (.0069, .0001),
                              "r-model": (.0084, .0003), "banded": (.0082, .0005)},
    ("paper", "cotton", 9): {"direct": (.0119, 0), "pinv": (.0139, .0009), "pooled": (.0102, .0001),
                             "r-model": (.0103, .0003), "banded": (.0093, .0002)},
    ("cotton", "paper", 16): {"direct": (.0096, 0), "pinv": (.054, .015), "pooled": (.0072, .0001),
                              "r-model": (.0087, .0003), "banded": (.0085, .0004)},
    ("cotton", "paper", 9): {"direct": (.0147, 0), "pinv": (.0197, .0012), "pooled": (.0131, .0001),
                             "r-model": (.0124, .0002), "banded": (.0116, .0001)},
}
ROUNDING = 0.00005  # of the printed figures


def rms_means(path):
    with open(path, newline="", encoding="utf-8") as file:
        return {row["method"]: float(row["mean"]) for row in csv.DictReader(file)
                if row["metric"] == "rms"}


def main():
    launcher, output = sys.argv[1], pathlib.Path(sys.argv[2])
    data = os.environ.get("MULTISPECTRAL_DATA")
    if not data:
        print("skipped: MULTISPECTRAL_DATA is not set")
        sys.exit(77)
    faults = []
    for (calibration, target, channels), expected in MEASURED.items():
        folder = output / f"{calibration}-{target}-{channels}"
        subprocess.run([launcher, "evaluate", "--draws", "20", "--channels", str(channels),
                        "--calibration", f"{data}/hkpolyu/{calibration}.csv",
                        "--target", f"{data}/hkpolyu/{target}.csv", "--output", str(folder)],
                       check=True)
        means = rms_means(folder / "results.csv")
        for method, (mean, error) in expected.items():
            bound = ROUNDING + (3 * error if error else 0.01 * mean)
            if abs(means[method] - mean) > bound:
                faults.append(f"{calibration} to {target}, {channels} channels, {method}: "
                              f"{means[method]:.4f}, measured {mean:.4f} +- {bound:.4f}")
        best = min(means[method] for method in expected)
        if means["transfer"] > best:
            faults.append(f"{calibration} to {target}, {channels} channels: transfer "
                          f"{means['transfer']:.4f} does not beat {best:.4f}")
        for picture in ("spectra.png", "rms-against-tuning.png", "ab-distribution.png"):
            if not (folder / picture).is_file():
                faults.append(f"{folder}: no {picture}")
    print("\n".join(faults) or "all figures are within three standard errors")
    sys.exit(1 if faults else 0)


main()
