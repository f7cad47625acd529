"""The commands of README.md, on the demo's own data.

usage: readme.py LAUNCHER OUTPUT
"""

import glob
import os
import pathlib
import re
import shutil
import subprocess
import sys

launcher, output = sys.argv[1], pathlib.Path(sys.argv[2])
root = pathlib.Path(launcher).parent
NEEDS_A_DISPLAY = "multispectral paraview"


def commands():
    text = (root / "README.md").read_text(encoding="utf-8")
    use = re.search(r"## Use\n+```sh\n(.*?)```", text, re.DOTALL).group(1)
    lines = [line.split("  #")[0].strip() for line in use.splitlines()]
    return [line for line in lines if line and line != NEEDS_A_DISPLAY]


def lay_out(folder):
    """The files that the README names."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(root / "Data" / "Images" / "demo-fabric", folder)
    samples = root / "Data" / "Samples"
    shutil.copy(samples / "demo-chart.csv", folder / "chart.csv")
    shutil.copy(samples / "demo-fabric.csv", folder / "fabric.csv")
    rows = (samples / "demo-fabric.csv").read_text(encoding="utf-8").splitlines(keepends=True)
    (folder / "swatches.csv").write_text("".join(rows[:17]), encoding="utf-8")
    shutil.copytree(root / "Data" / "Captures" / "demo-warm-camera", folder / "capture")


def main():
    lay_out(output)
    ran = 0
    for line in commands():
        name, command, *arguments = line.split()
        assert name == "multispectral", line
        arguments = [file for word in arguments
                     for file in (sorted(glob.glob(word, root_dir=output)) if "*" in word else [word])]
        run = subprocess.run([launcher, command, *arguments], cwd=output, capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(f"{line}\nexit status {run.returncode}\n{run.stdout}{run.stderr}")
        if not os.listdir(output / "output" / command):
            sys.exit(f"{line}\nwrote nothing")
        ran += 1
    print(f"{ran} commands of README.md ran")
    if ran < 4:
        sys.exit("README.md has fewer commands than expected")


main()
