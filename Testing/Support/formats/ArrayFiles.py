"""Cubes in MAT and HDF5 files against SciPy and h5py, to the last bit.

usage: ArrayFiles.py PATH_OF_FormatJobs

MAT level 5 (compressed and not, every data type, in structures too), HDF5 (every data type, both byte orders,
contiguous and chunked; wavelengths as attributes; a filter that is missing). Exit status 77 (skipped) without numpy,
scipy or h5py.
"""
import os
import subprocess
import sys
import tempfile

try:
    import h5py
    import numpy as np
    import scipy.io
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

ROWS, COLUMNS, BANDS = 11, 13, 5
TYPES = ["u1", "i1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"]


def cube(name, rng):
    """Rows x columns x bands; integers stay below 2^53, which a double holds."""
    shape = (ROWS, COLUMNS, BANDS)
    kind = np.dtype(name)
    if kind.kind == "f":
        values = rng.standard_normal(shape).astype(kind)
        values[0, 0, :3] = [np.nan, np.inf, -0.0]
        return values
    low = max(np.iinfo(kind).min, -2**53)
    high = min(np.iinfo(kind).max, 2**53)
    return rng.integers(low, high, size=shape, dtype=kind, endpoint=True)


def described(path):
    """Files whose wavelengths, or whose error, are known: name -> text."""
    data, nm = np.ones((ROWS, COLUMNS, BANDS)), 400.0 + 50.0 * np.arange(BANDS)
    known = " ".join(f"{value:g}" for value in nm) + " "
    with h5py.File(path("attribute.h5"), "w") as out:
        out.create_dataset("cube", data=data).attrs["wavelengths"] = nm
    with h5py.File(path("root-attribute.h5"), "w") as out:
        out.create_dataset("cube", data=np.moveaxis(data, 2, 0))
        out.attrs["Wavelength"] = nm / 1000
        out.attrs["bands"] = np.arange(BANDS)
    with h5py.File(path("lzf.h5"), "w") as out:
        out.create_dataset("cube", data=data, compression="lzf")
    scipy.io.savemat(path("nested.mat"), {"s": {"image": {"rad": data}, "wave": nm}})
    return {"attribute.h5": known, "root-attribute.h5": known, "nested.mat": known,
            "lzf.h5": path("lzf.h5") + ": dataset 'cube' is compressed by the filter 32000 (lzf), which this HDF5 "
                      "library does not have; expected none, or gzip; write the file anew: h5repack -f GZIP=4"}


def main(program):
    rng = np.random.default_rng(20230123)
    cases, failures = {}, []
    with tempfile.TemporaryDirectory() as folder:
        def path(name):
            return os.path.join(folder, name)

        for name in TYPES:
            for compressed in (False, True):
                file = f"{name}-{compressed}.mat"
                cases[file] = cube(name, rng)
                scipy.io.savemat(path(file), {"cube": cases[file], "note": "a text", "k": 3.0},
                                 do_compression=compressed)
                file = f"struct-{name}-{compressed}.mat"
                cases[file] = cube(name, rng)
                scipy.io.savemat(path(file), {"k": 1.0, "data": {"empty": [], "rad": cases[file], "note": "a text"}},
                                 do_compression=compressed)
            for order in "<>":
                for chunks in (None, (4, 4, 2)):
                    file = f"{name}-{ord(order)}-{chunks is None}.h5"
                    cases[file] = cube(name, rng)
                    with h5py.File(path(file), "w") as out:
                        out.create_dataset("measured/cube", data=cases[file], chunks=chunks,
                                           compression=None if chunks is None else "gzip",
                                           dtype=np.dtype(name).newbyteorder(order))
        with open(path("jobs"), "w") as out:
            texts = described(path)
            out.write("\n".join([f"read {path(file)} {path(file)}.raw" for file in cases] +
                                [f"describe {path(file)} {path(file)}.txt" for file in texts]))
        subprocess.run([program, path("jobs")], check=True)
        for file, expected in cases.items():
            read = np.fromfile(path(file) + ".raw", "<f8").reshape(expected.shape)
            if read.astype(expected.dtype).tobytes() != expected.tobytes():
                failures.append(file)
        for file, expected in texts.items():
            with open(path(file) + ".txt", encoding="utf-8") as text:
                told = text.read()
                if told != expected:
                    failures.append(f"{file}: {told}")
    for failure in failures:
        print("differs:", failure)
    print(f"{len(cases) + len(texts)} files read, {len(failures)} differ")
    return 1 if failures else 0


sys.exit(main(sys.argv[1]))
