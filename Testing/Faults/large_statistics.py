"""Error statistics over a cube that no memory holds, from every STRIDE-th pixel of every STRIDE-th row, by several ranks.

usage: large_statistics.py FOLDER GIB STRIDE MOST RANKS...     for example /tmp/large 64 8 1024 1 4

The sparse cube of Testing/Pipelines/large_cube.py: swatches between zeros. Reader, calibration, estimate, error maps and their
summary run in one pipeline under MPI. Prints the times and the largest resident set of a rank in MiB; exit status 1 where
it is above MOST, where the ranks' statistics differ, or where they are not of the swatches' pixels. Deletes the files.
MULTISPECTRAL_ROOT and MULTISPECTRAL_PLUGIN as in the test suite."""

import math
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "Pipelines"))
import large_cube  # noqa: E402


def pixels_of_swatches(side, stride):
    def within(begin):
        return sum(1 for place in range(begin, begin + large_cube.SWATCH) if place % stride == 0)
    count, last = 0, large_cube.SWATCHES - 1
    for n in range(large_cube.SWATCHES):
        x = (side - large_cube.SWATCH) * (n * 5 % large_cube.SWATCHES) // last
        y = (side - large_cube.SWATCH) * n // last
        count += within(x) * within(y)
    return count


def statistics(folder, stride, output):
    """On each rank, in pvbatch."""
    sys.path.insert(0, os.path.join(os.environ["MULTISPECTRAL_ROOT"], "Plugin", "Scripts"))
    from support import command, pipeline
    pipeline.load_plugin()
    stride = int(stride)
    image = pipeline.create("SpectralImageReader", FileNames=[f"{folder}/cube.hdr"], Preview=0, Stride=[stride, stride])
    labels = pipeline.create("LabelImageReader", FileName=f"{folder}/labels.hdr", Stride=[stride, stride])
    chart, patches = (pipeline.create("SampleTableReader", FileName=f"{folder}/{name}.csv") for name in ("chart", "patches"))
    fit = pipeline.create("ReflectanceCalibration", Input=chart)
    estimate = pipeline.create("ReflectanceEstimation", Input=image, ReflectanceTransform=fit[0])
    reference = pipeline.create("PatchReferenceImage", Input=labels, PatchTable=patches)
    errors = pipeline.create("CIEDE2000Evaluator", Input=estimate, Reference=reference)
    pipeline.save_table(pipeline.create("ErrorSummary", Input=errors), output)
    with open(f"{output}.{command.rank()}", "w", encoding="ascii") as file:
        print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024, file=file)


def main():
    folder, size, stride, most = pathlib.Path(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    side = math.isqrt(round(size * 2**30) // (2 * large_cube.CHANNELS))
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    as_root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
    faults, tables = [], set()
    try:
        large_cube.write_cube(folder, side)
        large_cube.write_tables(folder)
        print(f"{side} x {side} x {large_cube.CHANNELS} uint16, {(folder / 'cube.img').stat().st_size / 2**30:.2f} GiB, "
              f"every {stride}th pixel of every {stride}th row")
        for ranks in sys.argv[5:]:
            output = folder / f"summary-{ranks}.csv"
            start = time.monotonic()
            subprocess.run(["mpirun", "-q", *as_root, "--oversubscribe", "-np", ranks, "pvbatch", "--symmetric", __file__,
                            "--rank", folder, str(stride), output], check=True)
            used = max(int((folder / f"{output.name}.{rank}").read_text()) for rank in range(int(ranks)))
            print(f"{ranks} ranks: {time.monotonic() - start:.0f} s, at most {used} MiB a rank", flush=True)
            if used > most:
                faults.append(f"{ranks} ranks: {used} MiB, at most {most} were allowed")
            tables.add(output.read_text(encoding="utf-8"))
        print(*tables, sep="\n", end="")
        expected = pixels_of_swatches(side, stride)
        if len(tables) != 1:
            faults.append("the ranks' statistics differ")
        if not all(f",{expected}" in table for table in tables):
            faults.append(f"expected statistics over {expected} pixels")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    if sys.argv[1] == "--rank":
        statistics(*sys.argv[2:])
    else:
        main()
