"""COMMAND --help answers with the command's usage before anything is installed, built or started.

Arguments: the launcher, a folder for programs that must not be called.
"""

import os
import pathlib
import subprocess
import sys

COMMANDS = {"setup": "", "demo": "--ranks", "test": "CTEST", "evaluate": "--calibration", "estimate": "--tuning",
            "choose": "--candidates", "camera": "--effects", "scene": "--size", "diagnose": "CAPTURE_DIR",
            "bench": "--output", "paraview": "STATE"}
FORBIDDEN = ("apt-get", "cmake", "ctest", "mpirun", "ninja", "paraview", "pvbatch", "xvfb-run")


def main():
    launcher, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    for name in FORBIDDEN:
        path = folder / name
        path.write_text(f"#!/bin/sh\necho '{name} was called' >&2\nexit 1\n", encoding="ascii")
        path.chmod(0o755)
    faults = []
    for command, part in COMMANDS.items():
        for arguments in (["--help"], ["-h"], ["--output", "x", "--help"]):
            done = subprocess.run([launcher, command, *arguments], text=True, capture_output=True,
                                  env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"})
            if done.returncode != 0 or done.stderr or part not in done.stdout \
                    or not done.stdout.startswith(f"usage: ./multispectral {command}"):
                faults.append(f"{command} {arguments}: status {done.returncode}\n{done.stdout}{done.stderr}")
    print("\n".join(faults) or f"{len(COMMANDS)} commands explain themselves")
    sys.exit(1 if faults else 0)


main()
