"""The panel that follows the cursor: the spectrum of the pixel below it; a click keeps it."""

import csv

from PyQt5 import QtCore, QtGui, QtWidgets
from paraview import simple

from . import pixel
from .chart import Curve, SpectrumChart

# Okabe and Ito: told apart with any color vision.
_COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#999999", "#F0E442")
_LIVE = "#000000"
_MOST_MOTION = 3  # pixels between press and release that still are a click
_TITLES = {"Reflectance": "Reflectance factor", "Responses": "Response (1 = white)"}


class SpectrumPanel(QtWidgets.QDockWidget):
    def __init__(self, parent):
        super().__init__("Spectrum", parent)
        self.setObjectName("MultispectralSpectrum")
        self.live, self.pins, self._watched, self._pressed = None, [], {}, None
        self.chart = SpectrumChart()
        self.text = QtWidgets.QLabel("Move the cursor over an image; click to keep a spectrum.")
        self.text.setWordWrap(True)
        self.text.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        self.band = QtWidgets.QSlider(QtCore.Qt.Horizontal)
        self.band.setObjectName("MultispectralBand")
        self.band.setEnabled(False)
        self.band.setToolTip("Show one band of the image as gray levels; at the left end: its colors.")
        self.band_text = QtWidgets.QLabel("colors")
        self.band.valueChanged.connect(self._show_band)
        content = QtWidgets.QWidget()
        layout = QtWidgets.QVBoxLayout(content)
        layout.addWidget(self.chart, 1)
        layout.addWidget(self.text)
        bands = QtWidgets.QHBoxLayout()
        bands.addWidget(QtWidgets.QLabel("Band"))
        bands.addWidget(self.band, 1)
        bands.addWidget(self.band_text)
        layout.addLayout(bands)
        buttons = QtWidgets.QHBoxLayout()
        for name, label, tip, action in (
                ("Clear", "Clear", "Forget the kept spectra", self.clear),
                ("Csv", "Save CSV\u2026", "Save the kept spectra as a table", self._ask_csv),
                ("Png", "Save PNG\u2026", "Save the chart as a picture", self._ask_png)):
            button = QtWidgets.QPushButton(label)
            button.setObjectName(f"Multispectral{name}")
            button.setToolTip(tip)
            button.clicked.connect(action)
            buttons.addWidget(button)
        layout.addLayout(buttons)
        self.setWidget(content)
        # Views come and go; what moves the cursor in them is watched as soon as they are there.
        self._timer = QtCore.QTimer(self)
        self._timer.timeout.connect(self._watch_views)
        self._timer.start(500)

    def _watch_views(self):
        for view in simple.GetRenderViews():
            interactor = view.GetInteractor()
            if interactor is not None and self._watched.get(view.SMProxy.GetGlobalID()) is not interactor:
                self._watched[view.SMProxy.GetGlobalID()] = interactor
                for event, act in (("MouseMoveEvent", self._moved), ("LeftButtonPressEvent", self._press),
                                   ("LeftButtonReleaseEvent", self._release)):
                    interactor.AddObserver(event, lambda who, _, act=act, view=view: act(view, who), 10.0)
        self._adapt_band()

    def _moved(self, view, interactor):
        if self.isVisible():
            self.live = pixel.at(view, *interactor.GetEventPosition())
            self._draw()

    def _press(self, _view, interactor):
        self._pressed = interactor.GetEventPosition()

    def _release(self, view, interactor):
        position, pressed = interactor.GetEventPosition(), self._pressed
        self._pressed = None
        if pressed and self.isVisible() and max(abs(a - b) for a, b in zip(position, pressed)) <= _MOST_MOTION:
            found = pixel.at(view, *position)
            if found is not None:
                self.pins.append(found)
                self.live = None
                self._draw()

    def clear(self):
        self.pins = []
        self._draw()

    def _draw(self):
        curves = []
        for i, pin in enumerate(self.pins):
            curves += curves_of(pin, _COLORS[i % len(_COLORS)])
        if self.live is not None:
            curves += curves_of(self.live, _LIVE)
        shown = self.live or (self.pins[-1] if self.pins else None)
        if shown is None:
            self.text.setText("Move the cursor over an image; click to keep a spectrum.")
        else:
            self.text.setText(describe(shown))
        across = "Wavelength (nm)" if shown is None or shown.wavelengths else "Channel"
        self.chart.show_curves(curves, (across, _TITLES.get(shown.kind if shown else "Reflectance")))

    # The band that the active view shows.
    def _shown_image(self):
        view = simple.GetActiveView()
        if view is None or not hasattr(view, "Representations"):
            return None
        for source, port, display in pixel.visible_images(view):
            information = source.GetDataInformation(port).DataInformation.GetPointDataInformation()
            for name in pixel.SPECTRA:
                array = information.GetArrayInformation(name)
                if array is not None:
                    return source, port, display, name, array.GetNumberOfComponents()
        return None

    def _adapt_band(self):
        shown = self._shown_image()
        self.band.setEnabled(shown is not None)
        if shown is not None and self.band.maximum() != shown[4]:
            self.band.blockSignals(True)
            self.band.setRange(0, shown[4])
            self.band.setValue(0)
            self.band.blockSignals(False)

    def _show_band(self, number):
        shown = self._shown_image()
        if shown is None:
            return
        source, port, display, name, _ = shown
        if number == 0:
            simple.ColorBy(display, ("POINTS", "sRGB"))
            self.band_text.setText("colors")
            self.chart.show_band(None)
        else:
            array = source.PointData[name] if port == 0 else simple.OutputPort(source, port).PointData[name]
            component = array.GetComponentName(number - 1)
            simple.ColorBy(display, ("POINTS", name, component))
            colors = simple.GetColorTransferFunction(name)
            colors.VectorMode, colors.VectorComponent = "Component", number - 1
            colors.ApplyPreset("Grayscale", True)
            low, high = array.GetRange(number - 1)
            colors.RescaleTransferFunction(min(0.0, low), max(1e-6, high))
            data = pixel.data_of(source, port)
            known = pixel.wavelengths_of(data, data.GetPointData().GetArray(name)) if data is not None else None
            self.band_text.setText(f"{known[number - 1]:g} nm" if known else component)
            self.chart.show_band(known[number - 1] if known else number)
        simple.Render(simple.GetActiveView())

    def _ask_csv(self):
        path, _ = QtWidgets.QFileDialog.getSaveFileName(self, "Save the kept spectra", "spectra.csv", "CSV (*.csv)")
        if path:
            try:
                self.save_csv(path)
            except OSError as error:
                QtWidgets.QMessageBox.warning(self, "Spectrum", f"{path}: {error.strerror}")

    def _ask_png(self):
        path, _ = QtWidgets.QFileDialog.getSaveFileName(self, "Save the chart", "spectra.png", "PNG (*.png)")
        if path and not self.chart.grab().save(path, "PNG"):
            QtWidgets.QMessageBox.warning(self, "Spectrum", f"{path}: cannot be written; check the folder")

    def save_csv(self, path):
        """One spectrum a row, as a sample table: R400 measured, E400 estimated, U400 its uncertainty, C400 response."""
        rows = [row_of(pin) for pin in self.pins]
        names = list(dict.fromkeys(name for row in rows for name in row))
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, names, restval="")
            writer.writeheader()
            writer.writerows(rows)


