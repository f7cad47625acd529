"""Data that cannot be, given to the commands as a user would: one clear line, or a note beside the results; never a
result without a word.

Arguments: the launcher, a folder for files, and the names of the tests that are to run (all by default)."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
CHART = root / "Data" / "Samples" / "demo-chart.csv"
FABRIC = root / "Data" / "Samples" / "demo-fabric.csv"
CAPTURE = root / "Data" / "Captures" / "demo-warm-camera"
IMAGE = root / "Data" / "Images" / "demo-fabric"
faults = []


def read(path):
    return [line.split(",") for line in path.read_text(encoding="utf-8").splitlines()]


def write(path, rows):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(",".join(map(str, row)) + "\n" for row in rows), encoding="utf-8")
    return path


def changed(base, name, change, source=CHART, letters="C"):
    """A copy of a table; change(value, row from 0, column from 0 of those that begin with one of the letters)."""
    rows = read(source)
    columns = [i for i, title in enumerate(rows[0]) if title[0] in letters and title[1:].isdigit()]
    for number, row in enumerate(rows[1:]):
        for place, column in enumerate(columns):
            row[column] = change(float(row[column]), number, place)
    return write(base / name, rows)


def first_samples(base, name, count, source=CHART):
    return write(base / name, read(source)[:count + 1])


def capture(base, name, **tables):
    """A copy of the demo's capture; tables: {stem: (change, letters)} or {stem: rows}."""
    place = base / name
    shutil.copytree(CAPTURE, place)
    for stem, new in tables.items():
        path = place / f"{stem}.csv"
        if callable(new):
            changed(place, path.name, new, path)
        else:
            write(path, new)
    return place


