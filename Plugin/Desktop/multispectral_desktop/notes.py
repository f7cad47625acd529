"""What the readers have recognized or left out, told once in the status bar: their panels do not show it. What a picture would mislead
about stays in its view."""

from paraview import simple
from vtkmodules.vtkRenderingCore import vtkTextActor

from . import memory, pixel, view_choice

_SECONDS = 30
_NO_WHITE = "no white reference"  # the beginning of a note
# By reader: what is written over the picture of its responses.
_REMARKS = {"SceneReader": "Colors of the camera and its lamp: the scene has no white frames",
            "SpectralImageReader": "Colors of the responses as stored: not divided by a white reference"}
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
    inputs = [display.Input for display in view.Representations if getattr(display, "Visibility", 0) and
              getattr(display, "Input", None) is not None and list(getattr(display, "ColorArrayName", ()))[1:] == ["sRGB"]]
    return "\n".join(dict.fromkeys(filter(None, map(of_raw, inputs))))


def of_raw(source):
    """The remark on responses that nothing divides by a white reference; None where there is nothing to say."""
    if "Responses" not in pixel.arrays(source, source.Port):
        return None
    while source.SMProxy.GetXMLName() not in _REMARKS:
        before = getattr(source, "Input", None)
        if source.SMProxy.GetXMLName() == "FlatFieldCorrection" or not hasattr(before, "SMProxy"):
            return None
        source = before
    fields = source.GetDataInformation(source.Port).DataInformation.GetFieldDataInformation()
    notes = str(source.SMProxy.GetProperty("Notes").GetElement(0) or "")
    is_raw = notes.startswith(_NO_WHITE) if source.SMProxy.GetXMLName() == "SceneReader" else \
        fields.GetArrayInformation("Wavelength") is not None  # which a picture for the screen does not have
    return _REMARKS[source.SMProxy.GetXMLName()] if is_raw and "Responses" in pixel.arrays(source, source.Port) else None


def title_of_responses(source):
    """Of an axis."""
    return "Response (1 = white)" if of_raw(source) is None else "Response (as stored)"


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
