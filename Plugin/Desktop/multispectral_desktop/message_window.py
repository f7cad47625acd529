"""ParaView's message window, where one mistake is one message.

A filter that fails is asked again by every view and by the filters behind it, and each time VTK adds its own remark to the filter's
message: the window would show a dozen lines for one fault."""

import re
import time

from PyQt5 import QtCore, QtGui, QtWidgets
from paraview import simple

_REMARKS = ("returned failure for request", "Attempted to ShallowCopy from null")
_OF_A_VIEW = "vtkPVGeometryFilter"  # asks again at each picture, so long as what failed is shown
# ParaView tries its readers in Python at a file that no other reader knows; those that the system cannot load tell their traces.
_READERS_IN_PYTHON = ("openpmd.py:", "Failed to import module 'paraview.algorithms.")
# Said dozens of times, at each question that the window has for the filter.
_NO_INPUT = re.compile(r"Input port (\d+) of algorithm (\w+) \(0x\w+\) has 0 connections")
_LOOKED_AT = QtCore.Qt.UserRole + 77
_SAME = 3.0  # seconds within which the same text tells of the same fault


class Tidy(QtCore.QObject):
    def __init__(self, parent, dock, model):
        super().__init__(parent)
        self._dock, self._model, self._seen = dock, model, {}
        self._timer = QtCore.QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._clean)
        self._timer.setInterval(0)
        # From Qt to Qt: ParaView holds a lock while it adds a row, maybe amid an exception of Python. A function of Python would fail
        # there, and its own message wait for that lock for ever.
        model.rowsInserted.connect(self._timer.start)

    def _clean(self):
        now, row, in_trace = time.monotonic(), 0, False
        while row < self._model.rowCount():
            index = self._model.index(row, 0)
            if index.data(_LOOKED_AT):
                row += 1
                continue
            text = self._text(row)
            # Messages of VTK begin with a space, lines of a trace do not.
            in_trace = any(part in text for part in _READERS_IN_PYTHON) or (in_trace and not str(index.data()).startswith(" "))
            if in_trace:
                self._model.removeRow(row)
                continue
            missing = _missing_input(text)
            if missing is not None:
                text = missing
                if any(self._text(other) == text for other in range(row)):
                    self._seen[text] = now
                    self._model.removeRow(row)
                    continue
                self._model.setData(index, text)
            last = self._seen.get(text)
            remark = any(part in text for part in _REMARKS) and (
                _OF_A_VIEW in text and bool(self._seen) or any(now - then < _SAME for then in self._seen.values()))
            if not remark:
                self._seen[text] = now
            if remark or (last is not None and now - last < _SAME):
                self._model.removeRow(row)
            else:
                self._model.setData(index, True, _LOOKED_AT)  # a count of rows would not know when the user clears them
                row += 1
        if self._model.rowCount() == 0:
            self._dock.hide()

    def _text(self, row):
        return str(self._model.index(row, 0).data()).strip()


def _missing_input(text):
    """In words, where a filter says that it has none; else None."""
    found = _NO_INPUT.search(text)
    for (name, _), source in simple.GetSources().items() if found else ():
        known = [source.SMProxy.GetProperty(name) for name in source.ListProperties()] if source.SMProxy.GetVTKClassName() == found[2] else ()
        for inputs in known:
            if inputs is not None and inputs.IsA("vtkSMInputProperty") and inputs.GetPortIndex() == int(found[1]) and \
                    not any(inputs.GetProxy(i) for i in range(inputs.GetNumberOfProxies())):
                return f"{name}: no {inputs.GetXMLLabel()} is chosen; choose it in the panel Properties"
    return None


def install(window):
    """Returns what must be kept, or None where ParaView has no such window."""
    dock = window.findChild(QtWidgets.QDockWidget, "outputWidgetDock")
    tree = dock and dock.findChild(QtWidgets.QTreeView, "treeView")
    model = tree and tree.model()
    return Tidy(window, dock, model) if isinstance(model, QtGui.QStandardItemModel) else None
