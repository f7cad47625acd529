"""The gap of an image pair: a real and a simulated image of the same scene, in a capture's folder images/."""

import os
import re

from paraview import servermanager

from . import command, diagnosis, estimation, gap_pictures, pipeline, report
from .command import Failure

# The outputs of Image Sim To Real Gap.
PORTS = {"map": 0, "summary": 1, "where": 2, "causes": 3, "candidates": 4, "notes": 5}
_KINDS = {"real": "real", "sim": "simulated", "labels": "labels"}


def pair(folder):
    """{"real": files, "simulated": files, "labels": files}, or None where the capture has no images.

    An entry of images/ that begins with real, sim or labels is such an image: a file, one of several files (one a
    channel), or a folder of them."""
    place = os.path.join(folder, "images")
    if not os.path.isdir(place):
        return None
    found = {kind: [] for kind in _KINDS.values()}
    for name in sorted(os.listdir(place), key=_natural):
        kind = next((kind for start, kind in _KINDS.items() if name.lower().startswith(start)), None)
        if kind:
            found[kind] += _files(os.path.join(place, name))
    if not any(found.values()):
        return None
    for kind in ("real", "simulated"):
        if not found[kind]:
            raise Failure(f"{place}: there is no {kind} image; expected real* and sim*, each a file, one file "
                          "a channel, or a folder of such files")
    return found


def _natural(name):
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]


def _files(path):
    if not os.path.isdir(path):
        return [path]
    return [os.path.join(path, name) for name in sorted(os.listdir(path), key=_natural)
            if not name.startswith(".")]


def diagnose(images, **options):
    inputs = {"Real": estimation.read_image(images["real"]),
              "Simulated": estimation.read_image(images["simulated"])}
    if images["labels"]:
        inputs["Labels"] = pipeline.create("LabelImageReader", FileName=images["labels"][0])
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
