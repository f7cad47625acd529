"""Commands on a disk that is too small: exit status 0 and all files, or 1 and one line, and nothing that is cut off.

usage: full_disk.py LAUNCHER FOLDER [KIB...]

Mounts a tmpfs of each size (by default 64 to 2048 KiB) on FOLDER, which needs root, and runs the commands below into it."""

import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHART, FABRIC = (ROOT / "Data" / "Samples" / f"demo-{name}.csv" for name in ("chart", "fabric"))
IMAGE = sorted((ROOT / "Data" / "Images" / "demo-fabric").glob("channel_*.tif"))
COMMANDS = (
    ["evaluate", "--calibration", CHART, "--target", FABRIC, "--draws", "2", "--methods", "direct,pinv"],
    ["estimate", "--image", *IMAGE, "--calibration", CHART],
    ["diagnose", ROOT / "Data" / "Captures" / "demo-warm-camera"],
    ["scene", "fabric", "--size", "400x300"],
    ["camera", "--samples", CHART, "--fit", "--draws", "0"],
    ["demo"],
)


def faults_in(folder, done):
    lines = [line for line in done.stderr.strip().splitlines() if ": note: " not in line]
    if (done.returncode, len(lines)) not in ((0, 0), (1, 1)):
        yield f"status {done.returncode} and {len(lines)} lines:\n{done.stderr}"
    if done.returncode == 0 and not (folder / "report.html").exists():
        yield "status 0 without a report"
    for path in filter(pathlib.Path.is_file, folder.rglob("*")):
        content = path.read_bytes()
        if path.name.startswith(".") or not content:
            yield f"{path.name} was left with {len(content)} bytes"
        elif path.suffix == ".png" and not content.endswith(b"IEND\xaeB`\x82"):
            yield f"{path.name} is cut off"
        elif path.suffix == ".html" and not content.endswith(b"</html>"):
            yield f"{path.name} is cut off"


def main():
    launcher, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    sizes = sys.argv[3:] or ["64", "256", "512", "1024", "2048"]
    folder.mkdir(parents=True, exist_ok=True)
    runs, complete, faults = 0, 0, []
    for size in sizes:
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", folder], check=True)
        try:
            for command in COMMANDS:
                output = folder / "out"
                shutil.rmtree(output, ignore_errors=True)
                done = subprocess.run([launcher, *map(str, command), "--output", output], text=True,
                                      stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
                runs, complete = runs + 1, complete + (done.returncode == 0)
                faults += [f"{command[0]} in {size} KiB: {fault}" for fault in faults_in(output, done)]
        finally:
            subprocess.run(["umount", folder], check=True)
    print("\n".join(faults) or f"{runs} runs: {complete} complete, the others ended with one line and left nothing cut off")
    sys.exit(1 if faults else 0)


main()
