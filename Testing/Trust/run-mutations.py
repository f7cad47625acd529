#!/usr/bin/env python3
"""Whether the tests notice faults in the kernels.

usage: run-mutations.py [NUMBER...]

Builds a copy of the kernels and their tests in build/mutations, puts in the faults of mutations.txt one at a time (or
those of these numbers, from 1), and runs the test program that each names. Exit status 1 where a fault goes unnoticed or
the tests fail without one."""

import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "mutations"
SOURCE = BUILD / "source"
ROOMS = "Spectra;Numerics;Colorimetry;Difference;Sampling;Estimation;Camera;Scenes"


def mutations():
    text = (pathlib.Path(__file__).parent / "mutations.txt").read_text(encoding="utf-8")
    blocks = [[line.strip() for line in block.splitlines() if not line.startswith("#")]
              for block in text.split("\n\n")]
    return [block for block in blocks if block]


def copy_sources():
    shutil.rmtree(SOURCE, ignore_errors=True)
    names = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "Filters", "CMake", "CMakeLists.txt", "CMakePresets.json",
                            "Data", "Documentation/CameraEffects.md", "Testing"], check=True, capture_output=True,
                           text=True).stdout
    for name in filter(None, names.split("\0")):
        target = SOURCE / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, target)


def build(*targets):
    """The compiler's last lines where it fails."""
    done = subprocess.run(["cmake", "--build", BUILD / "tree", "--target", *targets], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    return done.stdout[-2000:] if done.returncode else ""


def passes(room):
    return subprocess.run([BUILD / "tree" / "Filters" / "Kernels" / folder_of(room) / f"Test{room}", "--gtest_fail_fast"],
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def folder_of(room):
    return "Scenes" if room == "SceneKernels" else room


def main():
    known = mutations()
    chosen = [int(number) for number in sys.argv[1:]] or range(1, len(known) + 1)
    copy_sources()
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    subprocess.run(["cmake", "--preset", "kernels", "-S", SOURCE, "-B", BUILD / "tree", "-DCMAKE_BUILD_TYPE=Release",
                    f"-DMULTISPECTRAL_ONLY_ROOMS={ROOMS}", *launcher], check=True,
                   cwd=SOURCE, stdout=subprocess.DEVNULL)
    rooms = sorted({known[number - 1][3] for number in chosen})
    trouble = build(*(f"Test{room}" for room in rooms))
    if trouble:
        sys.exit(f"the tests do not build:\n{trouble}")
    unnoticed = [f"{room}: the tests fail without a fault" for room in rooms if not passes(room)]
    for number in chosen:
        name, before, after, room = known[number - 1]
        path = SOURCE / name
        text = path.read_text(encoding="utf-8")
        if text.count(before) != 1:
            sys.exit(f"mutations.txt: fault {number}: '{before}' stands {text.count(before)} times in {name}; expected once")
        path.write_text(text.replace(before, after), encoding="utf-8")
        trouble = build(f"Test{room}")
        noticed = bool(trouble) or not passes(room)
        path.write_text(text, encoding="utf-8")
        print(f"{number:3} {'noticed' if noticed else 'NOT NOTICED':<12} {name}: {after}"
              + (" (does not compile)" if trouble else ""), flush=True)
        if not noticed or trouble:
            unnoticed.append(f"fault {number}: {name}: {after}")
    print("\n".join(unnoticed) or f"{len(list(chosen))} faults, all noticed")
    sys.exit(1 if unnoticed else 0)


main()