def run(*arguments):
    return subprocess.run(list(map(str, arguments)), text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def refused(what, parts, *arguments):
    """Status 1 and one line that has all the parts."""
    done = run(*arguments)
    lines = [line for line in done.stderr.strip().splitlines() if ": note: " not in line]
    if done.returncode != 1 or len(lines) != 1 or not all(part in lines[0] for part in parts):
        faults.append(f"{what}: expected status 1 and one line with {parts}, got {done.returncode} and\n    "
                      + "\n    ".join(done.stderr.strip().splitlines()[:12] or done.stdout.splitlines()[:6]))


def remarked(what, parts, *arguments):
    """Done, and a note has all the parts."""
    done = run(*arguments)
    if done.returncode != 0 or not any(all(part in line for part in parts) for line in done.stderr.splitlines()):
        faults.append(f"{what}: expected status 0 and a note with {parts}, got {done.returncode} and\n    "
                      + "\n    ".join(done.stderr.strip().splitlines()[:12]))
    return done


def marks_of_missing_values(launcher, base):
    for value in (-9999, -1e9, 1e31):
        table = changed(base, f"mark{value}.csv", lambda v, row, column: value if (row, column) == (5, 3) else v)
        for command in (["evaluate", "--calibration", table, "--target", FABRIC],
                        ["evaluate", "--calibration", CHART, "--target", table],
                        ["camera", "--fit", "--samples", table],
                        ["estimate", "--image", *sorted(IMAGE.glob("channel_*.tif")), "--calibration", table]):
            refused(f"{command[0]}: a response of {value}", [table.name, "expected"],
                    launcher, *command, "--output", base / "out")
        table = changed(base, f"mark{value}.csv", lambda v, row, column: value if (row, column) == (5, 3) else v, letters="R")
        refused(f"evaluate: a reflectance of {value}", [table.name, "expected"],
                launcher, "evaluate", "--calibration", table, "--target", FABRIC, "--output", base / "out")
    for stem, letters in (("responses", "C"), ("samples", "R")):
        place = capture(base, f"capture-mark-{stem}")
        changed(place, f"{stem}.csv", lambda v, row, column: -9999 if (row, column) == (7, 2) else v,
                place / f"{stem}.csv", letters)
        refused(f"diagnose: -9999 in {stem}.csv", ["-9999", "expected"],
                launcher, "diagnose", place, "--output", base / "out")


def nothing_but_zero(launcher, base):
    """No responses at all, and one dead channel."""
    zero = changed(base, "zero.csv", lambda *_: 0)
    dead = changed(base, "dead.csv", lambda v, _, column: 0 if column == 2 else v)
    out = ["--output", base / "out"]
    refused("evaluate: all responses 0", ["0 in every sample"], launcher, "evaluate", "--calibration", zero, "--target",
            FABRIC, "--draws", "1", *out)
    refused("evaluate: all responses of the target 0", ["0 in every sample"], launcher, "evaluate", "--calibration", CHART,
            "--target", zero, "--draws", "1", *out)
    refused("camera: all responses 0", ["0 in every sample"], launcher, "camera", "--fit", "--samples", zero, *out)
    remarked("evaluate: a dead channel", ["440 nm is 0 in every sample"], launcher, "evaluate", "--calibration", dead,
             "--target", FABRIC, "--methods", "direct,pooled", "--draws", "1", *out)
    remarked("evaluate: a dead channel of the target", ["440 nm is 0 in every sample"], launcher, "evaluate",
             "--calibration", CHART, "--target", dead, "--methods", "direct,pooled", "--draws", "1", *out)
    remarked("camera: a dead channel", ["0 in every sample"], launcher, "camera", "--fit", "--draws", "0",
             "--samples", dead, *out)
    refused("diagnose: all responses 0", ["0 in every reading"], launcher, "diagnose",
            capture(base, "capture-zero", responses=lambda *_: 0), *out)


def cameras_that_see_nothing(launcher, base):
    rows = read(CAPTURE / "camera.csv")
    out = ["--output", base / "out"]
    refused("diagnose: camera.csv all zero", ["answers to no light"], launcher, "diagnose",
            capture(base, "capture-blind", camera=[rows[0]] + [[row[0]] + ["0"] * (len(row) - 1) for row in rows[1:]]), *out)
    refused("diagnose: one wavelength", ["wavelength"], launcher, "diagnose",
            capture(base, "capture-one-wavelength", camera=rows[:2]), *out)
    beside = [rows[0]] + [[str(float(row[0]) + 1000.0)] + row[1:] for row in rows[1:]]
    refused("diagnose: a camera beside the samples' range", ["wavelengths where no reflectance was measured"],
            launcher, "diagnose", capture(base, "capture-beside", camera=beside), *out)
    blind = write(base / "blind.csv", [rows[0]] + [[row[0]] + ["0"] * (len(row) - 1) for row in rows[1:]])
    remarked("camera: curves of 0", ["answers to no light"], launcher, "camera", "--samples", CHART, "--camera", blind, *out)
    far = write(base / "far.csv", beside)
    remarked("camera: curves beside the samples' range", ["wavelengths where no reflectance was measured"],
            launcher, "camera", "--samples", CHART, "--camera", far, *out)


def too_few(launcher, base):
    out = ["--output", base / "out"]
    two = first_samples(base, "two.csv", 2)
    refused("evaluate: a target of two samples", ["the target has 2 samples"], launcher, "evaluate", "--calibration", CHART,
            "--target", two, *out)
    refused("camera: two samples", ["samples"], launcher, "camera", "--fit", "--samples", two, *out)
    place = capture(base, "capture-two", samples=read(CAPTURE / "samples.csv")[:3])
    names = {row[0] for row in read(place / "samples.csv")}
    write(place / "responses.csv", [row for row in read(place / "responses.csv") if row[0] in names])
    refused("diagnose: two samples", ["5 samples or more"], launcher, "diagnose", place, *out)


def units_that_differ(launcher, base):
    counts = changed(base, "counts.csv", lambda v, *_: round(4095 * v))
    refused("evaluate: a chart in counts, a target relative to white", ["relative to white", "counts"],
            launcher, "evaluate", "--calibration", counts, "--target", FABRIC, "--output", base / "out")


def mistakes(launcher, base):
    """What is possible, and probably wrong: done, with a question."""
    rows = read(FABRIC)
    camera = [i for i, title in enumerate(rows[0]) if title[0] == "C" and title[1:].isdigit()]

    def evaluate(what, parts, name, target):
        remarked(f"evaluate: {what}", parts, launcher, "evaluate", "--calibration", CHART, "--target", write(base / name, target),
                 "--methods", "direct", "--draws", "1", "--output", base / "out")

    def with_readings(of):
        """Sample i has the responses of sample of(i)."""
        return [rows[0]] + [[rows[1 + of(i)][c] if c in camera else cell for c, cell in enumerate(row)]
                            for i, row in enumerate(rows[1:])]
    last = len(rows) - 2
    evaluate("samples in reverse order", ["the target table: Mixed up?", "in reverse order"], "reversed.csv",
             with_readings(lambda i: last - i))
    evaluate("two samples exchanged", ["Samples fabric-011 and fabric-091 fit much better when they are exchanged"],
             "exchanged.csv", with_readings(lambda i: {10: 90, 90: 10}.get(i, i)))
    evaluate("another sample's readings", ["the target table: Odd? fabric-031 (1 of 120 samples)"], "odd.csv",
             with_readings(lambda i: 70 if i == 30 else i))
    evaluate("two channels exchanged", ["Channels 460 nm and 540 nm fit much better when they are exchanged"], "channels.csv",
             [rows[0]] + [[row[{camera[3]: camera[7], camera[7]: camera[3]}.get(c, c)] for c in range(len(row))]
                          for row in rows[1:]])
    evaluate("another exposure", ["the target table: Exposure? The responses are 0.4"], "exposure.csv",
             read(changed(base, "half.csv", lambda v, *_: 0.5 * v, FABRIC)))
    evaluate("the chart as target", ["the target table: Twice?", "140 of 140 samples"], "twice.csv", read(CHART))
    images = {name: sorted((IMAGE / name).glob("channel_*.tif")) for name in ("", "white", "dark")}
    patches = ["--calibration", CHART, "--labels", IMAGE / "labels.png", "--patches", IMAGE / "patches.csv"]
    remarked("estimate: no dark image", ["the patches in the image: Dark? The responses are 0.0"], launcher, "estimate",
             "--image", *images[""], "--white", *images["white"], *patches, "--output", base / "dark")
    remarked("estimate: channels of the image in reverse order", ["the patches in the image: Mixed up? The channels fit"],
             launcher, "estimate", "--image", *reversed(images[""]), "--white", *reversed(images["white"]), "--dark",
             *reversed(images["dark"]), "--wavelengths", *range(400, 701, 20), *patches, "--output", base / "channels")
    done = run(launcher, "evaluate", "--calibration", CHART, "--target", FABRIC, "--methods", "direct", "--draws", "1",
               "--output", base / "right")
    if done.returncode != 0 or "?" in done.stderr:
        faults.append(f"evaluate: a question about the demo's own tables: {done.stderr}")


def methods_that_cannot_run(launcher, base):
    """They are left out and named, in the command's notes; the others are compared."""
    output = base / "few"
    done = remarked("evaluate: 3 tuning samples", ["the method r-model is left out", "expected at least 4 samples"],
                    launcher, "evaluate", "--calibration", CHART, "--target", FABRIC, "--tuning", "3", "--draws", "2",
                    "--methods", "direct,r-model,pooled", "--output", output)
    table = (output / "results.csv").read_text(encoding="utf-8") if (output / "results.csv").exists() else ""
    if "pooled" not in table or "r-model" in table or ",nan" in table.lower() or "r-model" in done.stdout:
        faults.append(f"evaluate: 3 tuning samples: the results are\n{table}\n{done.stdout}")
    narrow = []
    for source, name in ((CHART, "chart.csv"), (FABRIC, "fabric.csv")):
        rows = read(source)
        bands = [i for i, title in enumerate(rows[0]) if title[0] == "R" and title[1:].isdigit()]
        dropped = set(bands) - set(bands[::4])  # 8 bands, 16 channels
        narrow.append(write(base / name, [[cell for i, cell in enumerate(row) if i not in dropped] for row in rows]))
    remarked("evaluate: more channels than bands", ["the method banded is left out"],
             launcher, "evaluate", "--calibration", narrow[0], "--target", narrow[1], "--draws", "1",
             "--methods", "direct,banded,r-model", "--output", base / "narrow")
    refused("evaluate: the only method cannot run", ["method r-model:", "expected at least 4 samples"],
            launcher, "evaluate", "--calibration", CHART, "--target", FABRIC, "--tuning", "3", "--draws", "1",
            "--methods", "r-model", "--output", base / "none")


def large_captures(launcher, base):
    """A subsample is used, and the report says so."""
    rows = read(CAPTURE / "samples.csv")
    readings = read(CAPTURE / "responses.csv")
    again = 1
    samples, responses = [rows[0]], [readings[0]]
    while len(samples) < 300:
        samples += [[f"{row[0]}-{again}"] + row[1:] for row in rows[1:]]
        responses += [[f"{row[0]}-{again}"] + row[1:] for row in readings[1:]]
        again += 1
    output = base / "large"
    done = run(launcher, "diagnose", capture(base, "capture-large", samples=samples, responses=responses), "--samples", "60",
               "--output", output)
    report = json.loads((output / "report.json").read_text(encoding="utf-8")) if done.returncode == 0 else {"notes": []}
    if not any("60 of " in note and "samples were used" in note for note in report["notes"]):
        faults.append(f"diagnose: a subsample without a word: {done.returncode} {done.stderr} {report['notes']}")


def main():
    launcher, base = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    shutil.rmtree(base, ignore_errors=True)
    base.mkdir(parents=True)
    for test in (marks_of_missing_values, nothing_but_zero, cameras_that_see_nothing, too_few, units_that_differ, mistakes,
                 methods_that_cannot_run, large_captures):
        if len(sys.argv) < 4 or test.__name__ in sys.argv[3:]:
            folder = base / test.__name__
            folder.mkdir()
            test(launcher, folder)
    print("\n".join(faults) or "no result of impossible data without a word")
    sys.exit(1 if faults else 0)


main()
