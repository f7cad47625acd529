"""What the readers have recognized or left out, told once in the status bar: their panels do not show it. What a picture would mislead
about stays in its view."""

from paraview import simple
from vtkmodules.vtkRenderingCore import vtkTextActor

from . import memory, view_choice

_SECONDS = 30
# The beginning of a note, and what is written over the picture as long as it is shown.
_REMARKS = {"no white reference": "Colors of the camera and its lamp: the scene has no white frames"}
_FONT_SIZE = 16


def adapt(window):
    lines = []
    for (name, _), source in simple.GetSources().items():
        notes = source.SMProxy.GetProperty("Notes")
        if notes is None or not view_choice.is_ours(source) or not _has_data(source) or not memory.first("told", source):
            continue
        source.UpdatePropertyInformation()
        lines += [f"{name}: {line}" for line in str(notes.GetElement(0) or "").splitlines()]
    if lines:
        window.statusBar().showMessage("; ".join(lines), 1000 * _SECONDS)
    for view in simple.GetRenderViews():
        _write_remarks(view)


def _has_data(source):
    information = source.GetDataInformation(0)
    return information.GetNumberOfPoints() > 0 or information.GetNumberOfRows() > 0


def remarks(view):
    """On what it shows."""
    said = []
    for display in view.Representations:
        source = getattr(display, "Input", None)
        notes = source.SMProxy.GetProperty("Notes") if source is not None and getattr(display, "Visibility", 0) else None
        if notes is not None and source.Port == 0 and view_choice.is_ours(source):
            text = str(notes.GetElement(0) or "")
            said += [remark for start, remark in _REMARKS.items() if text.startswith(start)]
    return "\n".join(dict.fromkeys(said))


def _write_remarks(view):
    record, text = memory.of(view), remarks(view)
    if record.get("remarks", "") == text:
        return
    record["remarks"] = text
    if "remark actor" not in record:
        actor = record["remark actor"] = vtkTextActor()
        actor.GetTextProperty().SetFontSize(_FONT_SIZE)
        actor.GetTextProperty().SetBackgroundColor(0.0, 0.0, 0.0)
        actor.GetTextProperty().SetBackgroundOpacity(0.6)
        actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
        actor.SetPosition(0.02, 0.02)
        view.GetRenderer().AddActor2D(actor)
    record["remark actor"].SetInput(text)
    record["remark actor"].SetVisibility(bool(text))
    simple.Render(view)
