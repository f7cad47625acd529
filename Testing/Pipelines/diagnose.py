"""./multispectral diagnose on the demo capture: the report keeps its contract, names what was planted, and the
corrected camera file holds it; captures with parts missing are refused or diagnosed with a word on what is not decided."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
from random import Random

import numpy as np
from odd_captures import DEMO, IMAGE, refused, undecided

root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
VERDICTS = ("no gap", "explained", "partly explained", "unexplained")
AXES = ("channel", "medium", "scene", "position", "level", "order", "spectral_shape", "sample")
faults = []


def expect(truth, text):
    if not truth:
        faults.append(text)


def run(launcher, capture, output, *options):
    return subprocess.run([launcher, "diagnose", str(capture), "--output", str(output), *options],
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def check_contract(report, name):
    """The keys and types of the contract; nothing about the values but their order and range."""
    def has(truth, what):
        expect(truth, f"{name}: {what}")
    has(report.get("verdict") in VERDICTS, f"verdict {report.get('verdict')!r}")
    gap = report.get("gap", {})
    has(all(number(gap.get(key)) for key in ("rms_before", "rms_after", "noise_floor", "shrink")),
        f"gap is {gap}")
    interval = gap.get("shrink_interval", [])
    has(len(interval) == 2 and all(map(number, interval)) and interval[0] <= gap["shrink"] <= interval[1],
        f"shrink_interval {interval}")
    where = report.get("where")
    has(isinstance(where, list) and where, "where is empty")
    shares = [axis["share"] for axis in where]
    has(shares == sorted(shares, reverse=True), f"where is not sorted: {shares}")
    for axis in where:
        has(axis["axis"] in AXES and number(axis["share"]), f"axis {axis['axis']!r}")
        has(all(isinstance(cell["cell"], str) and number(cell["share"]) for cell in axis["worst"]),
            f"cells of {axis['axis']}")
    for cause in report.get("causes", [None]):
        has(isinstance(cause["effect"], str) and number(cause["share"]) and number(cause["shrink"])
            and all(isinstance(other, str) for other in cause["equivalent"]), f"cause {cause}")
        for parameter in cause["parameters"]:
            has(isinstance(parameter["name"], str) and isinstance(parameter["unit"], str)
                and number(parameter["value"]) and number(parameter["standard_error"]),
                f"parameter {parameter}")
    shrinks = [candidate["shrink"] for candidate in report.get("candidates", [{"shrink": "none"}])]
    has(all(map(number, shrinks)) and shrinks == sorted(shrinks, reverse=True), f"candidates {shrinks}")
    chances = report.get("probabilities", {})
    has(all(number(chance) and 0 <= chance <= 1 for chance in chances.values()), f"probabilities {chances}")
    for verdict, name in (("no gap", "nothing"), ("unexplained", "unknown")):
        has(report["verdict"] != verdict or chances.get(name, 0) >= 0.5, f"{verdict}, but {name} in {chances}")
    left = report.get("unexplained", {})
    has(number(left.get("share")) and isinstance(left.get("where"), str), f"unexplained {left}")
    following = report.get("next_capture", {})
    has(isinstance(following.get("capture"), str) and isinstance(following.get("separates"), list),
        f"next_capture {following}")
    has(all(isinstance(note, str) for note in report.get("notes", [None])), "notes")


def parameter_of(report, effect, name):
    return next((parameter for cause in report["causes"] if cause["effect"] == effect
                 for parameter in cause["parameters"] if parameter["name"] == name),
                {"value": float("nan"), "standard_error": float("nan")})


def check_demo(launcher, folder):
    done = run(launcher, DEMO, folder / "demo")
    expect(done.returncode == 0, f"demo capture: status {done.returncode}: {done.stderr}")
    report = json.loads((folder / "demo" / "report.json").read_text(encoding="utf-8"))
    check_contract(report, "demo capture")
    expect(report["verdict"] == "explained", f"demo capture: {report['verdict']}")
    # As planted by Testing/Support/Scenes/DemoCapture.cpp.
    for effect, name, planted, tolerance in (("medium_gain", "gain", 0.95, 0.002),
                                             ("filter_shift", "shift", 1.6, 0.1),
                                             ("session_drift", "change", 0.03, 0.002)):
        found = parameter_of(report, effect, name)["value"]
        expect(abs(found - planted) <= tolerance, f"{effect}: {name} {found}, planted {planted}")
    camera = json.loads((folder / "demo" / "camera-corrected.json").read_text(encoding="utf-8"))
    expect({effect["effect"] for effect in camera["effects"]} ==
           {cause["effect"] for cause in report["causes"]}, f"corrected camera: {camera['effects']}")
    curves = (folder / "demo" / camera["camera"]).read_text(encoding="utf-8").splitlines()
    expect(len(curves) == 74 and curves[0].startswith("wavelength,C1,"), "corrected camera: curves")
    page = (folder / "demo" / "report.html").read_text(encoding="utf-8")
    expect(page.count("data:image/png;base64,") == 6, "report.html: six pictures")
    expect("src='http" not in page, "report.html: self-contained")
    words = re.sub("<[^>]*>", " ", page.partition("</style>")[2])
    expect("Filter shift" in words and "Gain of one medium (fabric)" in words and "nm)" in words, "report.html: plain names")
    expect(not re.search(r"filter_shift|medium_gain|session_drift|spectral_shape|\bC\d+\b", words), "report.html: identifiers")

    # A width about other middles than the centroids would imitate the shift.
    left_out = ("filter_shift", "filter_bandwidth", "session_drift")
    options = [word for effect in left_out for word in ("--without", effect)]
    done = run(launcher, DEMO, folder / "without", *options, "--add-rest")
    expect(done.returncode == 0, f"--without: status {done.returncode}: {done.stderr}")
    report = json.loads((folder / "without" / "report.json").read_text(encoding="utf-8"))
    check_contract(report, "--without")
    named = {entry["effect"] for entry in report["causes"] + report["candidates"]}
    expect(not named & set(left_out), f"--without: {named}")
    with_rest = report["unexplained"].get("rms_with_rest", 1.0)
    expect(with_rest < report["gap"]["rms_after"], f"--add-rest: rms {with_rest}, {report['gap']}")
    camera = json.loads((folder / "without" / "camera-corrected.json").read_text(encoding="utf-8"))
    expect(camera["effects"][-1]["effect"] == "unmodelled_response", "--add-rest: corrected camera")

    done = run(launcher, DEMO, folder / "ranks", "--ranks", "2")
    expect(done.returncode == 0, f"--ranks 2: status {done.returncode}: {done.stderr}")
    for name in ("report.json", "camera-corrected.json", "samples.csv"):
        expect((folder / "ranks" / name).read_bytes() == (folder / "demo" / name).read_bytes(),
               f"--ranks 2: {name} differs")


def check_further_capture(launcher, folder):
    """An offset of matt samples of one medium may be glare, gloss or a bias; a lid tells which."""
    rows = [line.split(",") for line in (DEMO / "samples.csv").read_text(encoding="utf-8").splitlines()]
    first = next(place for place, name in enumerate(rows[0]) if re.fullmatch(r"R\d+", name))
    wavelengths = [float(name[1:]) for name in rows[0][first:]]
    lines = (DEMO / "camera.csv").read_text(encoding="utf-8").splitlines()
    camera = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
    random = Random(5)

    def capture(name, medium, spectra):
        place = folder / name
        place.mkdir()
        shutil.copy(DEMO / "camera.csv", place)
        (place / "capture.json").write_text(json.dumps(
            {"name": name, "dark": 0, "noise": {"read": 0.0008, "shot": 0.001}}), encoding="utf-8")
        places = ["x", "y"] if medium == "paper" else []
        raster = [[str(number % 8), str(number // 8)][:len(places)] for number in range(len(spectra))]
        (place / "samples.csv").write_text("\n".join(
            [",".join(["sample", "medium", *places, *(f"R{place:g}" for place in camera[:, 0])])] +
            [",".join([str(number), medium, *raster[number], *map(str, spectrum)]) for number, spectrum in enumerate(spectra)]) + "\n",
            encoding="utf-8")
        noisy = [[str(number), str(repeat), *(f"{u + random.gauss(0, 0.0009):.6f}" for u in camera[:, 1:].T @ spectrum + 0.008)]
                 for repeat in (1, 2) for number, spectrum in enumerate(spectra)]
        head = ",".join(["sample", "repeat", *lines[0].split(",")[1:]])
        (place / "responses.csv").write_text("\n".join([head, *map(",".join, noisy)]) + "\n", encoding="utf-8")
        return place

    swatches = capture("swatches", "paper",
                       [np.interp(camera[:, 0], wavelengths, [float(cell) for cell in row[first:]]) for row in rows[1:41]])
    lid = capture("lid", "lid", np.zeros((8, len(camera))))

    def result(name, *options):
        done = run(launcher, swatches, folder / name, *options)
        expect(done.returncode == 0, f"{name}: status {done.returncode}: {done.stderr}")
        return json.loads((folder / name / "report.json").read_text(encoding="utf-8"))

    alone, both = result("alone"), result("both", "--also", str(lid))
    expect(len(alone["causes"][0]["equivalent"]) > 0 and alone["next_capture"]["expected_bits"] > 0.1,
           f"an offset alone: {alone['causes']}, {alone['next_capture']}")
    expect([cause["effect"] for cause in both["causes"]] == ["dark_offset"] and not both["causes"][0]["equivalent"],
           f"an offset and a lid: {both['causes']}")
    expect(both["probabilities"]["dark_offset"] > alone["probabilities"]["dark_offset"],
           f"an offset and a lid: {both['probabilities']}, before {alone['probabilities']}")
    expect("8 of 48 samples have no position: they are taken to be in the middle of the field." in both["notes"],
           f"a chart with places and a lid: {both['notes']}")
    samples = (folder / "both" / "samples.csv").read_text(encoding="utf-8")
    page = (folder / "both" / "report.html").read_text(encoding="utf-8")
    expect("Sim-to-real gap: swatches and lid" in page and "1 minutes" not in page, "an offset and a lid: report.html")
    expect("0 (lid)" in samples, "an offset and a lid: samples.csv")

    (lid / "camera.csv").write_text("\n".join(lines[:-1]) + "\n", encoding="utf-8")
    done = run(launcher, swatches, folder / "twice", "--also", str(lid), "--also", f"{lid}/capture.json")
    expect(done.returncode == 1 and "is the same capture as" in done.stderr and done.stderr.count("\n") == 1, f"--also, twice: {done.stderr}")
    done = run(launcher, swatches, folder / "other", "--also", str(lid))
    expect(done.returncode == 1 and "is another simulated camera" in done.stderr, f"--also, other camera: {done.stderr}")


def check_images(launcher, folder):
    """A capture of two equal images, without tables: nothing to explain."""
    for kind in ("real", "simulated"):
        place = folder / "pair" / "images" / kind
        place.mkdir(parents=True)
        for channel in (400, 500, 600):
            shutil.copy(IMAGE / f"channel_{channel}nm.tif", place)
    done = run(launcher, folder / "pair", folder / "pair-out")
    expect(done.returncode == 0, f"image pair: status {done.returncode}: {done.stderr}")
    report = json.loads((folder / "pair-out" / "report.json").read_text(encoding="utf-8"))
    expect(report["verdict"] == "no gap" and not report["causes"], f"image pair: {report['verdict']}")
    expect(report["probabilities"]["nothing"] >= 0.5, f"image pair: {report['probabilities']}")
    expect((folder / "pair-out" / "gap-map.png").exists(), "image pair: no map")


def check_chart(launcher, folder):
    """The raw image of a chart, which the capture's camera simulates: the dark level that was planted."""
    capture, output = folder / "chart", folder / "chart-out"
    real = capture / "images" / "real"
    real.mkdir(parents=True)
    for file in IMAGE.glob("channel_*.tif"):
        shutil.copy(file, real)
    shutil.copy(IMAGE / "labels.png", capture / "images")
    shutil.copy(DEMO / "camera.csv", capture)
    done = run(launcher, capture, output)
    expect(done.returncode == 1 and "images/patches.csv is missing" in done.stderr
           and len(done.stderr.splitlines()) == 1, f"chart without patches: {done.stderr}")
    shutil.copy(IMAGE / "patches.csv", capture / "images")
    done = run(launcher, capture, output, "--also", str(DEMO))
    expect(done.returncode == 1 and "has images alone" in done.stderr, f"chart with --also: {done.stderr}")
    done = run(launcher, capture, output)
    expect(done.returncode == 0, f"chart: status {done.returncode}: {done.stderr}")
    report = json.loads((output / "report.json").read_text(encoding="utf-8"))
    # Counts of a camera whose dark level is 96 and whose white is 3200; glare adds as a dark level does.
    named = [{cause["effect"], *cause["equivalent"]} for cause in report["causes"]]
    expect(named and "dark_offset" in named[0], f"chart: causes {report['causes']}")
    expect(any("not in units of white" in note for note in report["notes"]), f"chart: notes {report['notes']}")
    effects = json.loads((output / "effects.json").read_text(encoding="utf-8"))
    expect(sorted(effect["effect"] for effect in effects) == sorted(cause["effect"] for cause in report["causes"]),
           f"chart: effects {effects}, causes {report['causes']}")
    page = (output / "report.html").read_text(encoding="utf-8")
    expect(page.count("data:image/png;base64,") == 4 and "What to do next" in page, "chart: the page")


