"""A channel that is opened by File > Open is opened with the other channels of its image: one alone is a gray picture of no use."""

from PyQt5 import QtCore, QtWidgets
from paraview import servermanager, simple

_seen = set()  # global ids


def install(window):
    """Returns what must be kept."""
    model = servermanager.ProxyManager().GetSelectionModel("ActiveSources")
    model.AddObserver("CurrentChangedEvent", lambda *_: QtCore.QTimer.singleShot(0, lambda: adapt(window)))
    return model


def adapt(window):
    source, apply = simple.GetActiveSource(), window.findChild(QtWidgets.QAbstractButton, "Accept")
    if source is None or source.SMProxy.GetXMLName() != "SpectralImageReader" or source.SMProxy.GetGlobalID() in _seen:
        return
    _seen.add(source.SMProxy.GetGlobalID())
    # One that a script or a state file has made is not waiting for Apply.
    if apply is None or not apply.isEnabled() or len(source.FileNames) != 1:
        return
    source.WholeStack = 1
    source.UpdatePipelineInformation()
    source.UpdatePropertyInformation()
    pattern = source.GetProperty("StackPattern").GetData() if source.GetProperty("StackPattern") is not None else ""
    if pattern:
        simple.RenameSource(pattern, source)
    else:
        source.WholeStack = 0
