"""Faults of the machine and of the user, through the launcher: nothing is lost, nothing looks complete that is not.

Arguments: the launcher, a folder for files, and the names of the tests that are to run (all by default)."""

import contextlib
import fcntl
import hashlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
SAMPLES = root / "Data" / "Samples"
IMAGE = root / "Data" / "Images" / "demo-fabric"
CAPTURE = root / "Data" / "Captures" / "demo-warm-camera"
faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)


def start(*arguments, **options):
    return subprocess.Popen(list(map(str, arguments)), text=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                            **options)


def run(*arguments, **options):
    process = start(*arguments, **options)
    process.stderr_text = process.communicate()[1]
    return process


def one_line(done, part, what):
    lines = [line for line in done.stderr_text.strip().splitlines() if ": note: " not in line]
    expect(done.returncode == 1 and len(lines) == 1 and part in lines[0],
           f"{what}: expected status 1 and one line with '{part}', got {done.returncode} and:\n    "
           + "\n    ".join(lines[:12]))


def contents(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir() if path.is_file()}


def outputs_over_inputs(launcher, base):
    """The output folder is where the inputs lie: refused where a file would be written over, and nothing changes."""
    place = base / "inputs with 'quotes' & 100 %"
    place.mkdir()
    for path in [*IMAGE.glob("channel_*.tif"), IMAGE / "labels.png", IMAGE / "patches.csv", *CAPTURE.glob("*.*"),
                 SAMPLES / "demo-chart.csv"]:
        shutil.copy(path, place)
    shutil.copy(SAMPLES / "demo-fabric.csv", place / "results.csv")
    images = sorted(place.glob("channel_*.tif"))
    before = contents(place)
    for arguments, part in (
            (["estimate", "--image", *images, "--labels", place / "labels.png", "--patches", place / "patches.csv"],
             "patches.csv"),
            (["camera", "--fit", "--samples", place / "demo-chart.csv", "--camera", place / "camera.csv"], "camera.csv"),
            (["evaluate", "--calibration", place / "demo-chart.csv", "--target", place / "results.csv"], "results.csv"),
            (["diagnose", place], "samples.csv")):
        one_line(run(launcher, *arguments, "--output", place), f"{part}: is an input, and the command would write",
                 f"{arguments[0]} over its input")
        expect(contents(place) == before, f"{arguments[0]} changed its input folder")


def killed_and_run_again(launcher, base):
    """Killed while it writes: nothing stands there cut off, and the next run clears what was left."""
    output = base / "killed"
    command = [launcher, "scene", "fabric", "--size", "1500x1000", "--output", output]
    process = start(*command, start_new_session=True)
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline and process.poll() is None and not list(output.glob(".*.part*")):
        time.sleep(0.02)
    parts = list(output.glob(".*.part*"))
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    expect(parts, "nothing was being written when it was killed")
    expect(not (output / "reflectance.hdr").exists(), "a killed run left a header")
    done = run(launcher, "scene", "chart24", "--size", "48x32", "--output", output)
    expect(done.returncode == 0, f"after a kill: {done.stderr_text}")
    left = [path.name for path in output.iterdir() if path.name.startswith(".")]
    expect(not left, f"the next run left {left}")


def stopped_by_the_user(launcher, base):
    """Ctrl-C in a terminal goes to all processes: they end, without traces on the screen and without files elsewhere."""
    temporary = base / "temporary"
    temporary.mkdir()
    for ranks in 1, 2:
        output = base / f"stopped {ranks}"
        process = start(launcher, "scene", "fabric", "--size", "3000x2000", "--ranks", ranks, "--output", output,
                        start_new_session=True, env={**os.environ, "TMPDIR": str(temporary)})
        deadline = time.monotonic() + 60.0
        while time.monotonic() < deadline and process.poll() is None and not list(output.glob(".*.part*")):
            time.sleep(0.02)
        os.killpg(process.pid, signal.SIGINT)
        try:
            text = process.communicate(timeout=30)[1]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            faults.append(f"Ctrl-C, {ranks} ranks: it went on for 30 s")
            return
        expect(process.returncode == -signal.SIGINT, f"Ctrl-C, {ranks} ranks: status {process.returncode}")
        expect(not re.search(r"Traceback|SIGINT|Stack|0x[0-9a-f]{6}", text) and len(text.splitlines()) <= 1,
               f"Ctrl-C, {ranks} ranks: it printed\n{text}")
        expect(not (output / "reflectance.hdr").exists(), f"Ctrl-C, {ranks} ranks, left a header")
        left = [path.name for path in temporary.iterdir() if path.is_file()]
        expect(not left, f"Ctrl-C, {ranks} ranks, left {left}")


def descendants(process):
    """Of a process: {number: its name}, the youngest last."""
    parents, names = {}, {}
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            with contextlib.suppress(OSError):
                name, _, rest = (entry / "stat").read_text().partition("(")[2].rpartition(")")
                parents[int(entry.name)], names[int(entry.name)] = int(rest.split()[1]), name
    found = [process]
    for parent in found:
        found += sorted(child for child in parents if parents[child] == parent)
    return {child: names[child] for child in found[1:]}


