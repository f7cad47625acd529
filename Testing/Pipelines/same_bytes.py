"""The demo gives the same tables and the same reflectance image with one thread, with several, and on two ranks."""

import os
import pathlib
import shutil
import subprocess
import sys

RUNS = {
    "threads": ("STDThread", []),
    "sequential": ("Sequential", []),
    "ranks": ("STDThread", ["--ranks", "2"]),
}


def main():
    launcher, output = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(output, ignore_errors=True)
    for name, (backend, options) in RUNS.items():
        subprocess.run([launcher, "demo", "--output", str(output / name), *options], check=True,
                       env={**os.environ, "VTK_SMP_BACKEND_IN_USE": backend},
                       stdout=subprocess.DEVNULL)
    first = output / "threads"
    files = [path.relative_to(first) for path in sorted(first.rglob("*"))
             if path.suffix in (".csv", ".exr")]
    if len(files) < 10:
        sys.exit(f"the demo wrote only {len(files)} tables and images")
    differing = [f"{name}: {path}" for path in files for name in RUNS
                 if (first / path).read_bytes() != (output / name / path).read_bytes()]
    print("\n".join(differing) or f"{len(files)} files, {len(RUNS)} ways to run: the same bytes")
    sys.exit(1 if differing else 0)


main()
