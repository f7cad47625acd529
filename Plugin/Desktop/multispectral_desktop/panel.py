"""The panel that follows the cursor: the spectrum of the pixel below it; a click keeps it."""

import csv
import os

from PyQt5 import QtCore, QtGui, QtWidgets
from paraview import servermanager, simple

from . import captions, changes, first_views, memory, notes, pixel, profile_chart
from .chart import Curve, SpectrumChart
from .marks import Marks, rectangle

# Okabe and Ito: told apart with any color vision.
_COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#999999", "#F0E442")
_LIVE = "#000000"
_MOST_MOTION = 3  # pixels between press and release that still are a click
_PICTURES = ("sRGB", "Display P3", "False Color")


class SpectrumPanel(QtWidgets.QDockWidget):
    connected = QtCore.pyqtSignal()  # to another server, by File > Connect

    def __init__(self, parent):
        super().__init__("Spectrum", parent)
        self.setObjectName("MultispectralSpectrum")
        self.live, self.pins, self._watched, self._pressed = None, [], {}, None
        self._kept = []  # of which pins are those that their images have at present
        self._changes = changes.Changes()
        self._manager = servermanager.ProxyManager().SMProxyManager
        self._marks, self._marked, self._marked_grids = Marks(), {}, {}
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
        self.buttons = []  # which act on the kept spectra
        self.region = QtWidgets.QPushButton("Region")
        self.region.setObjectName("MultispectralRegion")
        self.region.setCheckable(True)
        self.region.setToolTip("Drag a rectangle over an image: the mean spectrum of its pixels")
        buttons.addWidget(self.region)
        for name, label, tip, action in (
                ("Clear", "Clear", "Forget the kept spectra", self.clear),
                ("Csv", "Save CSV\u2026", "Save the kept spectra as a table", self._ask_csv),
                ("Png", "Save PNG\u2026", "Save the chart as a picture", self._ask_png)):
            button = QtWidgets.QPushButton(label)
            button.setObjectName(f"Multispectral{name}")
            button.setToolTip(tip)
            button.clicked.connect(action)
            buttons.addWidget(button)
            self.buttons.append(button)
            button.setEnabled(False)
        layout.addLayout(buttons)
        self.setWidget(content)
        # Views come and go; what moves the cursor in them is watched as soon as they are there.
        self._timer = QtCore.QTimer(self)
        self._timer.timeout.connect(self._watch_views)
        self._timer.start(500)

    def _watch_views(self):
        manager = servermanager.ProxyManager().SMProxyManager
        if manager is None or manager.GetInLoadXMLState():  # a state file that is half read
            return
        if manager is not self._manager:  # File > Connect: another server counts its objects anew
            self._manager = manager
            memory.forget()
            pixel.forget(())
            self.live, self._marked = None, {}
            self.clear()
            self.connected.emit()
        for view in simple.GetRenderViews():
            interactor = view.GetInteractor()
            if interactor is not None and self._watched.get(view.SMProxy.GetGlobalID()) is not interactor:
                self._watched[view.SMProxy.GetGlobalID()] = interactor
                for event, act in (("MouseMoveEvent", self._moved), ("LeftButtonPressEvent", self._press),
                                   ("LeftButtonReleaseEvent", self._release)):
                    self._observe(view, interactor, event, act)
        self._adapt_band()
        profile_chart.adapt_views()
        first_views.adapt(self.window())
        notes.adapt(self.window())
        changed = self._changes.any()
        if changed:
            self._read_again()
        captions.adapt(changed)
        self._forget_deleted()
        if self.pins and self._marked and self._grids() != self._marked_grids:
            self._mark(next(iter(self._marked.values())))

    def _read_again(self):
        """The kept spectra, of images that may have changed."""
        self.pins = [pin for pin in map(pixel.again, self._kept) if pin is not None]
        self.live = self.live and pixel.again(self.live)
        self._draw()

    def _forget_deleted(self):
        """The spectra of a source that is there no more, as after Edit > Reset Session."""
        known = {source.SMProxy.GetGlobalID() for source in simple.GetSources().values()}
        pixel.forget(known)
        self._kept = [pin for pin in self._kept if pin.source in known]
        kept = [pin for pin in self.pins if pin.source in known]
        live = self.live if self.live is None or self.live.source in known else None
        if len(kept) < len(self.pins) or live is not self.live:
            self.pins, self.live = kept, live
            self._draw()
            self._marked = {key: view for key, view in self._marked.items()
                            if key in {other.SMProxy.GetGlobalID() for other in simple.GetRenderViews()}}
            for view in list(self._marked.values())[:1]:
                self._mark(view)

    @staticmethod
    def _observe(view, interactor, event, act):
        """act returns True where ParaView is not to see the event."""
        def observer(who, _):
            if act(view, who):
                who.GetCommand(tag).SetAbortFlag(1)
        tag = interactor.AddObserver(event, observer, 10.0)

    def _moved(self, view, interactor):
        if self._pressed and self.region.isChecked():
            ends = [pixel.world_point(view, *place) for place in (self._pressed, interactor.GetEventPosition())]
            if None not in ends:
                self._mark(view, [(rectangle(*ends), _LIVE)])
            return True
        if self.isVisible():
            self.live = pixel.at(view, *interactor.GetEventPosition())
            self._draw()
        return False

    def _press(self, _view, interactor):
        self._pressed = interactor.GetEventPosition()
        return self.region.isChecked()

    def _release(self, view, interactor):
        position, pressed = interactor.GetEventPosition(), self._pressed
        self._pressed = None
        if not pressed or not self.isVisible():
            return False
        dragged = max(abs(a - b) for a, b in zip(position, pressed)) > _MOST_MOTION
        found = None
        if not dragged:
            found = pixel.at(view, *position)
        elif self.region.isChecked():
            found = pixel.region(view, pressed, position)
        if found is not None:
            self.pins.append(found)
            self._kept.append(found)
            self.live = None
            self._draw()
        if found is not None or self.region.isChecked():
            self._mark(view)
        return self.region.isChecked()

    def _mark(self, view, also=()):
        """The places of the kept spectra, in this view and in those that had marks before, where their image is shown."""
        known = {other.SMProxy.GetGlobalID() for other in simple.GetRenderViews()}
        self._marked = {key: other for key, other in self._marked.items() if key in known}
        self._marked[view.SMProxy.GetGlobalID()] = view
        for other in self._marked.values():
            grids = pixel.visible_grids(other)
            pins = [(pin, self._color(i)) for i, pin in enumerate(self.pins) if pin.grid in grids]
            points = [(pin.point, color) for pin, color in pins if pin.region is None]
            lines = [(rectangle(*pin.region), color) for pin, color in pins if pin.region is not None]
            self._marks.show(other, points, [*lines, *also])
        self._marked_grids = self._grids()

    def _grids(self):
        """By view with marks: the grids of its images. The marks go with the image to whose pixels they belong."""
        known = {view.SMProxy.GetGlobalID(): view for view in simple.GetRenderViews()}
        return {key: pixel.visible_grids(known[key]) for key in self._marked if key in known}

    @staticmethod
    def _color(i):
        return _COLORS[i % len(_COLORS)]

    def clear(self):
        self.pins, self._kept = [], []
        self._draw()
        for view in list(self._marked.values())[:1]:
            self._mark(view)

    def _draw(self):
        for button in self.buttons:
            button.setEnabled(bool(self.pins))
        curves = []
        for i, pin in enumerate(self.pins):
            curves += curves_of(pin, self._color(i))
        if self.live is not None:
            curves += curves_of(self.live, _LIVE)
        shown = self.live or (self.pins[-1] if self.pins else None)
        if shown is None:
            self.text.setText("Move the cursor over an image; click to keep a spectrum.")
        else:
            self.text.setText(describe(shown))
        across = "Wavelength (nm)" if shown is None or shown.wavelengths else "Channel"
        self.chart.show_curves(curves, (across, _title_of(shown)))

    # The band that the active view shows.
    def _shown_image(self):
        view = simple.GetActiveView()
        if view is None or not hasattr(view, "Representations"):
            return None
        for source, port, display in pixel.visible_images(view):
            if list(getattr(display, "ColorArrayName", ()))[1:] not in [[known] for known in (*pixel.SPECTRA, *_PICTURES)]:
                continue  # a map of errors, whose legend would stay beside the band; a spreadsheet
            information = source.GetDataInformation(port).DataInformation.GetPointDataInformation()
            for name in pixel.SPECTRA:
                array = information.GetArrayInformation(name)
                if array is not None:
                    return source, port, display, name, array.GetNumberOfComponents()
        return None

    def _adapt_band(self):
        """The slider says what the active view shows."""
        shown = self._shown_image()
        self.band.setEnabled(shown is not None)
        if shown is None or self.band.isSliderDown():
            return
        source, port, display, name, count = shown
        number = 0
        if display.ColorArrayName[1] == name:
            colors = simple.GetColorTransferFunction(name)
            number = colors.VectorComponent + 1 if colors.VectorMode == "Component" else 0
        if (self.band.maximum(), self.band.value()) != (count, number):
            self.band.blockSignals(True)
            self.band.setRange(0, count)
            self.band.setValue(number)
            self.band.blockSignals(False)
            self._say_band(source, port, name, number)

    def _say_band(self, source, port, name, number):
        if number == 0:
            self.band_text.setText("colors")
            self.chart.show_band(None)
            return
        array = source.PointData[name] if port == 0 else simple.OutputPort(source, port).PointData[name]
        band = array.GetComponentName(number - 1)  # "550 nm", or the channel's name
        self.band_text.setText(band)
        self.chart.show_band(float(band[:-3]) if band.endswith(" nm") else number)

    def _show_band(self, number):
        shown = self._shown_image()
        if shown is None:
            return
        source, port, display, name, _ = shown
        if number == 0:
            pictures = [picture for picture in _PICTURES if source.GetDataInformation(port).DataInformation
                        .GetPointDataInformation().GetArrayInformation(picture) is not None]
            if pictures:
                simple.ColorBy(display, ("POINTS", pictures[0]))
        else:
            array = source.PointData[name] if port == 0 else simple.OutputPort(source, port).PointData[name]
            simple.ColorBy(display, ("POINTS", name, array.GetComponentName(number - 1)))
            colors = simple.GetColorTransferFunction(name)
            colors.VectorMode, colors.VectorComponent = "Component", number - 1
            colors.ApplyPreset("Grayscale", True)
            low, high = array.GetRange(number - 1)
            colors.RescaleTransferFunction(min(0.0, low), max(1e-6, high))
        self._say_band(source, port, name, number)
        simple.Render(simple.GetActiveView())

    def _ask_csv(self):
        path = self._ask("Save the kept spectra", "spectra.csv", "CSV (*.csv)")
        if path:
            try:
                self.save_csv(path)
            except OSError as error:
                QtWidgets.QMessageBox.warning(self, "Spectrum", f"{path}: {error.strerror}")

    def _ask_png(self):
        path = self._ask("Save the chart", "spectra.png", "PNG (*.png)")
        if path and not self.chart.grab().save(path, "PNG"):
            QtWidgets.QMessageBox.warning(self, "Spectrum", f"{path}: cannot be written; check the folder")

    def _ask(self, title, name, kind):
        """The file to write, with its extension; empty: none."""
        path, _ = QtWidgets.QFileDialog.getSaveFileName(self, title, name, kind,
                                                        options=QtWidgets.QFileDialog.DontUseNativeDialog)
        extension = os.path.splitext(name)[1]
        return path + extension if path and not os.path.splitext(path)[1] else path

    def save_csv(self, path):
        """One spectrum a row, as a sample table: R400 measured, E400 estimated, U400 its uncertainty, C400 response."""
        rows = [row_of(pin) for pin in self.pins]
        names = list(dict.fromkeys(name for row in rows for name in row))
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, names, restval="")
            writer.writeheader()
            writer.writerows(rows)


