"""Writers killed at random moments: under the final name stands the whole file, the one before it, or nothing.

usage: kill_writers.py PATH_OF_FormatJobs FOLDER [KILLS] [SEED]

Each round writes an ENVI image over that of the round before and is killed after a random time, sometimes after it is
done. Then the image, if a header stands there, has to be whole: the old one or the new one, never a mixture. At the end a
round that is not killed has to leave nothing but the image."""

import pathlib
import random
import shutil
import subprocess
import sys
import time

COLUMNS, ROWS, BANDS = 400, 300, 8


def cube(value):
    """Doubles, band interleaved by pixel, all the same: a mixture shows."""
    import struct
    return struct.pack("<d", float(value)) * (COLUMNS * ROWS * BANDS)


def stored(folder):
    """The value of the image; None where there is none; a text that says what is wrong."""
    header, data = folder / "image.hdr", folder / "image.img"
    if not header.exists():
        return None
    if not data.exists():
        return "a header without data"
    text = data.read_bytes()
    if len(text) != 2 * COLUMNS * ROWS * BANDS:
        return f"{len(text)} bytes of data"
    values = {text[i:i + 2] for i in range(0, len(text), 2)}
    return int.from_bytes(values.pop(), "little") if len(values) == 1 else "a mixture of two images"


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    kills = int(sys.argv[3]) if len(sys.argv) > 3 else 40
    chance = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    raw = [folder.parent / f"{folder.name}-{value}.raw" for value in (1, 2)]
    for value, path in enumerate(raw, 1):
        path.write_bytes(cube(value))
    jobs = [folder.parent / f"{folder.name}-{value}.jobs" for value in (1, 2)]
    for path, job in zip(raw, jobs):
        job.write_text(f"write {path} {folder / 'image.img'} {COLUMNS} {ROWS} {BANDS} bsq uint16 0\n", encoding="ascii")

    begin = time.monotonic()
    subprocess.run([program, jobs[0]], check=True)
    whole = time.monotonic() - begin
    counts = {"whole": 0, "none": 0}
    faults = []
    for kill in range(kills):
        process = subprocess.Popen([program, jobs[kill % 2]])
        time.sleep(chance.uniform(0.0, 1.2 * whole))
        process.kill()
        process.wait()
        found = stored(folder)
        if found is None:
            counts["none"] += 1
        elif found in (1, 2):
            counts["whole"] += 1
        else:
            faults.append(f"kill {kill + 1}: {found}")
        parts = [path for path in folder.iterdir() if path.name.startswith(".")]
        if len(parts) > 2:  # of data and header of the last one
            faults.append(f"kill {kill + 1}: {len(parts)} unfinished files")
    subprocess.run([program, jobs[0]], check=True)
    left = sorted(path.name for path in folder.iterdir())
    if left != ["image.hdr", "image.img"] or stored(folder) != 1:
        faults.append(f"after the last run stand {left}")
    for path in raw + jobs:
        path.unlink()
    print("\n".join(faults[:20]) or f"{kills} kills: {counts['whole']} times a whole image, {counts['none']} times none")
    sys.exit(1 if faults else 0)


main()
