"""`scene` and `camera --scene`: files, the same bytes under MPI, what a camera without faults sees, bad arguments."""

import csv
import json
import pathlib
import re
import struct
import subprocess
import sys


def run(launcher, *arguments):
    return subprocess.run([launcher, *map(str, arguments)], check=False, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE)


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class Image:
    """An ENVI image of bands interleaved by line."""

    def __init__(self, path, letter):
        header = path.with_suffix(".hdr").read_text(encoding="ascii")
        self.width, self.height, self.bands = (
            int(re.search(rf"{key}\s*=\s*(\d+)", header).group(1)) for key in ("samples", "lines", "bands"))
        data = path.read_bytes()
        self.values = struct.unpack(f"<{len(data) // struct.calcsize(letter)}{letter}", data)

    def pixel(self, x, y):
        start = y * self.bands * self.width + x
        return self.values[start:start + self.bands * self.width:self.width]


def main():
    launcher, output = sys.argv[1], pathlib.Path(sys.argv[2])
    output.mkdir(parents=True, exist_ok=True)
    faults = []

    def done(*arguments):
        result = run(launcher, *arguments)
        if result.returncode != 0:
            sys.exit(result.stderr)

    one, two = output / "one", output / "two"
    scene = ["scene", "chart24", "--size", "90x70", "--texture", "0", "--wavelengths", "400:700:20"]
    done(*scene, "--output", one)
    done(*scene, "--ranks", "2", "--output", two)
    for name in ("reflectance.img", "labels.img", "patches.csv"):
        if (one / name).read_bytes() != (two / name).read_bytes():
            faults.append(f"{name} differs between one rank and two")
    for name in ("reflectance.hdr", "labels.hdr", "scene.png", "report.html"):
        if not (one / name).is_file():
            faults.append(f"no {name}")

    camera = output / "camera"
    camera.mkdir(exist_ok=True)
    (camera / "bench.csv").write_text("wavelength,C1,C2\n" + "".join(
        f"{w},{1 / 16},{0.125 if w < 550 else 0.0}\n" for w in range(400, 701, 20)))
    (camera / "bench.json").write_text(json.dumps({"camera": "bench.csv", "dark": 0.01}))
    look = ["camera", "--scene", one / "reflectance.img", "--camera", camera / "bench.json"]
    done(*look, "--output", output / "seen")
    done(*look, "--ranks", "2", "--output", output / "seen-by-two")
    if (output / "seen" / "responses.img").read_bytes() != (output / "seen-by-two" / "responses.img").read_bytes():
        faults.append("the responses differ between one rank and two")

    labels, seen = Image(one / "labels.img", "B"), Image(output / "seen" / "responses.img", "f")
    patches = rows(one / "patches.csv")
    checked = set()
    for y in range(labels.height):
        for x in range(labels.width):
            label = labels.pixel(x, y)[0]
            if label == 0:
                continue
            checked.add(label)
            patch = patches[label - 1]
            spectrum = [float(patch[f"R{w}"]) for w in range(400, 701, 20)]
            expected = 0.01 + sum(spectrum) / 16, 0.01 + 0.125 * sum(spectrum[:8])
            if max(abs(a - b) for a, b in zip(seen.pixel(x, y), expected)) > 1e-6:
                faults.append(f"patch {label} at {x}, {y}: {seen.pixel(x, y)}, expected {expected}")
    if len(checked) != 24:
        faults.append(f"{len(checked)} of 24 patches are labelled")

    for arguments, status, text in (
            (["scene", "chart24", "--size", "10x10"], 1, "6 x 4 patches need at least 39 x 27"),
            (["scene", "chart24", "--size", "wide"], 2, "'wide' is not of the form 768x512"),
            (["scene", "meadow"], 2, "invalid choice: 'meadow'"),
            (["scene", "fabric", "--interreflection", "0.9"], 1, "expected a value from 0 to 0.5"),
            ([*look, "--fit"], 2, "--scene needs --camera and cannot be fitted to"),
            (["camera", "--scene", one / "none.img", "--camera", camera / "bench.json"], 1, "no such file")):
        result = run(launcher, *arguments, "--output", output / "wrong")
        if result.returncode != status or text not in result.stderr or result.stderr.count("\n") != 1:
            faults.append(f"{arguments}: status {result.returncode}, {result.stderr!r}")
    for fault in faults[:20]:
        print(fault)
    sys.exit(1 if faults else 0)


main()
