"""What a view shows of the plugin's sources at first, where ParaView's own choice would mislead: images lie one upon another, tables
begin with the columns whose names come first in the alphabet, a cube is seen along its depth."""

from PyQt5 import QtCore, QtWidgets
from paraview import simple

from . import memory, pixel, view_choice
from .memory import first, key

# Columns that tell what a row is, and the result, in the order in which they are read.
_LEADING = ("verdict", "rms_before", "rms_after", "noise_floor",
            "method", "rank", "sample", "label", "title", "medium", "effect", "form", "axis", "cell", "share", "probability", "shrink", "unknown_probability", "name", "parameter",
            "value", "unit", "standard_error", "metric", "illuminant", "count", "mean", "median", "p95", "max", "channel", "wavelength",
            "dx", "dy", "agreement")

_LOOKS = 6  # at a spreadsheet that an image was taken from, while it shows a table


def listen(window):
    """To the button Apply."""
    button = window.findChild(QtWidgets.QAbstractButton, "Accept")
    if button is not None:
        button.clicked.connect(lambda: QtCore.QTimer.singleShot(0, _try_again))


def keep():
    """After a state file was read: its views are as a user has left them."""
    for view in simple.GetViews():
        for display in getattr(view, "Representations", ()):
            memory.of(display).update(seen=True, adapted=True)
            if getattr(display, "Input", None) is not None:
                first("shown", display.Input, display.Input.Port)


def adapt(window):
    """Twice a second: what Python has to make of ParaView's objects, it makes once."""
    content = [(view, list(view.Representations)) for view in simple.GetViews() if hasattr(view, "Representations")]
    _take_images_out_of_tables(content)
    _fill_tables(content)
    for view, displays in content:
        if view.SMProxy.GetXMLName() != "RenderView":
            continue
        if _replace_failed(view, displays):
            displays = list(view.Representations)
        shown = [display for display in displays if getattr(display, "Visibility", 0) and _is_image_of_ours(display)]
        new = [display for display in shown if first("seen", display)]
        if new:
            _show_last(view, shown, new[-1])
            memory.of(view)["fitted"] = _camera(view)
        _fit_to_size(view)
    if any(view.SMProxy.GetXMLName() == "SpreadSheetView" for view, _ in content):
        for table in window.findChildren(QtWidgets.QTableView):
            if table.metaObject().className() == "pqSpreadSheetViewWidget":
                order_columns(table)


def _type(display):
    return display.Input.GetDataInformation(display.Input.Port).GetDataSetTypeAsString()


def _is_ours(display):
    source = getattr(display, "Input", None)
    return source is not None and view_choice.is_ours(source)


def _is_empty(display):
    return display.Input.GetDataInformation(display.Input.Port).GetNumberOfPoints() == 0


def _is_image_of_ours(display):
    return _is_ours(display) and _type(display) == "vtkImageData" and not _is_empty(display)


def _take_images_out_of_tables(content):
    """Of several sources that are applied at once, ParaView shows all in the view of the last one: where that is a spreadsheet, images
    become tables of their pixels. Who shows an image in a spreadsheet later has seen it before. One look later, when all are applied."""
    for view, displays in content:
        for display in displays:
            source = getattr(display, "Input", None)
            if memory.of(display).pop("misplaced", False):
                _move(display, view)
            elif source is not None and first("shown", source, source.Port) and view.SMProxy.GetXMLName() == "SpreadSheetView":
                memory.of(display)["misplaced"] = _is_image_of_ours(display)


def _move(display, table):
    image = view_choice.free_view("RenderView")
    if image is not None:
        display.Visibility = 0
        simple.Show(display.Input, image)
        memory.of(table)["looks"] = _LOOKS


def _fill_tables(content):
    """A spreadsheet that an image was taken from shows the table that was applied with it. ParaView may empty it again while it still
    applies, however long that takes."""
    for table, displays in content:
        record = memory.of(table)
        if record.get("looks", 0) == 0:
            continue
        tables = [display for display in displays if _is_ours(display) and _type(display) == "vtkTable"]
        if any(display.Visibility for display in displays):
            record["looks"] -= 1
        elif tables:
            active = simple.GetActiveSource()
            applied = [display for display in tables if active is not None and key(display.Input) == key(active)]
            (applied or tables)[-1].Visibility = 1
            simple.Render(table)


def _replace_failed(view, displays):
    """A filter that failed has a display without an array, which would stay empty when the filter succeeds later. Until then its input
    is shown, which ParaView has hidden. Whether a display was replaced."""
    replaced = False
    for display in displays:
        # Those that had an image keep it.
        record = memory.of(display)
        if "seen" in record or not _is_ours(display) or _type(display) != "vtkImageData":
            continue
        if _is_empty(display):
            if display.Visibility and first("failed", display):
                display.Visibility = 0
                record["inputs"] = _inputs(display.Input)
                _show_input_of(display, view)
        elif record.pop("failed", False):
            source, replaced = display.Input, True
            simple.Delete(display)
            simple.Show(source, view)
    return replaced


