"""What is done when another source is selected, a new one above all."""

from PyQt5 import QtCore, QtWidgets
from paraview import servermanager, simple

from . import first_views, stack_choice, view_choice


class Watch(QtCore.QObject):
    def __init__(self, window):
        super().__init__(window)
        self._window, self._manager, self._model = window, None, None
        self.follow()

    def follow(self):
        """File > Connect brings a session with a selection of its own."""
        manager = servermanager.ProxyManager()
        if manager.SMProxyManager is None:
            return
        self._manager, self._model = manager.SMProxyManager, manager.GetSelectionModel("ActiveSources")
        self._model.AddObserver("CurrentChangedEvent", lambda *_: QtCore.QTimer.singleShot(0, self._act))
        self._manager.AddObserver("LoadStateEvent", lambda *_: first_views.keep())

    def _act(self):
        apply = self._window.findChild(QtWidgets.QAbstractButton, "Accept")
        is_new = apply is not None and apply.isEnabled()  # one that a script or a state file has made does not wait for Apply
        if is_new:
            stack_choice.adapt(simple.GetActiveSource())
        view_choice.adapt(is_new)
