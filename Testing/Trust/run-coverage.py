#!/usr/bin/env python3
"""How many lines and branches of the kernels and readers the unit tests reach.

usage: run-coverage.py [--rooms=ROOM,...] [CTEST ARGS]

Builds both with GCC's instrumentation in build/coverage, runs the unit tests (or those that CTEST ARGS choose) and prints
a table by folder; build/coverage/files.txt has it by file. With --rooms these rooms of the kernels alone: Spectra,
Colorimetry, Difference, Sampling, Estimation, Camera, Gap. Needs the package gcovr."""

import collections
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "coverage"
FOLDERS = ("Filters/Kernels", "Readers/Formats")


def gcovr(*options):
    return subprocess.run(
        ["gcovr", "-j", str(os.cpu_count()), "--root", ROOT, "--exclude", r".*/Test[^/]*$", "--exclude", r".*TestData.*",
         "--exclude-throw-branches", "--exclude-unreachable-branches",
         *(f"--filter={ROOT}/{folder}/" for folder in FOLDERS), *options, BUILD],
        check=True, capture_output=True, text=True).stdout


def main():
    choice = [argument for argument in sys.argv[1:] if argument.startswith("--rooms=")]
    rooms = choice[-1].partition("=")[2].split(",") if choice else []
    face = ["-DMULTISPECTRAL_FACE=kernels", "-DMULTISPECTRAL_ONLY_ROOMS=" + ";".join(rooms)] if rooms else \
        ["-DMULTISPECTRAL_FACE=formats", "-DMULTISPECTRAL_FUZZ=OFF"]
    targets = ["--target", *(f"Test{room}" for room in rooms)] if rooms else []
    tests = ["-L", f"^({'|'.join(rooms)})$"] if rooms else []
    tests += [argument for argument in sys.argv[1:] if argument not in choice]
    if not shutil.which("gcovr"):
        sys.exit("run-coverage.py: there is no gcovr; install the package gcovr")
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    subprocess.run(["cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", *face, "-DCMAKE_BUILD_TYPE=Debug",
                    "-DMULTISPECTRAL_UNITY=ON", *launcher,
                    "-DCMAKE_CXX_FLAGS_DEBUG=-O1 -DNDEBUG --coverage -fprofile-update=atomic"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", BUILD, *targets], check=True, stdout=subprocess.DEVNULL)
    for old in BUILD.rglob("*.gcda"):
        old.unlink()
    done = subprocess.run(["ctest", "--test-dir", BUILD, "-j", str(os.cpu_count()), "--output-on-failure", *tests],
                          stdout=subprocess.PIPE, text=True)
    print("\n".join(done.stdout.strip().splitlines()[-4:]))
    (BUILD / "files.txt").write_text(gcovr("--branches"), encoding="utf-8")
    found = json.loads(gcovr("--json-summary", "-"))
    folders = collections.defaultdict(lambda: [0, 0, 0, 0])
    for file in found["files"]:
        counts = [file[key] for key in ("line_covered", "line_total", "branch_covered", "branch_total")]
        for name in (os.path.dirname(file["filename"]), "all"):
            folders[name] = [a + b for a, b in zip(folders[name], counts)]
    print(f"{'folder':<44}{'lines':>8}{'reached':>9}{'branches':>10}{'reached':>9}")
    for name, (lines, of_lines, branches, of_branches) in sorted(folders.items(), key=lambda entry: (entry[0] == "all", entry)):
        print(f"{name:<44}{of_lines:>8}{100 * lines / max(1, of_lines):>7.1f} %{of_branches:>10}"
              f"{100 * branches / max(1, of_branches):>7.1f} %")
    sys.exit(done.returncode)


main()
