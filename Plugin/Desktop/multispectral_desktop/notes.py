"""What the readers have recognized or left out, told once in the status bar: their panels do not show it."""

from . import view_choice
from paraview import simple

_SECONDS = 30
_told = set()  # global ids


def adapt(window):
    lines = []
    for (name, _), source in simple.GetSources().items():
        key, notes = source.SMProxy.GetGlobalID(), source.SMProxy.GetProperty("Notes")
        if notes is None or key in _told or not view_choice.is_ours(source) or not _has_data(source):
            continue
        _told.add(key)
        source.UpdatePropertyInformation()
        lines += [f"{name}: {line}" for line in str(notes.GetElement(0) or "").splitlines()]
    if lines:
        window.statusBar().showMessage("; ".join(lines), 1000 * _SECONDS)


def _has_data(source):
    information = source.GetDataInformation(0)
    return information.GetNumberOfPoints() > 0 or information.GetNumberOfRows() > 0
