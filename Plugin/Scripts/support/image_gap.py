"""The gap of an image pair: a real and a simulated image of the same scene, in a capture's folder images/."""

import os
import re

from paraview import servermanager

from . import command, diagnosis, estimation, gap_pictures, pipeline, report
from .command import Failure

# The outputs of Image Sim To Real Gap.
PORTS = {"map": 0, "summary": 1, "where": 2, "causes": 3, "candidates": 4, "notes": 5}
_KINDS = {"real": "real", "sim": "simulated", "labels": "labels", "patches": "patches"}
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
    found["camera"] = [path for path in (os.path.join(folder, name) for name in _CAMERAS)
                       if os.path.exists(path)][:1]
    if not any(found[kind] for kind in _KINDS.values()):
        return None
    if not found["real"]:
        raise Failure(f"{place}: there is no real image; expected real*: a file, one file a channel, or a folder of "
                      "such files")
    if not found["simulated"]:
        missing = [name for name, kind in (("images/labels.png", "labels"), ("images/patches.csv", "patches"),
                                           ("camera.csv", "camera")) if not found[kind]]
        if missing:
            raise Failure(f"{place}: there is no simulated image; expected sim*: a file, one file a channel, or a folder "
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
    return diagnosis.Diagnosis(gap, PORTS)


def write(gap, folder):
    diagnosis.write(gap, folder)
    image = servermanager.Fetch(gap.port("map"), idx=PORTS["map"])
    if command.rank() == 0:
        gap_pictures.draw_map(image, folder)


def sections(gap, folder):
    return [report.text("The images", "The real and the simulated image of the capture, pixel by pixel. The "
                        "figures below are of blocks of pixels that took no part in finding the effects."),
            *diagnosis.sections(gap, folder)]
