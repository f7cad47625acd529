"""What a view shows of the plugin's sources at first, where ParaView's own choice would mislead: images lie one upon another, tables
begin with the columns whose names come first in the alphabet, a cube is seen along its depth."""

from PyQt5 import QtCore, QtWidgets
from paraview import simple

from . import view_choice

# Columns that tell what a row is, and the result, in the order in which they are read.
_LEADING = ("method", "rank", "sample", "label", "medium", "effect", "form", "axis", "cell", "name", "value", "unit", "standard_error", "probability",
            "share", "shrink", "metric", "illuminant", "count", "mean", "median", "p95", "max", "channel", "wavelength",
            "dx", "dy", "agreement")

_seen = set()  # global ids of displays
_ordered = {}  # the columns that each table showed when they were put in order


def adapt(window):
    for view in simple.GetRenderViews():
        shown = [display for display in view.Representations if getattr(display, "Visibility", 0) and _is_image_of_ours(display)]
        new = [display for display in shown if display.SMProxy.GetGlobalID() not in _seen]
        if new:
            _seen.update(display.SMProxy.GetGlobalID() for display in shown)
            _show_last(view, shown, new[-1])
    for table in window.findChildren(QtWidgets.QTableView):
        if table.metaObject().className() == "pqSpreadSheetViewWidget":
            order_columns(table)


def _is_image_of_ours(display):
    source = getattr(display, "Input", None)
    return source is not None and view_choice.is_ours(source) and \
        source.GetDataInformation(source.Port).GetDataSetTypeAsString() == "vtkImageData"


def _show_last(view, shown, last):
    """Two pictures in one place are one wrong picture, and a legend tells of the one below: the last one stays."""
    after_cube = False
    for display in shown:
        if display is not last and _overlap(display, last):
            display.SetScalarBarVisibility(view, False)
            display.Visibility = 0
            after_cube = after_cube or _is_cube(display)
    if _is_cube(last):
        _show_cube(view, last)
    elif after_cube:
        view.InteractionMode = "2D"
        view.ResetActiveCameraToNegativeZ()
        simple.ResetCamera(view)
    simple.Render(view)


def _is_cube(display):
    return display.Input.SMProxy.GetXMLName() == "SpectralCubeVolume"


def _show_cube(view, display):
    """From three sides, with the spectra on its faces; ParaView leaves a volume without colors."""
    if not display.ColorArrayName[1]:
        simple.ColorBy(display, ("POINTS", display.Input.PointData.GetArray(0).Name))
        display.SetScalarBarVisibility(view, True)
    view.InteractionMode = "3D"
    view.ResetActiveCameraToNegativeZ()
    view.ApplyIsometricView()
    simple.ResetCamera(view)


def _overlap(a, b):
    boxes = [display.Input.GetDataInformation(display.Input.Port).GetBounds() for display in (a, b)]
    moved = any(tuple(getattr(display, "Position", (0, 0, 0))) != (0, 0, 0) for display in (a, b))
    return not moved and all(boxes[0][2 * i] < boxes[1][2 * i + 1] and boxes[1][2 * i] < boxes[0][2 * i + 1] for i in range(2))


def order_columns(table):
    """Once for each set of columns: the user may move them afterwards."""
    header, model = table.horizontalHeader(), table.model()
    names = tuple(str(model.headerData(i, QtCore.Qt.Horizontal)) for i in range(header.count())) if model is not None else ()
    if not names or _ordered.get(table) == names:
        return
    _ordered[table] = names
    place = 0
    for name in _LEADING:
        if name in names:
            header.moveSection(header.visualIndex(names.index(name)), place)
            place += 1
