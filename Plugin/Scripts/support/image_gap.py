"""The gap of an image pair: a real and a simulated image of the same scene, in a capture's folder images/."""

import os
import re

from . import command, diagnosis, estimation, gap_pictures, outputs, pipeline, report
from .command import Failure

# The outputs of Image Sim To Real Gap.
PORTS = {"map": 0, "summary": 1, "where": 2, "causes": 3, "candidates": 4, "notes": 5}
_KINDS = {"real": "real", "sim": "simulated", "labels": "labels", "patches": "patches"}
AXES = {
    "position": "the gap depends on the place in the field (x from -1 at the left to 1 at the right, y from -1 at the bottom to 1 at "
                "the top, over the longer side)",
    "level": "the gap changes with the signal: bright and dark places differ",
    "sample": "single labelled patches stand out",
}
# What to do about a gap that no effect of a lens, a lamp's place or a detector explains.
NEXT = {
    "sample": "The remaining gap differs from patch to patch, as where the lamp, the filters or the measured reflectance differ from the "
              "simulation. Diagnose the patches as a table (samples.csv and responses.csv in the capture), which covers the effects of "
              "light and filters.",
    "region": "The remaining gap lies in single regions: look for reflections, shadows and dirt there on the map.",
    "edges": "The remaining gap lies along edges, as with a point spread that is not round, or one that changes over the field. Capture a "
             "grid target through each filter.",
    "position": "The remaining gap changes smoothly over the field, but neither as a plane of light nor as a lens's vignetting: capture a "
                "flat field.",
    "channel": "The remaining gap differs from channel to channel: capture a gray ramp, which separates gains, offsets and the spectrum of "
               "the lamp.",
    "level": "The remaining gap changes with the signal: capture an exposure series of one patch.",
    "rows": "The remaining gap changes from row to row, but not uniformly along a row: capture a flat field at two exposure times.",
    "columns": "The remaining gap changes from column to column, but not uniformly along a column: capture a flat field at two exposure "
               "times.",
}
_CAMERAS = ("camera.json", "camera.csv")


def pair(folder):
    """{"real": files, "simulated": files, "labels": files, "patches": files, "camera": files}, or None where the
    capture has no images.

    An entry of images/ that begins with real, sim, labels or patches is such an image or table: a file, one of
    several files (one a channel), or a folder of them. Without simulated image the measured patches are
    simulated with the capture's camera."""
    place = os.path.join(folder, "images")
    if not os.path.isdir(place):
        return None
    found = {kind: [] for kind in _KINDS.values()}
    for name in sorted(os.listdir(place), key=_natural):
        kind = next((kind for start, kind in _KINDS.items() if name.lower().startswith(start)), None)
        if kind:
            found[kind] += _files(os.path.join(place, name))
    found = {kind: _without_data_files(files) for kind, files in found.items()}
    found["camera"] = [path for path in (os.path.join(folder, name) for name in _CAMERAS)
                       if os.path.exists(path)][:1]
    if not any(found[kind] for kind in _KINDS.values()):
        return None
    if not found["real"]:
        raise Failure(f"{place}: there is no real image; expected real*: a file, one file per channel, or a folder of "
                      "such files")
    if not found["simulated"]:
        missing = [name for name, kind in (("images/labels.png", "labels"), ("images/patches.csv", "patches"),
                                           ("camera.csv", "camera")) if not found[kind]]
        if missing:
            raise Failure(f"{place}: there is no simulated image; expected sim*: a file, one file per channel, or a folder "
                          f"of such files; or a chart to simulate, for which {' and '.join(missing)} "
                          f"{'is' if len(missing) == 1 else 'are'} missing")
    return found


def _natural(name):
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]


def _files(path):
    if not os.path.isdir(path):
        return [path]
    return [os.path.join(path, name) for name in sorted(os.listdir(path), key=_natural)
            if not name.startswith(".")]


def _without_data_files(files):
    """An ENVI header stands for the data beside it."""
    headers = {os.path.splitext(path)[0] for path in files if path.lower().endswith(".hdr")}
    return [path for path in files if path.lower().endswith(".hdr")
            or not {path, os.path.splitext(path)[0]} & headers]


def simulated(images, labels):
    """The simulated image as it is given, or the chart as the capture's camera sees it: patches, nothing between."""
    if images["simulated"]:
        return estimation.read_image(images["simulated"])
    patches = pipeline.create("SampleTableReader", FileName=images["patches"][0])
    chart = pipeline.create("PatchReferenceImage", Input=labels, PatchTable=patches)
    camera = pipeline.create("CameraReader", FileName=images["camera"][0])
    return pipeline.create("CameraSimulator", Input=chart, Camera=camera, Effects="None (ideal camera)",
                           Noise="None")


def diagnose(images, **options):
    labels = (pipeline.create("LabelImageReader", FileName=images["labels"][0])
              if images["labels"] else None)
    inputs = {"Real": estimation.read_image(images["real"]), "Simulated": simulated(images, labels)}
    if labels:
        inputs["Labels"] = labels
    gap = pipeline.create("ImageSimToRealGap", **inputs, **options)
    pipeline.update(gap)
    return diagnosis.Diagnosis(gap, PORTS, "blocks of pixels", AXES)


def write(gap, folder):
    diagnosis.write(gap, folder)
    image = pipeline.fetch(gap.port("map"))
    summary = pipeline.fetch(gap.port("summary"))
    if command.rank() == 0:
        gap_pictures.draw_map(image, folder)
        write_effects(summary, os.path.join(folder, "effects.json"))


def write_effects(summary, path):
    """The effects that were found, as Camera Simulator and `camera --effects` take them; none: no file."""
    effects = summary.GetFieldData().GetAbstractArray("Effects") if summary else None
    text = effects.GetValue(0) if effects and effects.GetNumberOfValues() else ""
    if text.strip(" \n[]"):
        outputs.write_text(path, text.rstrip() + "\n")
    else:
        outputs.remove(path)


def sections(gap, folder):
    pages = [report.text("The images", "The real and the simulated image of the capture, pixel by pixel. The "
                         "figures below are of blocks of pixels that took no part in finding the effects."),
             *diagnosis.sections(gap, folder)]
    figures = gap.summary()
    axis = figures.get("unexplained_where", "").split(" ")[0] if figures else ""
    words = []
    left = figures and figures["verdict"] in ("unexplained", "partly explained") and figures["shrink"] < diagnosis.FITS
    if left and axis in NEXT:
        words.append(NEXT[axis])
    if os.path.exists(os.path.join(folder, "effects.json")):
        words.append("effects.json holds the effects that were found: give it to Camera Simulator as its Effect File, or to "
                     "./multispectral camera as --effects, and the simulated camera has them. report.json holds this page as "
                     "data.")
    if words:
        pages.append(report.text("What to do next", *words))
    return pages
