"""Captures with parts missing or inconsistent, and what is said about them."""

import os
import pathlib
import shutil

root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
DEMO = root / "Data" / "Captures" / "demo-warm-camera"
IMAGE = root / "Data" / "Images" / "demo-fabric"


def edited(folder, name, **changes):
    """A copy of the demo capture; changes: {file stem: what becomes of its lines, or None to leave it out}."""
    place = folder / name
    shutil.copytree(DEMO, place)
    for stem, change in changes.items():
        file = next(place.glob(f"{stem}.*"))
        if change is None:
            file.unlink()
        else:
            lines = change(file.read_text(encoding="utf-8").splitlines())
            file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return place


def cut(*columns):
    """Leaves the named columns out."""
    def change(lines):
        keep = [i for i, name in enumerate(lines[0].split(",")) if name not in columns]
        return [",".join(line.split(",")[i] for i in keep) for line in lines]
    return change


def first_repeat(lines):
    return [line for line in lines if line.split(",")[1] in ("repeat", "1")]


def rows(change):
    """Changes the numbers of each line from the first spectral column on."""
    def edit(lines):
        start = next(i for i, name in enumerate(lines[0].split(",")) if name[0] in "RC")
        result = [lines[0]]
        for line in lines[1:]:
            cells = line.split(",")
            result.append(",".join(cells[:start] + [f"{change(float(cell)):.5f}" for cell in cells[start:]]))
        return result
    return edit


def no_noise(_):
    return ['{"name": "x", "white_level": 1, "dark": 0, "noise": {"read": null, "shot": null}}']


def refused(folder):
    """Captures that end with one line, and what it says."""
    yield folder / "nowhere", "nowhere: is no folder"
    yield edited(folder, "no-json", capture=None), "capture.json: cannot be read"
    yield edited(folder, "no-camera", camera=None), "camera.csv: cannot be read"
    yield edited(folder, "no-samples", samples=None), "samples.csv: cannot be read"
    yield edited(folder, "no-responses", responses=None), "responses.csv: cannot be read"
    yield edited(folder, "fewer-channels", responses=cut("C16")), \
        "responses.csv: has 15 channels; expected 16, as camera.csv has"
    yield edited(folder, "unknown-sample", samples=lambda lines: lines[:-1]), "is not in samples.csv"
    yield edited(folder, "twice", samples=lambda lines: [*lines, lines[-1]]), "stands in it twice"
    yield edited(folder, "text", responses=lambda lines: [
        lines[0], lines[1].rsplit(",", 1)[0] + ",bright", *lines[2:]]), "responses.csv:2:"
    yield edited(folder, "dark", capture=lambda _: ['{"dark": [0.1, 0.2]}']), "'dark' has 2 values"
    yield edited(folder, "broken-json", capture=lambda _: ['{"dark": ']), "the JSON text ends too early"
    yield edited(folder, "uneven", camera=lambda lines: lines[:3] + lines[4:]), "a uniform grid"
    yield edited(folder, "counts", responses=rows(lambda u: 4000 * u)), "looks like counts"
    pair = edited(folder, "one-image")
    (pair / "images" / "real").mkdir(parents=True)
    shutil.copy(IMAGE / "channel_400nm.tif", pair / "images" / "real")
    yield pair, "images: there is no simulated image; expected sim*"
    yield edited(folder, "one-sample", samples=lambda lines: lines[:2],
                 responses=lambda lines: lines[:3]), "5 samples or more"


def undecided(folder):
    """Captures that are diagnosed all the same, and what the report says about what is missing."""
    yield edited(folder, "one-repeat", capture=no_noise, responses=first_repeat), \
        "No noise model and one reading a sample"
    yield edited(folder, "repeats-decide", capture=no_noise), "The noise comes from the repeats"
    yield edited(folder, "one-medium", samples=lambda lines: [
        line.replace(",paper,", ",fabric,") for line in lines]), "One medium only"
    yield edited(folder, "no-medium", samples=cut("medium")), "The samples name no medium"
    yield edited(folder, "no-positions", samples=cut("x", "y")), "No positions"
    yield edited(folder, "no-order", samples=cut("order")), "No capture order"
    yield edited(folder, "few-samples", samples=lambda lines: lines[:9],
                 responses=lambda lines: lines[:17]), "8 samples are few"
    yield edited(folder, "grey", samples=rows(lambda _: 0.5)), "hardly change with wavelength"
    yield edited(folder, "saturated", responses=rows(lambda u: min(u, 0.4))), "they look clipped"
    yield edited(folder, "white-level", capture=lambda lines: [
        line.replace('"white_level": 1', '"white_level": 4000') for line in lines],
        responses=rows(lambda u: 4000 * u)), None
