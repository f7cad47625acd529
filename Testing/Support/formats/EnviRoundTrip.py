"""ENVI images against Spectral Python, both directions, to the last bit.

usage: EnviRoundTrip.py PATH_OF_FormatJobs

Every interleave x data type x byte order. Exit status 77 (skipped) without numpy or spectral.
"""
import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from spectral.io import envi
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

LINES, SAMPLES, BANDS = 7, 5, 19
TYPES = ["uint8", "int16", "int32", "float32", "float64", "uint16", "uint32", "int64", "uint64"]
CASES = [(interleave, name, order)
         for interleave in ("bsq", "bil", "bip") for name in TYPES for order in (0, 1)]


def cube(name, rng):
    """Random values with both ends of the type; integers stay below 2^53, which a double holds."""
    shape = (LINES, SAMPLES, BANDS)
    kind = np.dtype(name)
    if kind.kind == "f":
        values = rng.standard_normal(shape).astype(kind)
        values[0, 0, :6] = [np.nan, np.inf, -np.inf, np.finfo(kind).max, np.finfo(kind).tiny / 4, -0.0]
        return values
    low = max(np.iinfo(kind).min, -2**53)
    high = min(np.iinfo(kind).max, 2**53)
    values = rng.integers(low, high, size=shape, dtype=kind, endpoint=True)
    values[0, 0, :2] = [low, high]
    return values


def same(a, b):
    return a.shape == b.shape and a.tobytes() == b.tobytes()


def main(program):
    rng = np.random.default_rng(20230123)
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        def path(stem, *case):
            return os.path.join(folder, stem + "-".join(map(str, case)))

        cubes, jobs = {}, []
        for case in CASES:
            interleave, name, order = case
            cubes[case] = cube(name, rng)
            envi.save_image(path("theirs-", *case) + ".hdr", cubes[case], dtype=np.dtype(name),
                            interleave=interleave, byteorder=order, ext="img")
            jobs.append(f"read {path('theirs-', *case)}.hdr {path('read-', *case)}")
            cubes[case].astype("<f8").tofile(path("values-", *case))
            jobs.append(f"write {path('values-', *case)} {path('ours-', *case)}.img "
                        f"{SAMPLES} {LINES} {BANDS} {interleave} {name} {order}")
        with open(path("jobs"), "w") as out:
            out.write("\n".join(jobs))
        subprocess.run([program, path("jobs")], check=True)

        for case in CASES:
            expected = cubes[case]
            read = np.fromfile(path("read-", *case), "<f8").reshape(expected.shape)
            if not same(read.astype(expected.dtype), expected):
                failures.append(("read", case))
            image = envi.open(path("ours-", *case) + ".hdr")
            back = np.asarray(image.open_memmap()).astype(expected.dtype)
            if not same(np.ascontiguousarray(back), expected):
                failures.append(("write", case))
            if image.bands.centers != [400 + 12.5 * b for b in range(1, BANDS + 1)]:
                failures.append(("wavelengths", case))
    for failure in failures:
        print("differs:", *failure)
    print(f"{len(CASES)} cases read and written, {len(failures)} differ")
    return 1 if failures else 0


sys.exit(main(sys.argv[1]))
