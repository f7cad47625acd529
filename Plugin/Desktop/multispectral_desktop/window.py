"""What the plugin adds to ParaView's window: the panel Spectrum, and a toolbar with the main job."""

import os
import traceback

from PyQt5 import QtCore, QtWidgets
from paraview import servermanager, simple

from . import first_views, help, lights, main_job, menus, message_window, messages, reader_choice, selection, view_choice
from .chart_placement import Placement
from .panel import SpectrumPanel


_MARGIN = 40  # pixels from the corner of the window


def install(window):
    """Returns what must be kept as long as the window is there."""
    panel = SpectrumPanel(window)
    window.addDockWidget(QtCore.Qt.RightDockWidgetArea, panel)
    toolbar = QtWidgets.QToolBar("Multispectral", window)
    toolbar.setObjectName("MultispectralToolbar")
    toolbar.setToolButtonStyle(QtCore.Qt.ToolButtonTextBesideIcon)
    for name, label, picture, tip, act in (
            ("OpenScene", "Open scene", "scene", "Open the folder of an image with its white and dark frames", open_scene),
            ("MainJob", "Main job", "job", "Estimate an image with a chart, correct it by swatches, see where it is wrong",
             run_main_job),
            ("FindChart", "Find chart", "chart", "Find a color chart in the selected image and save its samples as a table", place_chart)):
        action = toolbar.addAction(menus.icon(picture), label)
        action.setObjectName(f"Multispectral{name}")
        action.setToolTip(tip)
        action.triggered.connect(lambda _checked, act=act: _guarded(window, act))
    window.addToolBar(toolbar)
    first_views.listen(window)
    watch = selection.Watch(window)
    panel.connected.connect(watch.follow)
    return (panel, toolbar, help.install(window), message_window.install(window), reader_choice.ReaderChoice(window),
            menus.Order(window), watch)


def _guarded(window, act):
    """A fault is one message, not a trace that nobody sees."""
    try:
        act(window)
    except messages.Missing as missing:
        QtWidgets.QMessageBox.warning(window, "Multispectral", str(missing))
    except Exception as error:
        traceback.print_exc()
        QtWidgets.QMessageBox.critical(window, "Multispectral",
                                       f"Internal error, please report it: {type(error).__name__}: {error}")


def _ask_folder(parent, start=""):
    return QtWidgets.QFileDialog.getExistingDirectory(
        parent, "The folder of the scene", start, QtWidgets.QFileDialog.DontUseNativeDialog)


def _is_remote():
    return servermanager.ActiveConnection is not None and servermanager.ActiveConnection.IsRemote()


def open_scene(window):
    folder = _ask_folder(window)
    if folder:
        _, scene = main_job.open_scene(folder)
        view_choice.adapt(is_new=True)
        view = simple.GetActiveViewOrCreate("RenderView")
        simple.Show(scene, view)
        view.InteractionMode = "2D"
        simple.ResetCamera(view)
        simple.SetActiveSource(scene)
        simple.Render(view)


def run_main_job(window):
    dialog = MainJobDialog(window)
    if dialog.exec_() == QtWidgets.QDialog.Accepted:
        QtWidgets.QApplication.setOverrideCursor(QtCore.Qt.WaitCursor)
        try:
            main_job.build(dialog.scene.text(), dialog.chart.text() or None, dialog.swatches.text() or None,
                           light=dialog.light.currentText().strip() or lights.LIGHT,
                           observer=dialog.observer.currentText().strip() or lights.OBSERVER)
        finally:
            QtWidgets.QApplication.restoreOverrideCursor()
        if main_job.warnings:
            QtWidgets.QMessageBox.warning(window, "Multispectral", "\n".join(dict.fromkeys(main_job.warnings)))


def place_chart(window):
    dialog = window.findChild(QtWidgets.QDialog, "MultispectralChartDialog") or Placement(window)
    dialog.show()
    dialog.move(window.mapToGlobal(window.rect().topRight()) - QtCore.QPoint(dialog.width() + _MARGIN, -_MARGIN))  # beside the view
    dialog.raise_()


