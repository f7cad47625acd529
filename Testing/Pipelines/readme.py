"""The commands of README.md and of the tutorials, on the demo's own data.

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
NEEDS_A_DISPLAY = "multispectral paraview"  # which the test Window runs
PAGES = {"README.md": "## Use\n", "Documentation/Tutorial.md": "", "Documentation/Simulator.md": ""}  # page: where its commands begin


def commands():
    for page, heading in PAGES.items():
        text = (root / page).read_text(encoding="utf-8").partition(heading)[2] if heading else \
            (root / page).read_text(encoding="utf-8")
        blocks = re.findall(r"```sh\n(.*?)```", text, re.DOTALL)
        assert blocks, f"{page} has no commands"
        for block in blocks:
            for line in block.splitlines():
                line = line.split("  #")[0].strip()
                if line and not line.startswith(NEEDS_A_DISPLAY):
                    yield page, line


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
    page = (root / "Documentation" / "Tutorial.md").read_text(encoding="utf-8")
    (folder / "gallery.csv").write_text(re.search(r"```csv\n(.*?)```", page, re.DOTALL).group(1), encoding="utf-8")


def main():
    lay_out(output)
    ran = 0
    for page, line in commands():
        name, command, *arguments = line.split()
        assert name == "multispectral", line
        arguments = [file for word in arguments
                     for file in (sorted(glob.glob(word, root_dir=output)) if "*" in word else [word])]
        run = subprocess.run([launcher, command, *arguments], cwd=output, capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(f"{page}: {line}\nexit status {run.returncode}\n{run.stdout}{run.stderr}")
        written = arguments[arguments.index("--output") + 1] if "--output" in arguments else f"output/{command}"
        if not os.listdir(output / written):
            sys.exit(f"{page}: {line}\nwrote nothing")
        ran += 1
    print(f"{ran} commands of {' and '.join(PAGES)} ran")
    if ran < 12:
        sys.exit("the pages have fewer commands than expected")


main()
