"""ParaView's question 'Open Data With', answered where there is one answer.

Readers of the plugin look into a file before they offer to read it; most of ParaView's go by its extension. Where the file is a table or a
description of the plugin's, no question is left; an image may also be wanted as a plain picture, so there the plugin's reader is only selected."""

import os
import re

from PyQt5 import QtCore, QtWidgets

CERTAIN = ("Sample Table Reader", "Camera Reader", "Capture Reader", "Scene Reader")
LIKELY = ("Spectral Image Reader", "Label Image Reader")


class ReaderChoice(QtCore.QObject):
    def __init__(self, window):
        super().__init__(window)
        QtWidgets.QApplication.instance().focusWindowChanged.connect(self._look)

    @staticmethod
    def _look(_window):
        dialog = QtWidgets.QApplication.activeModalWidget()
        if dialog is not None and dialog.metaObject().className() == "pqSelectReaderDialog":
            answer(dialog)


def _folder_without_reader(dialog):
    """A folder that no reader knows; ParaView offers its readers of AMReX, which end the program at any other folder."""
    for label in dialog.findChildren(QtWidgets.QLabel):
        found = re.match(r'A reader for "(.*)" could not be found', label.text(), re.DOTALL)
        if found and os.path.isdir(found[1]) and not os.path.exists(os.path.join(found[1], "Header")):
            return found[1]
    return None


def _refuse(dialog, folder):
    dialog.reject()
    QtWidgets.QMessageBox.warning(dialog.parentWidget(), "Multispectral", f"{folder}: the folder holds no spectral image; expected the "
                                  "image with white/ and dark/ beside it; choose that folder, or a file")


def answer(dialog):
    readers = dialog.findChild(QtWidgets.QListWidget)
    button = dialog.findChild(QtWidgets.QAbstractButton, "okButton")
    if readers is None or button is None or dialog.property("multispectral"):
        return
    dialog.setProperty("multispectral", True)  # the user's own choice stays
    rows = {readers.item(row).text(): row for row in range(readers.count())}
    folder = _folder_without_reader(dialog)
    if folder is not None:
        QtCore.QTimer.singleShot(0, lambda: _refuse(dialog, folder))
        return
    known = [name for name in (*CERTAIN, *LIKELY) if name in rows]
    if known:
        readers.setCurrentRow(rows[known[0]])
    if len(known) == 1 and known[0] in CERTAIN:
        QtCore.QTimer.singleShot(0, button.click)