class MainJobDialog(QtWidgets.QDialog):
    def __init__(self, parent):
        super().__init__(parent)
        self.setObjectName("MultispectralMainJobDialog")
        self.setWindowTitle("Main job")
        self.setMinimumWidth(560)
        form = QtWidgets.QFormLayout(self)
        text = QtWidgets.QLabel("Estimates the reflectance of a scene with a chart's samples, corrects it by a few swatches "
                                "of the scene's material, and shows both results side by side.")
        text.setWordWrap(True)
        form.addRow(text)
        self.scene = self._line(form, "Scene", "folder with the image, white/ and dark/", self._browse_scene)
        self.chart = self._line(form, "Chart", "table with reflectance and responses; empty: chart.csv of the scene",
                                lambda: self._browse_table(self.chart))
        self.swatches = self._line(form, "Swatches", "table of a few samples of the material; empty: swatches.csv of "
                                   "the scene, or none", lambda: self._browse_table(self.swatches))
        self.light = self._choice(form, "Light", lights.LIGHTS, "Under which colors are shown and compared: a CIE illuminant "
                                  "(A, D50, D5500K, F1 to F12, LED-B1, ..), or a file with the lamp's power: wavelength in "
                                  "nm, then one column per lamp", "The lamp's power")
        self.observer = self._choice(form, "Observer", tuple(lights.OBSERVERS), "A CIE standard observer, or a file with one: "
                                     "wavelength in nm, x-bar, y-bar, z-bar", "The observer's curves")
        buttons = QtWidgets.QDialogButtonBox(QtWidgets.QDialogButtonBox.Cancel)
        self.run = buttons.addButton("Run", QtWidgets.QDialogButtonBox.AcceptRole)
        self.run.setObjectName("MultispectralRun")
        buttons.button(QtWidgets.QDialogButtonBox.Cancel).setAutoDefault(False)  # else Enter cancels: Run is disabled at first
        self.run.setDefault(True)
        self.run.setEnabled(False)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        form.addRow(buttons)
        # A server's folders are not known here.
        self.scene.textChanged.connect(
            lambda folder: self.run.setEnabled(bool(folder) and (_is_remote() or os.path.isdir(folder))))

    def _line(self, form, label, hint, browse):
        line = QtWidgets.QLineEdit()
        line.setPlaceholderText(hint)
        return self._row(form, label, line, browse)

    def _choice(self, form, label, names, tip, title):
        """A list of names that also takes a file."""
        box = QtWidgets.QComboBox()
        box.setEditable(True)
        box.addItems(names)
        box.setToolTip(tip)
        return self._row(form, label, box, lambda: self._browse_curves(box, title))

    @staticmethod
    def _row(form, label, line, browse):
        button = QtWidgets.QPushButton("Browse\u2026")
        line.setObjectName(f"Multispectral{label}")
        button.setObjectName(f"Multispectral{label}Browse")
        button.setAutoDefault(False)
        button.clicked.connect(lambda _checked: browse())
        row = QtWidgets.QHBoxLayout()
        row.addWidget(line, 1)
        row.addWidget(button)
        form.addRow(label, row)
        return line

    def _browse_scene(self):
        folder = _ask_folder(self, self.scene.text())
        if folder:
            self.scene.setText(folder)

    def _browse_curves(self, box, title):
        path, _ = QtWidgets.QFileDialog.getOpenFileName(
            self, title, self.scene.text(), "Curves over wavelength (*.csv *.txt *.ti3 *.sp *.spd);;All files (*)",
            options=QtWidgets.QFileDialog.DontUseNativeDialog)
        if path:
            box.setEditText(path)

    def _browse_table(self, line):
        path, _ = QtWidgets.QFileDialog.getOpenFileName(
            self, "A table of samples", line.text() or self.scene.text(),
            "Sample tables (*.csv *.txt *.ti3 *.cie *.cgats *.cxf *.mat);;All files (*)",
            options=QtWidgets.QFileDialog.DontUseNativeDialog)
        if path:
            line.setText(path)
