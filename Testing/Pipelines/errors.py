"""Bad input ends with one clear line on stderr and the exit status of the contract."""

import os
import pathlib
import shutil
import subprocess
import sys

root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
CHART = root / "Data" / "Samples" / "demo-chart.csv"
FABRIC = root / "Data" / "Samples" / "demo-fabric.csv"
IMAGE = sorted((root / "Data" / "Images" / "demo-fabric").glob("channel_*.tif"))
LABELS = root / "Data" / "Images" / "demo-fabric" / "labels.png"
PATCHES = root / "Data" / "Images" / "demo-fabric" / "patches.csv"


def cases(folder):
    def edited(name, change):
        path = folder / name
        lines = CHART.read_text(encoding="utf-8").splitlines()
        path.write_text("\n".join(change(lines)) + "\n", encoding="utf-8")
        return path

    def cell(lines, row, column, text):
        cells = lines[row].split(",")
        cells[column] = text
        return [*lines[:row], ",".join(cells), *lines[row + 1:]]

    text = edited("text.csv", lambda lines: cell(lines, 5, 4, "abc"))
    nan = edited("nan.csv", lambda lines: cell(lines, 5, 4, "nan"))
    ragged = edited("ragged.csv", lambda lines: [*lines[:3], lines[3].rsplit(",", 1)[0], *lines[4:]])
    no_responses = edited("no-responses.csv", lambda lines: [
        ",".join(line.split(",")[:33]) for line in lines])
    truncated = folder / "channel_420nm.tif"
    truncated.write_bytes(IMAGE[1].read_bytes()[:2000])

    yield ["evaluate"], 2, "the following arguments are required: --calibration, --target"
    yield ["evaluate", "--calibration", "a.csv", "--target", FABRIC, "--draws", "0"], 2, \
        "'0' is not a whole number of at least 1"
    yield ["frobnicate"], 2, "there is no command 'frobnicate'"
    yield ["demo", "--ranks", "two"], 2, "--ranks two: expected a whole number of at least 1"
    yield ["evaluate", "--calibration", folder / "none.csv", "--target", FABRIC], 1, "no such file"
    for path, part in ((text, "text.csv:6:"), (nan, "nan.csv:6:"), (ragged, "ragged.csv:4:")):
        yield ["evaluate", "--calibration", path, "--target", FABRIC], 1, part
    yield ["evaluate", "--calibration", no_responses, "--target", FABRIC], 1, "camera responses"
    yield ["evaluate", "--calibration", CHART, "--target", FABRIC, "--tuning", "500"], 1, \
        "500 tuning samples are asked for and the target has 120 samples"
    yield ["evaluate", "--calibration", CHART, "--target", FABRIC, "--methods", "magic"], 1, \
        "there is no estimation method 'magic'"
    yield ["choose", "--calibration", CHART, "--candidates", no_responses], 1, "camera responses"
    yield ["choose", "--calibration", CHART, "--candidates", FABRIC, "--count", "500"], 1, \
        "500 samples are to be chosen from 120"
    book = ["choose", "--calibration", CHART, "--image", *IMAGE]
    yield book, 2, "--image and --labels go together"
    yield [*book, "--labels", LABELS, "--candidates", FABRIC], 2, "give --candidates, or --image with --labels"
    yield [*book, "--labels", CHART], 1, "demo-chart.csv"
    yield [*book, "--labels", LABELS, "--count", "25"], 1, "25 samples are to be chosen from 24"
    yield ["choose", "--calibration", CHART, "--image", *IMAGE[:9], "--labels", LABELS], 1, "9 channels"
    # A lamp that ends within the bands.
    lamp = folder / "short.csv"
    lamp.write_text("wavelength,power\n500,1\n550,1\n600,1\n", encoding="utf-8")
    compared = ["evaluate", "--calibration", CHART, "--target", FABRIC, "--draws", "1"]
    yield [*compared, "--methods", "direct", "--illuminant", lamp], 1, \
        "the curve 'short' covers 500 to 600 nm; expected at least 400 to 700 nm"
    # Fewer samples than a method needs.
    one, few = folder / "one.csv", folder / "few.csv"
    one.write_text("".join(FABRIC.read_text(encoding="utf-8").splitlines(True)[:2]), encoding="utf-8")
    few.write_text("".join(FABRIC.read_text(encoding="utf-8").splitlines(True)[:4]), encoding="utf-8")
    image = ["estimate", "--image", *IMAGE, "--calibration", CHART]
    yield [*image, "--tuning", one, "--method", "transfer"], 1, \
        "there is 1 tuning sample; the method transfer expects at least 2 samples"
    yield [*image, "--tuning", few, "--method", "r-model"], 1, \
        "the R-model has 3 tuning samples for 4 unknowns a band; expected at least 4 samples"
    yield ["estimate", "--image", *IMAGE], 2, "give --calibration"
    yield ["estimate", "--image", *IMAGE[:9], "--calibration", CHART], 1, \
        "the image has 9 channels (400, 420, .., 560 nm), but the reflectance transform has 16 channels"
    yield ["estimate", "--image", IMAGE[0], truncated, *IMAGE[2:], "--calibration", CHART], 1, \
        "channel_420nm.tif"
    yield ["estimate", "--image", *IMAGE, "--labels", CHART, "--patches", PATCHES], 1, "demo-chart.csv"
    yield ["estimate", "--image", *IMAGE, "--white", IMAGE[0], "--calibration", CHART], 1, \
        "1 channels"


def main():
    launcher, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    faults = []
    for arguments, status, part in cases(folder):
        output = folder / "out"
        options = [] if len(arguments) < 2 else ["--output", str(output)]
        done = subprocess.run([launcher, *map(str, arguments), *options], text=True,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        lines = done.stderr.strip().splitlines()
        shown = " ".join(pathlib.Path(str(a)).name for a in arguments[:4])
        if done.returncode != status or len(lines) != 1 or part not in lines[0] \
                or not lines[0].startswith("multispectral: "):
            faults.append(f"{shown}: expected status {status} and one line with '{part}', got "
                          f"{done.returncode} and:\n    " + "\n    ".join(lines[:12]))
    print("\n".join(faults) or "every error is one clear line")
    sys.exit(1 if faults else 0)


main()