def chosen(captures, *names):
    """Some through the launcher; odd_captures_in_process.py has all."""
    found = [(capture, part) for capture, part in captures if capture.name in names]
    assert len(found) == len(names)
    return found


def check_bad_input(launcher, folder):
    for capture, part in chosen(refused(folder), "nowhere", "no-camera", "text", "one-image"):
        output = folder / "refused" / capture.name
        done = run(launcher, capture, output)
        lines = done.stderr.strip().splitlines()
        expect(done.returncode == 1 and len(lines) == 1 and part in lines[0]
               and lines[0].startswith("multispectral: "),
               f"{capture.name}: expected one line with '{part}', got {done.returncode} and {lines}")
        expect(not output.exists(), f"{capture.name}: something was written")
    done = run(launcher, DEMO, folder / "out", "--without", "magic")
    expect(done.returncode == 1 and "there is no effect 'magic'" in done.stderr, f"magic: {done.stderr}")
    for capture, part in chosen(undecided(folder), "one-repeat", "white-level"):
        output = folder / "undecided" / capture.name
        done = run(launcher, capture, output)
        expect(done.returncode == 0, f"{capture.name}: status {done.returncode}: {done.stderr}")
        if done.returncode == 0:
            report = json.loads((output / "report.json").read_text(encoding="utf-8"))
            check_contract(report, capture.name)
            expect(part is None or any(part in note for note in report["notes"]),
                   f"{capture.name}: no note with '{part}' in {report['notes']}")
            expect(part is not None or "divided by the white level 4000" in done.stderr,
                   f"{capture.name}: {done.stderr}")


def main():
    launcher, part, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if part == "demo":
        check_demo(launcher, folder)
        check_further_capture(launcher, folder)
        check_images(launcher, folder)
        check_chart(launcher, folder)
    else:
        check_bad_input(launcher, folder)
    print("\n".join(faults) or "as the contract says")
    sys.exit(1 if faults else 0)


main()
