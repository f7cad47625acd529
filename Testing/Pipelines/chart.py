"""`chart` on a real photograph of a chart, by its corners and by search, against labels that were drawn by hand."""

import csv
import os
import pathlib
import subprocess
import sys

import numpy as np

faults = []

# Outer corners of the corner patches, read off the picture: first patch, end of the first row, last patch, start of the last.
CORNERS = ("33,30", "380,31", "363,248", "49,243")


def labels(path):
    """Gray values as 0..1."""
    from matplotlib import pyplot
    image = pyplot.imread(path)
    return image if image.ndim == 2 else image[:, :, 0]


def inner(drawn):
    """The labels without six pixels at each patch's edge, where the chart's black frame shines in."""
    for _ in range(6):
        same = np.ones(drawn.shape, bool)
        for axis in (0, 1):
            for step in (-1, 1):
                same &= np.roll(drawn, step, axis) == drawn
        drawn = np.where(same, drawn, 0)
    return drawn


def check_responses(rows, capture, drawn, options):
    """Against the means of the pixels that were labelled by hand."""
    from PIL import Image
    names = [name for name in rows[0] if name.startswith("C") and name[1:].isdigit()]
    labelled = inner(drawn)
    for name in names:
        pixels = np.array(Image.open(capture / f"channel_{name[1:]}nm.tif"))
        off = [abs(float(row[name]) / pixels[labelled == int(row["label"])].mean() - 1.0) for row in rows]
        if not (np.mean(off) < 0.01 and max(off) < 0.03):
            faults.append(f"{options or 'search'}: {name} is {100 * np.mean(off):.1f} % off on average, {100 * max(off):.1f} % at most")


def run(launcher, capture, output, *options):
    done = subprocess.run([launcher, "chart", "--image", *sorted(map(str, capture.glob("channel_*.tif"))), "--chart",
                           "colorchecker", "--reference", str(capture / "patches.csv"), "--output", str(output), *options],
                          check=False, capture_output=True, text=True)
    if done.returncode != 0:
        print(done.stdout, done.stderr)
        sys.exit(1)
    found = np.rint(labels(output / "labels.png") * 65535).astype(int)
    drawn = np.rint(labels(capture / "labels.png") * 255).astype(int)
    for patch in range(1, 25):
        inside = drawn[found == patch]
        if inside.size == 0 or (inside == patch).mean() < 0.9 or ((inside != patch) & (inside != 0)).any():
            faults.append(f"{options or 'search'}: patch {patch} is not where it was drawn")
    with open(output / "chart.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if len(rows) != 24 or "R400" not in rows[0] or "C400" not in rows[0]:
        faults.append(f"chart.csv has {len(rows)} rows and the columns {list(rows[0])[:12]} ..")
    else:
        check_responses(rows, capture, drawn, options)
    for name in ("overlay.png", "report.html"):
        if not (output / name).is_file():
            faults.append(f"no {name}")


def main():
    launcher, output = sys.argv[1], pathlib.Path(sys.argv[2])
    data = os.environ.get("MULTISPECTRAL_DATA")
    if not data:
        print("skipped: MULTISPECTRAL_DATA is not set")
        sys.exit(77)
    capture = pathlib.Path(data) / "filterwheel-cc24"
    run(launcher, capture, output / "search")
    run(launcher, capture, output / "corners", "--corners", *CORNERS)
    print("\n".join(faults) or "the chart is found where it was drawn")
    sys.exit(1 if faults else 0)


main()
