"""The commands give the same tables, images and reports however they are run.

usage: same_bytes.py LAUNCHER FOLDER [all | WAY...]

Without a way: the demo with threads, and on two ranks of one thread. WAY is a name of WAYS below; 'all' is every way
that this machine has, over JOBS, and the tests of the filters in pieces where the build has them. It takes a quarter of
an hour and builds the plugin with a second compiler. Prints a table (Documentation/Trust.md). Exit status 1 where a way
that has to give the same bytes does not."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(os.environ.get("MULTISPECTRAL_ROOT") or pathlib.Path(__file__).resolve().parents[2])
FORCE = pathlib.Path(__file__).resolve().parent / "force_target.cpp"
COMPARED = (".csv", ".exr", ".img", ".hdr", ".json", ".html")
# Name: environment, options, relative difference of numbers that is allowed. The first is what the others are compared with.
WAYS = {
    "threads": ({}, [], 0.0),
    "one thread": ({"VTK_SMP_BACKEND_IN_USE": "Sequential"}, [], 0.0),
    "STDThread, 1 thread": ({"VTK_SMP_MAX_THREADS": "1"}, [], 0.0),
    "STDThread, 3 threads": ({"VTK_SMP_MAX_THREADS": "3"}, [], 0.0),
    "STDThread, 8 threads": ({"VTK_SMP_MAX_THREADS": "8"}, [], 0.0),
    "2 ranks": ({}, ["--ranks", "2"], 0.0),
    "2 ranks, one thread": ({"VTK_SMP_BACKEND_IN_USE": "Sequential"}, ["--ranks", "2"], 0.0),
    "3 ranks": ({}, ["--ranks", "3"], 0.0),
    "4 ranks": ({}, ["--ranks", "4"], 0.0),
    "Highway: no vector instructions": ({"TARGET": "HWY_EMU128"}, [], 0.0),
    "Highway: SSSE3": ({"TARGET": "HWY_SSSE3"}, [], 0.0),
    "Highway: SSE4": ({"TARGET": "HWY_SSE4"}, [], 0.0),
    "Highway: AVX2": ({"TARGET": "HWY_AVX2"}, [], 0.0),
    "Highway: AVX-512": ({"TARGET": "HWY_AVX3"}, [], 0.0),
    # The C library chooses its exp, log, pow and sin by the processor; these have the last bit their own way.
    "C library without FMA": ({"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2_Usable,-FMA_Usable,-AVX2,-FMA,-FMA4"}, [], 1e-6),
    "GCC instead of Clang": ({"CXX": "g++", "CC": "gcc"}, [], 1e-6),
}
IN_EVERY_TEST = ("threads", "2 ranks, one thread")
DEMO = {"demo": ["demo"]}
JOBS = {
    **DEMO,
    "scene": ["scene", "fabric", "--size", "160x120"],
    "camera": ["camera", "--samples", ROOT / "Data/Samples/demo-chart.csv", "--fit", "--draws", "20"],
    "simulated": ["camera", "--scene", "SCENE", "--camera", ROOT / "Data/Captures/demo-warm-camera/camera.csv"],
}


def force_target(folder, target):
    """A library to be loaded first, which leaves Highway this instruction set; None where this processor lacks it."""
    library = folder / f"{target}.so"
    subprocess.run(["c++", "-shared", "-fPIC", f"-DTARGET={target}", FORCE, "-o", library, "-lhwy"], check=True)
    known = subprocess.run(["true"], env={**os.environ, "LD_PRELOAD": str(library)}).returncode == 0
    return str(library) if known else None


def run(launcher, folder, way, jobs):
    """Why it could not be run, or an empty text."""
    environment, options, _ = WAYS[way]
    environment = {**os.environ, "VTK_SMP_BACKEND_IN_USE": "STDThread", **environment}
    target = environment.pop("TARGET", None)
    if target:
        library = force_target(folder, target)
        if library is None:
            return "this processor does not have it"
        environment["LD_PRELOAD"] = library
    if "CXX" in environment:
        if not shutil.which(environment["CXX"]):
            return f"there is no {environment['CXX']}"
        environment["MULTISPECTRAL_BUILD"] = str(folder / "build with another compiler")
    output = folder / way
    shutil.rmtree(output, ignore_errors=True)
    for job, arguments in jobs.items():
        arguments = [output / "scene/reflectance.img" if part == "SCENE" else part for part in arguments]
        done = subprocess.run([launcher, *arguments, "--output", output / job, *options], env=environment,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            sys.exit(f"{way}: {job}: status {done.returncode}: {done.stderr.strip()}")
    return ""


def pixels(path):
    """Of an image, by the project's own reader."""
    sys.path.insert(0, str(ROOT / "build/plugin/python"))
    import multispectral
    from vtkmodules.util.numpy_support import vtk_to_numpy
    reader = multispectral.vtkSpectralImageReader()
    reader.AddFileName(str(path))
    reader.Update()
    data = reader.GetOutput().GetPointData()
    return [vtk_to_numpy(data.GetArray(i)).astype(float).ravel() for i in range(data.GetNumberOfArrays())]


