"""A cube that is larger than memory goes through estimation to an error map on disk, on one rank and on several.

Arguments: the launcher, a folder for the files, GiB of the cube (0.01 for a test), most MiB that a rank may hold
(resident set), numbers of ranks. The cube is a sparse ENVI file of uint16, BIL, 64 channels, with measured swatches
in some corners and zeros, which take no room on the disk, between them. Prints the times and the peak resident sets;
all runs have to give the same bytes. The files are deleted at the end.
"""

import hashlib
import math
import os
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import time

CHANNELS = 64
BANDS = range(400, 701, 10)
SWATCH = 24  # pixels a side
SWATCHES = 12
WHITE = 10000


def wavelength(channel):
    return 400.0 + 300.0 * channel / (CHANNELS - 1)


def spectrum(number):
    """A smooth reflectance: a level and a slope of its own, and a broad peak."""
    chance = random.Random(number)
    level, height, center = chance.uniform(0.1, 0.3), chance.uniform(0.1, 0.5), chance.uniform(420, 680)
    return lambda nm: level + height * math.exp(-((nm - center) / 60.0) ** 2)


def response(reflectance, channel):
    """Each channel sees a band of 30 nm."""
    around = [wavelength(channel) + 5.0 * i for i in range(-3, 4)]
    return sum(reflectance(nm) for nm in around) / len(around)


def header(path, side, bands, kind, more=""):
    path.write_text(f"ENVI\nsamples = {side}\nlines = {side}\nbands = {bands}\ndata type = {kind}\n"
                    f"interleave = bil\nbyte order = 0\nheader offset = 0\n{more}")


def write_cube(folder, side):
    """cube.img and labels.img with a swatch at the top left, the bottom right, and in between."""
    header(folder / "cube.hdr", side, CHANNELS, 12, f"reflectance scale factor = {WHITE}\nwavelength units = nm\nwavelength = {{"
           + ", ".join(f"{wavelength(k):.3f}" for k in range(CHANNELS)) + "}\n")
    header(folder / "labels.hdr", side, 1, 12)
    chance = random.Random(1)
    with open(folder / "cube.img", "wb") as cube, open(folder / "labels.img", "wb") as labels:
        cube.truncate(side * side * CHANNELS * 2)
        labels.truncate(side * side * 2)
        for n in range(SWATCHES):
            x = (side - SWATCH) * (n * 5 % SWATCHES) // (SWATCHES - 1)
            y = (side - SWATCH) * n // (SWATCHES - 1)
            seen = [WHITE * response(spectrum(n), k) for k in range(CHANNELS)]
            for row in range(y, y + SWATCH):
                labels.seek((row * side + x) * 2)
                labels.write(struct.pack(f"<{SWATCH}H", *[n + 1] * SWATCH))
                for k in range(CHANNELS):
                    values = [round(seen[k] * chance.uniform(0.99, 1.01)) for _ in range(SWATCH)]
                    cube.seek(((row * CHANNELS + k) * side + x) * 2)
                    cube.write(struct.pack(f"<{SWATCH}H", *values))


def write_tables(folder):
    names = [f"R{nm}" for nm in BANDS]
    with open(folder / "patches.csv", "w") as table:
        print("sample,label," + ",".join(names), file=table)
        for n in range(SWATCHES):
            values = ",".join(f"{spectrum(n)(nm):.6f}" for nm in BANDS)
            print(f"S{n + 1},{n + 1},{values}", file=table)
    with open(folder / "chart.csv", "w") as table:
        channels = [f"C{wavelength(k):.3f}" for k in range(CHANNELS)]
        print("sample," + ",".join(names + channels), file=table)
        for n in range(100, 300):
            values = [spectrum(n)(nm) for nm in BANDS]
            values += [response(spectrum(n), k) for k in range(CHANNELS)]
            print(f"C{n}," + ",".join(f"{value:.6f}" for value in values), file=table)


def run(launcher, folder, ranks):
    """The time of a run in s, and the largest resident set of its processes in MiB."""
    output = folder / f"ranks-{ranks}"
    peaks = folder / f"peaks-{ranks}"
    peaks.mkdir()
    start = time.monotonic()
    # Every process writes down its own peak when it ends: the sum of a group would count shared libraries twice.
    subprocess.run([launcher, "estimate", "--image", folder / "cube.hdr", "--calibration",
                    folder / "chart.csv", "--labels", folder / "labels.hdr", "--patches",
                    folder / "patches.csv", "--output", output, "--method", "pooled", "--ranks",
                    str(ranks)], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "MULTISPECTRAL_PEAKS": str(peaks)})
    used = [int(path.read_text()) // 1024 for path in peaks.iterdir()]
    if len(used) != ranks:
        sys.exit(f"{len(used)} of {ranks} processes wrote down their peak")
    return time.monotonic() - start, max(used)


def digests(folder):
    found = {}
    for path in sorted(folder.iterdir()):
        if path.suffix in (".csv", ".exr", ".img", ".hdr"):
            digest = hashlib.sha256()
            with open(path, "rb") as file:
                for block in iter(lambda: file.read(1 << 24), b""):
                    digest.update(block)
            found[path.name] = digest.hexdigest()
    return found


def main():
    launcher, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    size, most = float(sys.argv[3]), int(sys.argv[4])
    side = math.isqrt(round(size * 2**30) // (2 * CHANNELS))
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    faults, first = [], None
    try:
        write_cube(folder, side)
        write_tables(folder)
        print(f"{side} x {side} x {CHANNELS} uint16, {(folder / 'cube.img').stat().st_size / 2**30:.2f} GiB")
        for ranks in map(int, sys.argv[5:]):
            seconds, used = run(launcher, folder, ranks)
            print(f"{ranks} ranks: {seconds:.0f} s, at most {used} MiB a rank", flush=True)
            if used > most:
                faults.append(f"{ranks} ranks: {used} MiB, at most {most} were allowed")
            output = folder / f"ranks-{ranks}"
            found = digests(output)
            first = first or found
            faults += [f"{ranks} ranks: {name} differs" for name in first if first[name] != found.get(name)]
            if ranks == int(sys.argv[5]):
                print((output / "errors-of-pixels.csv").read_text(), end="")
                map_bytes = (output / "error-maps.img").stat().st_size
                if map_bytes != side * side * 3 * 4:
                    faults.append(f"error-maps.img has {map_bytes} bytes")
            shutil.rmtree(output)
        print(f"{len(first)} files compared")
        if len(first) < 6:
            faults.append(f"only {len(first)} files were written")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