def _title_of(pin):
    """Of the vertical axis."""
    if pin is None or pin.kind == "Reflectance":
        return "Reflectance factor"
    source = pixel.source_of(pin)
    return notes.title_of_responses(source) if source is not None else "Response"


def curves_of(pin, color):
    across = pin.wavelengths or list(range(1, len(pin.values) + 1))
    label = f"{place_of(pin)} {pin.name.rpartition(': ')[2]}"
    curves = [Curve(across, pin.values, label, color, pin.deviation)]
    if pin.measured is not None:
        curves.append(Curve(*pin.measured, "measured", color, dashed=True, width=1.5))
    return curves


def place_of(pin):
    return f"({pin.column}, {pin.row})" if pin.region is None else f"mean of {pin.count} pixels"


def describe(pin):
    parts = [f"{pin.name}, column {pin.column}, row {pin.row}" if pin.region is None else
             f"{pin.name}, mean of {pin.count} pixels around column {pin.column}, row {pin.row}"]
    parts += [f"\u0394{name.partition(' ')[0][1:]} {value:.2f} ({name.partition(' ')[2]})" for name, value in pin.errors.items()]
    if pin.deviation:
        parts.append("band: \u00b12 standard deviations" + (" of the pixels" if pin.region is not None else ""))
    if pin.measured:
        parts.append("dashed: measured")
    if not pin.wavelengths:
        parts.append("channels without wavelengths: enter them in the properties of the image's reader")
    return "; ".join(parts)


def row_of(pin):
    row = {"sample": f"{pin.name} {place_of(pin)}", "x": pin.column, "y": pin.row, "count": pin.count}
    row.update({name.replace(" ", "_"): f"{value:.4f}" for name, value in pin.errors.items()})
    known = pin.wavelengths or range(1, len(pin.values) + 1)
    letter = "E" if pin.kind == "Reflectance" else "C"
    row.update({f"{letter}{x:g}": f"{y:.6g}" for x, y in zip(known, pin.values)})
    if pin.deviation:
        name = "U{:g}" if pin.region is None else f"deviation {letter}{{:g}}"  # as Patch Sampler names it
        row.update({name.format(x): f"{y:.6g}" for x, y in zip(known, pin.deviation)})
    if pin.measured:
        row.update({f"R{x:g}": f"{y:.6g}" for x, y in zip(*pin.measured)})
    return row