def largest_difference(a, b):
    """Of the numbers of two files, relative to the largest of its column or image; None where their text differs."""
    if a.suffix in (".exr", ".img"):
        return max(float(abs(x - y).max() / abs(x).max()) for x, y in zip(pixels(a), pixels(b)))
    split = re.compile(r"[,:\[\]{}\s]+")
    cells = [split.split(path.read_text(encoding="utf-8")) for path in (a, b)]
    if len(cells[0]) != len(cells[1]):
        return None
    largest, scale = 0.0, 0.0
    for first, second in zip(*cells):
        try:
            x, y = float(first), float(second)
        except ValueError:
            if first != second:
                return None
            continue
        scale = max(scale, abs(x)) if abs(x) < 100 else scale  # wavelengths and counts are no scale
        largest = max(largest, abs(x - y))
    return largest / (scale or 1.0)


def compare(first, other, files, tolerance):
    """In words, and whether that is as it should be."""
    differing = [path for path in files if not (other / path).exists() or (first / path).read_bytes() != (other / path).read_bytes()]
    if not differing:
        return f"the same bytes in all {len(files)} files", True
    if not tolerance:
        return f"{len(differing)} of {len(files)} files differ: " + ", ".join(map(str, differing)), False
    apart = {path: largest_difference(first / path, other / path) if (other / path).exists() else None for path in differing}
    beyond = [f"{path} ({'text' if size is None else f'{size:.1e}'})" for path, size in apart.items()
              if size is None or size > tolerance]
    within = max((size for size in apart.values() if size is not None and size <= tolerance), default=0.0)
    return (f"the same bytes in {len(files) - len(differing)} of {len(files)} files, the others within {within:.0e}"
            + (f"; beyond {tolerance:.0e}: {', '.join(beyond)}" if beyond else ""), not beyond)


def pieces():
    """The unit tests that take an image in pieces, where they are built."""
    programs = sorted({*ROOT.glob("build/plugin/bin/Test*"), *ROOT.glob("build/plugin/Filters/Kernels/*/Test*")})
    passed = 0
    for program in filter(lambda path: os.access(path, os.X_OK) and path.is_file() and not path.suffix, programs):
        done = subprocess.run([program, "--gtest_filter=*Piece*"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        if done.returncode:
            return f"fails in {program.name}", False
        passed += int(re.search(r"PASSED *\] (\d+) test", done.stdout)[1])
    return f"the same bytes in {passed} tests of filters and kernels", passed > 0


def main():
    launcher, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    everything = sys.argv[3:] == ["all"]
    jobs = JOBS if len(sys.argv) > 3 else DEMO
    ways = list(WAYS) if everything else sys.argv[3:] or list(IN_EVERY_TEST)
    ways = ["threads"] + [way for way in ways if way != "threads"]
    folder.mkdir(parents=True, exist_ok=True)
    right = True
    for way in ways:
        reason = run(launcher, folder, way, jobs)
        first = folder / "threads"
        files = [path.relative_to(first) for path in sorted(first.rglob("*")) if path.suffix in COMPARED]
        if len(files) < 10:
            sys.exit(f"the demo wrote only {len(files)} tables and images")
        if way != "threads":
            text, good = (f"not measured: {reason}", True) if reason else \
                compare(first, folder / way, files, WAYS[way][2])
            right = right and good
            print(f"| {way} | {text} |", flush=True)
    if everything and (ROOT / "build/plugin/bin").is_dir():
        text, good = pieces()
        right = right and good
        print(f"| pieces | {text} |", flush=True)
    sys.exit(0 if right else 1)


main()
