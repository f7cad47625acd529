"""What is done when another source is selected, a new one above all."""

from PyQt5 import QtCore, QtWidgets
from paraview import servermanager, simple

from . import stack_choice, view_choice


def install(window):
    """Returns what must be kept."""
    def act():
        apply = window.findChild(QtWidgets.QAbstractButton, "Accept")
        is_new = apply is not None and apply.isEnabled()  # one that a script or a state file has made does not wait for Apply
        if is_new:
            stack_choice.adapt(simple.GetActiveSource())
        view_choice.adapt(is_new)
    model = servermanager.ProxyManager().GetSelectionModel("ActiveSources")
    model.AddObserver("CurrentChangedEvent", lambda *_: QtCore.QTimer.singleShot(0, act))
    return model
