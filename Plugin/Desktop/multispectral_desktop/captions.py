"""What stands over a map of errors: the mean of what it shows. It follows the map, as the user changes what the map comes from."""

import math
import os
import re

from paraview import servermanager, simple

from . import lights, memory, pixel

_CAPTION = re.compile(r"Errors(: (mean|not shown).*)?")


def adapt(changed):
    """changed: whether any data have changed."""
    for view in simple.GetRenderViews():
        displays = [display for display in view.Representations if getattr(display, "Input", None) is not None]
        captions = [display.Input for display in displays
                    if display.Input.SMProxy.GetXMLName() == "TextSource" and _CAPTION.fullmatch(display.Input.Text)]
        maps = [display for display in displays if display.Input.SMProxy.GetXMLName() == "CIEDE2000Evaluator" and display.Visibility]
        if len(captions) != 1 or len(maps) != 1:
            continue
        array, record = maps[0].ColorArrayName[1], memory.of(captions[0])
        before = record.get("array", array)
        if not changed and before == array:
            continue
        record["array"] = array
        if before != array:
            place_legend(array, view)
        text = of(maps[0].Input, array)
        if captions[0].Text != text:
            captions[0].Text = text
            simple.RenameSource(text, captions[0])
            simple.Render(view)


def place_legend(array, view):
    """Beside the image, as high as the view allows."""
    legend = simple.GetScalarBar(simple.GetColorTransferFunction(array), view)
    legend.WindowLocation = "Any Location"
    legend.Position = [0.84, 0.1]
    legend.ScalarBarLength = 0.7


def of(errors, array):
    """errors: a CIEDE2000 Evaluator; array: which of its maps, as "dE00 D65"."""
    name, _, light = array.partition(" ")
    if name in pixel.SPECTRA:
        return f"Errors: not shown, but {name}"
    mean = mean_of(errors, name, light)
    if mean is None or math.isnan(mean):
        return "Errors"
    conditions = ", ".join(filter(None, (light, light and observer_of(errors))))
    title = "\u0394" + name[1:] if name.startswith("dE") else name
    text = f"Errors: mean {title} {mean:.{2 if light else 4}f}"
    return text + (f" ({conditions})" if conditions else "")


def observer_of(source):
    """In a word; empty for the usual one."""
    file, name = (source.SMProxy.GetProperty(name).GetElement(0) for name in ("ObserverFile", "Observer"))
    table = source.ObserverTable
    name = table.FileNames[0] if table is not None and hasattr(table, "FileNames") else file or name
    return "" if name == lights.OBSERVER else lights.OBSERVERS.get(name, os.path.splitext(os.path.basename(name))[0])


def mean_of(errors, metric, light):
    """Over all pixels with a reference; None where it was not computed."""
    if errors.GetDataInformation(1).GetNumberOfRows() == 0:
        return None
    summary = servermanager.Fetch(errors, idx=1)
    metrics, illuminants, means = (summary.GetColumnByName(name) for name in ("metric", "illuminant", "mean"))
    return next((means.GetValue(row) for row in range(summary.GetNumberOfRows())
                 if (metrics.GetValue(row), illuminants.GetValue(row)) == (metric, light)), None)