def _try_again():
    """After Apply: ParaView does not run what no view shows. Where an input was chosen, ParaView has selected that."""
    active, again = simple.GetActiveSource(), {}
    for view in simple.GetRenderViews():
        for display in view.Representations:
            record = memory.of(display)
            if "failed" in record and (active is not None and key(display.Input) == key(active) or
                                       record["inputs"] != _inputs(display.Input)):
                record["inputs"] = _inputs(display.Input)
                again[key(display.Input)] = display.Input
    for source in again.values():
        source.UpdatePipeline()


def _inputs(source):
    """The global ids of all that a filter takes."""
    properties = [source.SMProxy.GetProperty(name) for name in source.ListProperties()]
    return [known.GetProxy(i).GetGlobalID() for known in properties if known is not None and known.IsA("vtkSMInputProperty")
            for i in range(known.GetNumberOfProxies())]


def _show_input_of(display, view):
    source = getattr(display.Input, "Input", None)
    for other in view.Representations:
        known = getattr(other, "Input", None)
        if source is not None and known is not None and (key(known), known.Port) == (key(source), source.Port):
            other.Visibility = 1
            simple.Render(view)


def _show_last(view, shown, last):
    """Two pictures in one place are one wrong picture, and a legend tells of the one below: the last one stays."""
    if not getattr(last, "MapScalars", True):
        last.SetScalarBarVisibility(view, False)  # which a display has that failed at first: a picture needs none
    after_cube, others = False, [display for display in shown if display is not last]
    for display in others:
        if _overlap(display, last):
            display.SetScalarBarVisibility(view, False)
            display.Visibility = 0
            after_cube = after_cube or _is_cube(display)
    if _is_cube(last):
        _show_cube(view, last)
    elif after_cube:
        view.InteractionMode = "2D"
        view.ResetActiveCameraToNegativeZ()
        simple.ResetCamera(view)
    elif others and not any(_bounds(display) == _bounds(last) for display in others):
        simple.ResetCamera(view)
    simple.Render(view)


def _camera(view):
    return [*view.CameraPosition, *view.CameraFocalPoint, view.CameraParallelScale], list(view.ViewSize)


def _fit_to_size(view):
    """A view that became smaller shows its whole image, as long as the user has not moved it. Captions have their own place."""
    record = memory.of(view)
    before = record.get("fitted")
    if before is None or view_choice.has_caption(view):
        return
    now = _camera(view)
    if now[0] != before[0]:
        del record["fitted"]
    elif now[1] != before[1]:
        simple.ResetCamera(view)
        simple.Render(view)
        record["fitted"] = _camera(view)


def _is_cube(display):
    return display.Input.SMProxy.GetXMLName() == "SpectralCubeVolume"


def _show_cube(view, display):
    """From three sides, with the spectra on its faces."""
    display.SetScalarBarVisibility(view, True)
    view.InteractionMode = "3D"
    view.ResetActiveCameraToNegativeZ()
    view.ApplyIsometricView()
    simple.ResetCamera(view)


def _bounds(display):
    return display.Input.GetDataInformation(display.Input.Port).GetBounds()


def _area(display):
    """Left, right, bottom, top of the pixels; bounds go from middle to middle."""
    extent, origin, spacing = pixel.grid(display.Input, display.Input.Port)
    return [origin[i] + spacing[i] * (extent[2 * i + end] + (end - 0.5)) for i in range(2) for end in range(2)]


def _overlap(a, b):
    first, second = _area(a), _area(b)
    moved = any(tuple(getattr(display, "Position", (0, 0, 0))) != (0, 0, 0) for display in (a, b))
    return not moved and all(first[2 * i] < second[2 * i + 1] and second[2 * i] < first[2 * i + 1] for i in range(2))


def order_columns(table):
    """Once for each set of columns: the user may move them afterwards."""
    header, model = table.horizontalHeader(), table.model()
    names = tuple(str(model.headerData(i, QtCore.Qt.Horizontal)) for i in range(header.count())) if model is not None else ()
    record = memory.of(table)
    if not names or record.get("ordered") == names:
        return
    record["ordered"] = names
    for i in range(header.count()):  # the order of the columns of another table
        header.moveSection(header.visualIndex(i), i)
    place = 0
    for name in _LEADING:
        if name in names:
            header.moveSection(header.visualIndex(names.index(name)), place)
            place += 1