def curves_of(pin, color):
    across = pin.wavelengths or list(range(1, len(pin.values) + 1))
    label = f"({pin.column}, {pin.row}) {pin.name.rpartition(': ')[2]}"
    curves = [Curve(across, pin.values, label, color, pin.deviation)]
    if pin.measured is not None:
        curves.append(Curve(*pin.measured, "measured", color, dashed=True, width=1.5))
    return curves


def describe(pin):
    parts = [f"{pin.name}, column {pin.column}, row {pin.row}"]
    parts += [f"\u0394E00 {value:.2f} ({name[5:]})" for name, value in pin.errors.items()]
    if pin.deviation:
        parts.append("band: \u00b12 standard deviations")
    if pin.measured:
        parts.append("dashed: measured")
    return "; ".join(parts)


def row_of(pin):
    row = {"sample": f"{pin.name} ({pin.column}, {pin.row})", "x": pin.column, "y": pin.row}
    row.update({name.replace(" ", "_"): f"{value:.4f}" for name, value in pin.errors.items()})
    known = pin.wavelengths or range(1, len(pin.values) + 1)
    letter = "E" if pin.kind == "Reflectance" else "C"
    row.update({f"{letter}{x:g}": f"{y:.6g}" for x, y in zip(known, pin.values)})
    if pin.deviation:
        row.update({f"U{x:g}": f"{y:.6g}" for x, y in zip(known, pin.deviation)})
    if pin.measured:
        row.update({f"R{x:g}": f"{y:.6g}" for x, y in zip(*pin.measured)})
    return row
