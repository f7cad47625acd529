#!/usr/bin/env python3
"""The work of SpectralImageBenchmark.cpp with Spectral Python: the same files, loaded into memory.

Prints Google Benchmark's JSON, so that both can be laid side by side.
"""
import json
import os
import sys
import tempfile
import time

import numpy as np
import spectral
from spectral.io import envi

SIDE, BANDS, REPEATS = 2048, 16, 5


def write(folder, layout, order):
    """As the benchmark writes them: (31 i + 17 y) mod 4096, i counting the values of a row."""
    i = np.arange(SIDE * BANDS).reshape(1, SIDE, BANDS)
    y = np.arange(SIDE).reshape(SIDE, 1, 1)
    values = ((31 * i + 17 * y) % 4096).astype(np.uint16)
    path = os.path.join(folder, f"{layout}-{order}.hdr")
    envi.save_image(path, values, dtype=np.uint16, interleave=layout, byteorder=order, force=True)
    return path


def best(job):
    """Least real and least processor time in ms."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter(), time.process_time()
        job()
        times.append((time.perf_counter() - start[0], time.process_time() - start[1]))
    return [1e3 * min(values) for values in zip(*times)]


def main():
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for layout in ("bsq", "bil", "bip"):
            for order, suffix in ((0, ""), (1, "_swapped")):
                path = write(folder, layout, order)
                real, cpu = best(lambda: envi.open(path).load(dtype=np.float32))
                results.append({"name": f"image/{layout.upper()}{suffix}", "real_time": real,
                                "cpu_time": cpu, "time_unit": "ms"})
    json.dump({"context": {"peer": "Spectral Python " + spectral.__version__}, "benchmarks": results},
              sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
