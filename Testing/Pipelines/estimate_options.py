"""`estimate`: nothing goes wrong without a word, and what it writes is what other programs read.

Arguments: the launcher, a folder for files."""

import os
import pathlib
import shutil
import subprocess
import sys

import numpy as np

root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
FOLDER = root / "Data" / "Images" / "demo-fabric"
CHART = root / "Data" / "Samples" / "demo-chart.csv"
faults = []


def stack(*parts):
    return sorted(FOLDER.joinpath(*parts).glob("channel_*.tif"))


def estimate(launcher, output, *arguments):
    done = subprocess.run([launcher, "estimate", "--calibration", CHART, "--output", output, *map(str, arguments)], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    page = output / "report.html"
    return done.returncode, done.stderr, done.stdout, page.read_text(encoding="utf-8") if page.is_file() else ""


def said(launcher, base):
    """Images that cannot give a result: a warning with the numbers, in the report too, or an error and no result."""
    raw, white, dark = stack(), stack("white"), stack("dark")
    flat = ["--white", *white, "--dark", *dark]
    dim = "the image's responses reach 4.1 % of the largest ones of the calibration samples"
    cases = (
        ("raw counts", ["--image", *raw], 1, dim),
        ("raw counts, trusted", ["--image", *raw, "--trust-responses"], 0, dim),
        ("dark alone", ["--image", *raw, "--dark", *dark], 1, "are they raw counts?"),
        ("frames swapped", ["--image", *raw, "--white", *dark, "--dark", *white], 1, "are white and dark swapped?"),
        ("image and white swapped", ["--image", *white, "--white", *raw, "--dark", *dark], 1, "are they raw counts?"),
        ("image and dark swapped", ["--image", *dark, "--white", *white, "--dark", *raw], 1, "are they raw counts?"),
        ("all saturated", ["--image", *raw, *flat, "--saturation", "1e-9"], 1, "no pixel of the image has finite responses"),
        ("some saturated", ["--image", *raw, *flat, "--saturation", "0.0475"], 0, ""),
        ("in counts of 16 bit", ["--image", *raw, "--white-level", "1e-4"], 1, "are they raw counts?"))
    for name, arguments, status, part in cases:
        shutil.rmtree(base / "said", ignore_errors=True)
        got, stderr, stdout, page = estimate(launcher, base / "said", *arguments)
        if got != status or part not in stderr:
            faults.append(f"{name}: expected status {status} and '{part}', got {got} and {stderr.strip()}")
        if status == 0 and ("class='warning'" in page) != bool(part) or status != 0 and page:
            faults.append(f"{name}: the report {'does not warn' if status == 0 else 'is there'}")
        if ("% of the pixels have no result" in stdout) != (name == "some saturated"):
            faults.append(f"{name}: the pixels without a result: {stdout}")


def written(launcher, base):
    from PIL import Image, ImageCms
    output = base / "written"
    got, stderr, stdout, page = estimate(
        launcher, output, "--image", *stack(), "--white", *stack("white"), "--dark", *stack("dark"),
        "--tuning", root / "Data" / "Samples" / "demo-fabric.csv", "--labels", FOLDER / "labels.png",
        "--patches", FOLDER / "patches.csv", "--cube", "envi", "--illuminant", "A", "LED-B3", "--observer", "10",
        "--difference", "cie76")
    if got != 0 or stderr:
        faults.append(f"estimate: status {got}: {stderr}")
        return
    picture = Image.open(output / "srgb.png")
    if picture.size != Image.open(FOLDER / "labels.png").size:
        faults.append(f"srgb.png has {picture.size} pixels")
    import io
    profile = ImageCms.ImageCmsProfile(io.BytesIO(picture.info.get("icc_profile", b"")))
    if "sRGB" not in ImageCms.getProfileDescription(profile):
        faults.append("srgb.png has no sRGB profile")
    # rgb.png shows the same colors, each pixel enlarged.
    shown = np.asarray(Image.open(output / "rgb.png"))
    scale = shown.shape[0] // picture.size[1]
    if (np.asarray(picture) != shown[::scale, ::scale]).any():
        faults.append("srgb.png and rgb.png differ")
    import spectral  # another program's reader
    cube = spectral.open_image(str(output / "reflectance.hdr"))
    if cube.shape != (picture.size[1], picture.size[0], 31):
        faults.append(f"the ENVI cube is {cube.shape}")
    for name in ("error-dEab-A.png", "error-dEab-LED-B3.png", "out-of-range.png", "uncertainty.png", "state.pvsm", "chart-alone.png",
                 "error-chart-alone.png"):
        if not (output / name).is_file():
            faults.append(f"there is no {name}")
    for part in ("class='lead'>The 24 held-out patches differ from their measurement by \u0394E*ab ",
                 " with the chart&#x27;s calibration alone (A, 10 degree observer; ", "Before and after", "% of the pixels have responses outside"):
        if part not in page:
            faults.append(f"the report does not say {part}")
    if "% of the pixels have responses outside" not in stdout:
        faults.append("the share of pixels outside of the range is not told")


def own_lamp(launcher, base):
    """A lamp and an observer from files; files that are none of these."""
    lamp, observer = base / "gallery lamp.csv", base / "observer.csv"
    tables = root / "Data" / "Tables"
    lamp.write_text((tables / "illuminant_A.csv").read_text())
    observer.write_text((tables / "observer_CIE1964_10deg.csv").read_text())
    common = ["--image", *stack(), "--white", *stack("white"), "--dark", *stack("dark"), "--tuning",
              root / "Data" / "Samples" / "demo-fabric.csv", "--labels", FOLDER / "labels.png", "--patches",
              FOLDER / "patches.csv", "--difference", "cie76"]
    got, stderr, _, page = estimate(launcher, base / "lamp", *common, "--illuminant", lamp, "--observer", observer)
    if got != 0 or "measurement by \u0394E*ab" not in page or ", observer observer; " not in page:
        faults.append(f"a lamp from a file: status {got}: {stderr}")
        return
    # Its table is that of A, so are the errors.
    errors = [[row.split(",")[2:] for row in (base / folder / "errors-of-patches.csv").read_text().splitlines() if kind in row]
              for folder, kind in (("written", "dEab,A,"), ("lamp", "dEab,"))]
    if len(errors[0]) != 1 or not np.allclose(*(np.array(rows, float) for rows in errors), rtol=1e-6):
        faults.append(f"a lamp from a file gives other errors: {errors}")
    if not (base / "lamp" / "error-dEab-gallery-lamp.png").is_file():
        faults.append("the error map under a lamp from a file is not there")
    negative, text = base / "negative.csv", base / "text.csv"
    negative.write_text("wavelength,power\n380,1\n560,-1\n780,1\n")
    text.write_text("wavelength,power\n380,1\n560,many\n780,1\n")
    for options, part in ((["--illuminant", negative], "has the power -1 at 560 nm; expected"),
                          (["--illuminant", text], "text.csv:3:5: "), (["--observer", lamp], "1 curve beside the wavelength"),
                          (["--illuminant", base / "none.csv"], "none.csv: no such file"),
                          (["--illuminant", "F13"], "'F13' is no illuminant; expected A, C, D50")):
        got, stderr, _, _ = estimate(launcher, base / "bad-lamp", *common, *options)
        if got == 0 or part not in stderr or stderr.count("\n") != 1:
            faults.append(f"{options}: status {got}, expected '{part}': {stderr}")


def other_commands(launcher, base):
    """They take lamps, observers and what the frames were taken with, too, and begin their report with the result."""
    fabric = root / "Data" / "Samples" / "demo-fabric.csv"

    def lead(name, *arguments):
        done = subprocess.run([launcher, *map(str, arguments), "--output", base / name], text=True, capture_output=True)
        page = base / name / "report.html"
        return page.read_text(encoding="utf-8").partition("class='lead'>")[2].partition("<")[0] if done.returncode == 0 else done.stderr
    under = ["--illuminant", "A", "--observer", "10", "--difference", "cie94"]
    chart = ["chart", "--image", *stack(), "--white", *stack("white"), "--dark", *stack("dark"), "--chart", "4x6", "--reference",
             FOLDER / "patches.csv"]
    for name, arguments, parts in (
            ("evaluate", ["evaluate", "--calibration", CHART, "--target", fabric, "--draws", "1", "--methods", "direct,transfer", *under],
             ["The method transfer has the least", "mean \u0394E94 ", " (A, 10 degree observer) against "]),
            ("demo", ["demo", *under], ["16 measured swatches reduce", "from \u0394E94 ", "(A, 10 degree observer)."]),
            ("choose", ["choose", "--calibration", CHART, "--candidates", fabric, "--count", "1"],
             ["Measure this 1 sample: it explains ", " % of the expected error"]),
            ("chart", chart, ["24 of 24 patches seen"]),
            ("exposed", [*chart, "--exposure", "2", "--white-exposure", "1"], ["24 of 24 patches seen"]),
            ("saturated", [*chart, "--saturation", "1e-9"], ["the image has no value above 0"])):
        if not all(part in (text := lead(name, *arguments)) for part in parts):
            faults.append(f"{name}: expected {parts}: {text}")
    responses = [np.genfromtxt(base / name / "chart.csv", delimiter=",", names=True)["C400"] for name in ("chart", "exposed")]
    if not np.allclose(responses[0], 2.0 * responses[1], rtol=1e-5):
        faults.append("chart: twice the exposure does not halve the responses")


def few_samples(launcher, base):
    """Methods that do with fewer samples than they would like say so, and what they did."""
    flat = ["--image", *stack(), "--white", *stack("white"), "--dark", *stack("dark"), "--trust-responses"]

    def first(count, source, name):
        path = base / name
        path.write_text("".join(source.read_text(encoding="utf-8").splitlines(True)[:count + 1]), encoding="utf-8")
        return path
    chart = first(3, CHART, "three-of-the-chart.csv")
    fabric = root / "Data" / "Samples" / "demo-fabric.csv"
    for method, tuning, part in (
            # Four samples carry three components and a mean.
            ("pca", 1, "pca: 3 components, tuning weight 1, taken as given: 1 tuning sample is too few to choose; expected at least 3"),
            ("direct", 2, "undetermined: the 3 samples have rank 3 but a band has 17 unknowns; the transform of least norm was taken")):
        got, stderr, _, page = estimate(launcher, base / "few", *flat, "--calibration", chart, "--tuning",
                                        first(tuning, fabric, "few.csv"), "--method", method)
        if got != 0 or part not in stderr or part not in page:
            faults.append(f"{method} of few samples: status {got}, expected '{part}': {stderr}")


def register(launcher, base):
    """Channels that are moved by whole pixels are found and put back; a table of displacements does the same."""
    import csv
    from PIL import Image
    import spectral

    def pixels(path):
        return np.asarray(Image.open(path)).astype(np.float64)
    moves = {3: (2, -1), 7: (-3, 2)}  # channel: to the right, upward
    straight, moved = [], []
    for k, (raw, white, dark) in enumerate(zip(stack(), stack("white"), stack("dark"))):
        dark_level = pixels(dark)
        response = (pixels(raw) - dark_level) / (pixels(white) - dark_level)
        right, up = moves.get(k, (0, 0))
        for files, values in ((straight, response), (moved, np.roll(response, (-up, right), (0, 1)))):
            files.append(base / f"{'moved' if files is moved else 'straight'}_{raw.name}")
            Image.fromarray(values.astype(np.float32)).save(files[-1])
    table = base / "displacements.csv"
    runs = {"straight": (straight, ["--register"]), "found": (moved, ["--register"]), "given": (moved, ["--register", table])}
    cubes, places = {}, {}
    for name, (files, options) in runs.items():
        got, stderr, _, page = estimate(launcher, base / name, "--image", *files, "--cube", "envi", *options)
        if got != 0 or "How the channels lay" not in page:
            faults.append(f"register, {name}: status {got}: {stderr}")
            return
        cubes[name] = np.asarray(spectral.open_image(str(base / name / "reflectance.hdr")).load())
        if name != "given":
            shutil.copy(base / name / "displacements.csv", table)
            with open(table, newline="", encoding="utf-8") as file:
                places[name] = np.array([[float(row["x"]), float(row["y"])] for row in csv.DictReader(file)])
    # The relief of the fabric moves edges by up to .15 pixels between channels: only what was planted on top is known.
    expected = np.zeros_like(places["found"])
    for k, move in moves.items():
        expected[k] = move
    if np.abs(places["found"] - places["straight"] - expected).max() > 0.05:
        faults.append(f"displacements found: {places['found'] - places['straight']}")
    if not np.array_equal(cubes["found"], cubes["given"], equal_nan=True):
        faults.append("displacements from a file give another reflectance")
    inside = np.s_[8:-8, 8:-8]
    error = np.sqrt(np.mean((cubes["found"][inside] - cubes["straight"][inside]) ** 2))
    if not error < 0.01:
        faults.append(f"the registered image differs from the one that was never moved by {error:.4f}")
    if not np.isnan(cubes["found"][0]).all() and not np.isnan(cubes["found"][-1]).all():
        faults.append("rows that a channel does not show have a reflectance")
    table.write_text("channel,x,y\n400,0,0\n")
    for options, part in ((["--register", table], "expected channel, x, y, magnification, rotation"),
                          (["--register", base / "none.csv"], "none.csv: no such file")):
        got, stderr, _, _ = estimate(launcher, base / "bad-table", "--image", *moved, *options)
        if got == 0 or part not in stderr or stderr.count("\n") != 1:
            faults.append(f"{options}: status {got}, expected '{part}': {stderr}")


def white_reflectance(launcher, base):
    """Half the white's reflectance is half the image's responses: exposures do the same."""
    import spectral
    means = []
    flat = ["--image", *stack(), "--white", *stack("white"), "--dark", *stack("dark"), "--cube", "envi"]
    for i, options in enumerate((["--white-reflectance", "0.5"], ["--exposure", "2", "--white-exposure", "1"], [])):
        output = base / (f"white-{i}" if i < 2 else "written")  # where a run with labels has written
        got, stderr, _, _ = estimate(launcher, output, *flat, *options)
        if got != 0:
            faults.append(f"{options}: status {got}: {stderr}")
            return
        means.append(np.asarray(spectral.open_image(str(output / "reflectance.hdr")).load()))
    left = sorted(path.name for path in output.iterdir() if path.name.startswith(("error", "patches", "metamerism")))
    if left:
        faults.append(f"a run without labels leaves {left} of the run before")
    if not np.allclose(means[0], means[1], atol=1e-5) or np.allclose(means[0], means[2], atol=1e-2):
        faults.append("white reflectance and exposure times do not act as they should")


def main():
    launcher, base = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    shutil.rmtree(base, ignore_errors=True)
    base.mkdir(parents=True)
    for test in (said, other_commands, few_samples, written, own_lamp, register, white_reflectance):
        test(launcher, base)
    print("\n".join(faults) or "what is wrong is said, what is written is right")
    sys.exit(1 if faults else 0)


main()