def a_process_is_lost(launcher, base):
    """The program, or one rank of it, is killed, as the system does where memory runs out: one line, nothing complete."""
    for ranks, name in ((1, "python3"), (2, "pvbatch")):
        output = base / f"lost of {ranks}"
        process = start(launcher, "scene", "fabric", "--size", "3000x2000", "--ranks", ranks, "--output", output,
                        start_new_session=True)
        deadline = time.monotonic() + 60.0
        while time.monotonic() < deadline and process.poll() is None and not list(output.glob(".*.part*")):
            time.sleep(0.02)
        # The first of one, the last of two: the program itself, not its helpers.
        found = [child for child, kind in descendants(process.pid).items() if kind == name]
        expect(found, f"no {name} was running")
        if found:
            os.kill(found[ranks - 1 if len(found) >= ranks else 0], signal.SIGKILL)
        try:
            process.stderr_text = process.communicate(timeout=60)[1]
            one_line(process, "a process of the command was killed", f"one lost of {ranks}")
        except subprocess.TimeoutExpired:
            faults.append(f"one lost of {ranks}: the others went on for 60 s")
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        expect(not (output / "reflectance.hdr").exists(), f"one lost of {ranks}: a header was left")


def nowhere_to_speak(launcher, base):
    """The standard output is full or closed: what is written into files has none of the program's words."""
    command = [launcher, "scene", "chart24", "--size", "48x32", "--output", base / "silent"]
    build = pathlib.Path(os.environ.get("MULTISPECTRAL_BUILD", pathlib.Path(launcher).parent / "build"))
    with open("/dev/full", "w", encoding="ascii") as full, open(build / ".lock", "a", encoding="ascii") as lock:
        # The launcher has something to say, too: that it waits.
        fcntl.flock(lock, fcntl.LOCK_EX)
        done = subprocess.Popen(command, stdout=full, stderr=subprocess.PIPE, text=True)
        time.sleep(1)
        fcntl.flock(lock, fcntl.LOCK_UN)
        done.stderr_text = done.communicate()[1]
    one_line(done, "the standard output cannot be written: No space left on device", "full standard output")
    for closed in ">&-", ">&- 2>&-":
        shutil.rmtree(base / "silent")
        done = subprocess.run(["sh", "-c", f'exec "$@" {closed}', "sh", *map(str, command)])
        text = b"".join(path.read_bytes() for path in (base / "silent").iterdir())
        expect(done.returncode == 0 and b"scene.png and report.html:" not in text, f"{closed}: status {done.returncode}")


def names_with_meanings(launcher, base):
    """Names of files and samples are text, whatever is in them."""
    place = base / "-a b'c\"d%20;$(echo x)\n&<i>"
    place.mkdir()
    chart = (SAMPLES / "demo-chart.csv").read_text(encoding="utf-8").splitlines()
    fabric = (SAMPLES / "demo-fabric.csv").read_text(encoding="utf-8").splitlines()
    for lines, name in ((chart, "chart.csv"), (fabric, "fabric.csv")):
        cells = lines[1].split(",")
        cells[0] = '"<script>alert(1)</script>\x1b[2J"'
        lines[1] = ",".join(cells)
        (place / name).write_text("\n".join(lines) + "\n", encoding="utf-8")
    done = run(launcher, "camera", "--fit", "--draws", "0", "--samples", place / "chart.csv", "--output", place / "out")
    expect(done.returncode == 0, f"names with meanings: {done.stderr_text}")
    page = place / "out" / "report.html"
    expect(page.exists() and "<script>" not in page.read_text(encoding="utf-8"), "markup in a name is markup in the report")
    expect("\x1b" not in done.stderr_text, "a control character reached the terminal")
    # A name in Latin-1, on a system in UTF-8: refused before there is such a folder.
    latin = os.fsencode(base) + b"/caf\xe9"
    done = subprocess.run([os.fsencode(launcher), b"scene", b"chart24", b"--output", latin], stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE)
    done.stderr_text = done.stderr.decode("utf-8")
    one_line(done, "/caf\\xE9: the name is not UTF-8; choose another folder with --output", "an output folder in Latin-1")
    expect(not os.path.exists(latin), "the output folder in Latin-1 was made")


def no_threads_in_what_is_copied(launcher, base):
    """The process that draws is a copy of the program: a thread that a library started before would be missing in it."""
    package = pathlib.Path(os.environ["MULTISPECTRAL_PLUGIN"]).parents[2] / "python"
    done = subprocess.run(
        ["/usr/bin/python3", "-c", "import os, sys; sys.path.insert(0, sys.argv[1]); from support import command, estimation, "
         "pictures; print(len(os.listdir('/proc/self/task')))", root / "Plugin" / "Scripts"],
        env={**os.environ, "MULTISPECTRAL_PYTHON": str(package)}, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    expect(done.stdout.strip() == "1", f"threads before the first copy: {done.stdout}{done.stderr}")


def main():
    launcher, base = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    shutil.rmtree(base, ignore_errors=True)
    base.mkdir(parents=True)
    for test in (outputs_over_inputs, killed_and_run_again, stopped_by_the_user, a_process_is_lost, nowhere_to_speak,
                 names_with_meanings, no_threads_in_what_is_copied):
        if len(sys.argv) < 4 or test.__name__ in sys.argv[3:]:
            test(launcher, base)
    print("\n".join(faults) or "nothing lost, nothing that looks complete and is not")
    sys.exit(1 if faults else 0)


main()
