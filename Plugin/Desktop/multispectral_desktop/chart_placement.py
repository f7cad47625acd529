"""A color chart in an image: found automatically or by corners that are dragged in the view, saved as a table of samples."""

import os

from PyQt5 import QtCore, QtWidgets
from paraview import servermanager, simple

from . import messages, pixel, questions, view_choice
from .marks import Marks

# Columns and rows.
CHARTS = {"ColorChecker, 24 patches": (6, 4), "ColorChecker SG, 140 patches": (14, 10), "ColorChecker Passport, 24 patches": (6, 4),
          "Other": None}
_NEAR = 14  # pixels from a corner that still take it
_COLORS = ("#F0E442", "#56B4E9", "#56B4E9", "#56B4E9")  # the first patch's corner is yellow, as in the picture
_HINT = "Select the image of the chart in the Pipeline Browser, name the reference, and press Find."
_INSET = 0.15  # of the image's size: where corners start that were not found


class Placement(QtWidgets.QDialog):
    """Stays beside the view: its corners are moved there."""

    def __init__(self, parent):
        super().__init__(parent)
        self.setObjectName("MultispectralChartDialog")
        self.setWindowTitle("Chart")
        self.setMinimumWidth(460)
        self.finder = self.samples = self.view = self._held = None
        self.corners, self._marks, self._tags = [], Marks(), []
        self._made = []  # objects of the pipeline that a search has made and nobody has saved
        form = QtWidgets.QFormLayout(self)
        self.kind = QtWidgets.QComboBox()
        self.kind.setObjectName("MultispectralChartKind")
        self.kind.addItems(CHARTS)
        self.kind.currentTextChanged.connect(self._take_kind)
        form.addRow("Chart", self.kind)
        sizes = QtWidgets.QHBoxLayout()
        self.columns, self.rows = QtWidgets.QSpinBox(), QtWidgets.QSpinBox()
        for box, word in ((self.columns, "columns"), (self.rows, "rows")):
            box.setRange(1, 1000)
            sizes.addWidget(box)
            sizes.addWidget(QtWidgets.QLabel(word))
        form.addRow("Patches", sizes)
        self.reference = QtWidgets.QLineEdit()
        self.reference.setObjectName("MultispectralChartReference")
        self.reference.setPlaceholderText("table with the chart's measured reflectance (CSV, CGATS, CxF)")
        browse = QtWidgets.QPushButton("Browse\u2026")
        browse.setAutoDefault(False)
        browse.clicked.connect(self._browse)
        line = QtWidgets.QHBoxLayout()
        line.addWidget(self.reference, 1)
        line.addWidget(browse)
        form.addRow("Reference", line)
        self.status = QtWidgets.QLabel(_HINT)
        self.status.setObjectName("MultispectralChartStatus")
        self.status.setWordWrap(True)
        self.status.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        form.addRow(self.status)
        buttons = QtWidgets.QHBoxLayout()
        self.find_button = self._button(buttons, "Find", "Search for the chart in the selected image", self.find)
        self.save_button = self._button(buttons, "Save\u2026", "Save the chart's samples as a table", self._ask_file)
        self.save_button.setEnabled(False)
        self._button(buttons, "Close", "Close; what was found goes unless it was saved", self.close)
        form.addRow(buttons)
        self._take_kind(self.kind.currentText())

    def _button(self, layout, label, tip, action):
        button = QtWidgets.QPushButton(label)
        button.setObjectName(f"MultispectralChart{label.rstrip(chr(0x2026))}")
        button.setToolTip(tip)
        button.setAutoDefault(False)
        button.clicked.connect(lambda _checked: action())
        layout.addWidget(button)
        return button

    def _take_kind(self, name):
        size = CHARTS[name]
        for box, count in zip((self.columns, self.rows), size or (self.columns.value(), self.rows.value())):
            box.setValue(count)
            box.setEnabled(size is None)

    def _browse(self):
        path, _ = QtWidgets.QFileDialog.getOpenFileName(self, "The chart's measured reflectance", self.reference.text(),
                                                        "Tables (*.csv *.txt *.ti3 *.cie *.cgats *.cxf);;All files (*)",
                                                        options=QtWidgets.QFileDialog.DontUseNativeDialog)
        if path:
            self.reference.setText(path)

    def _say(self, *lines):
        self.status.setText("\n".join(filter(None, lines)))
        self.adjustSize()

    def find(self):
        """The chart in the selected image; where it is not found, corners to be dragged."""
        image = simple.GetActiveSource()
        if self.finder is not None and image is not None and image.SMProxy in (self.finder.SMProxy, self.samples.SMProxy):
            image = self._image
        extent, self._origin, self._spacing = pixel.grid(image, image.Port) if image is not None else (None, None, None)
        if extent is None:
            return self._say("The selected object is no image. Select the image of the chart in the Pipeline Browser.")
        path = self.reference.text()
        if not os.path.isfile(path):
            return self._say(f"{path or 'The reference'}: no such file. Name the table with the chart's measured reflectance.")
        self._put_back()
        self._image, self._extent = image, extent
        name = pixel.name_of(image)
        with messages.heard() as said:
            reference = simple.SampleTableReader(registrationName=f"{name}: chart reference", FileName=path)
            reference.UpdatePipeline()
        if said.errors:
            simple.Delete(reference)
            return self._say(said.errors[0])
        self._made = [reference]
        self.finder = simple.ChartFinder(registrationName=f"{name}: chart", Input=image, Reference=reference,
                                         GridColumns=self.columns.value(), GridRows=self.rows.value())
        self.samples = simple.PatchSampler(registrationName=f"{name}: chart samples", Input=image, Labels=self.finder[0],
                                           PatchTable=self.finder[1])
        self._made += [self.finder, self.samples]
        said = self._update()
        found = not said.errors
        self.corners = self._found_corners() if found else self._start_corners()
        # From now on the corners count, which are those that were found.
        self.finder.Placement = "Corners"
        if not found:
            error = said.errors[0]
            said = self._place()
            if said.errors:  # no place of the corners would mend that
                self._put_back()
                self.save_button.setEnabled(False)
                return self._say(said.errors[0] + ". Choose the chart and its own reference.")
        self._show()
        self._tell("" if found else f"{error}. Drag the corners onto the chart; the yellow one to its first patch.", said)

    def _update(self):
        with messages.heard() as said:
            self.samples.UpdatePipeline()
        return said

    def _place(self):
        for i, (x, y) in enumerate(self.corners):
            setattr(self.finder, f"Corner{i + 1}", [x, y, 0.0])
        return self._update()

    def _found_corners(self):
        table = servermanager.Fetch(self.finder, idx=2)
        value = lambda name: table.GetColumnByName(name).GetValue(0)
        corners = [(value(f"corner {i} x"), value(f"corner {i} y")) for i in range(1, 5)]
        for i, (x, y) in enumerate(corners):
            setattr(self.finder, f"Corner{i + 1}", [x, y, 0.0])
        return corners

    def _start_corners(self):
        place = lambda i, part: self._origin[i] + self._spacing[i] * (
            self._extent[2 * i] + part * (self._extent[2 * i + 1] - self._extent[2 * i]))
        return [(place(0, x), place(1, y)) for x, y in ((_INSET, 1 - _INSET), (1 - _INSET, 1 - _INSET), (1 - _INSET, _INSET),
                                                        (_INSET, _INSET))]

    def _tell(self, first, said):
        """What was found, and the patches to look at."""
        self.save_button.setEnabled(not said.errors)
        if said.errors:
            return self._say(first, said.errors[0])
        table = servermanager.Fetch(self.finder, idx=1)
        label, note = (table.GetColumnByName(name) for name in ("label", "note"))
        rows = range(table.GetNumberOfRows())
        marked = [f"{label.GetVariantValue(row).ToString()} ({note.GetValue(row)})" for row in rows if note.GetValue(row)]
        self._say(first or f"{len(rows)} patches, outlined in the view. Drag a corner to correct it.",
                  f"Patches to check: {', '.join(marked)}." if marked else "No patch is clipped or uneven.",
                  *questions.about(self.samples, "The chart"))

    def _show(self):
        simple.SetActiveSource(self._image)  # the finder's own handles would stand over the corners
        view_choice.adapt(is_new=True)
        self.view = simple.GetActiveViewOrCreate("RenderView")
        simple.Hide(self._image, self.view)
        display = simple.Show(self.finder, self.view)
        simple.ColorBy(display, ("POINTS", "Overlay"))
        self.view.InteractionMode = "2D"
        simple.ResetCamera(self.view)
        interactor = self.view.GetInteractor()
        for event, act in (("LeftButtonPressEvent", self._press), ("MouseMoveEvent", self._move),
                           ("LeftButtonReleaseEvent", self._release)):
            self._observe(interactor, event, act)
        self._draw()
        simple.Render(self.view)

    def _observe(self, interactor, event, act):
        def observer(who, _):
            if act(who.GetEventPosition()):
                who.GetCommand(tag).SetAbortFlag(1)
        tag = interactor.AddObserver(event, observer, 20.0)  # before the panel's
        self._tags.append((interactor, tag))

    def on_screen(self, place):
        renderer = self.view.GetRenderer()
        renderer.SetWorldPoint(*place, 0.0, 1.0)
        renderer.WorldToDisplay()
        return renderer.GetDisplayPoint()[:2]

    def _press(self, position):
        distances = [max(abs(a - b) for a, b in zip(self.on_screen(corner), position)) for corner in self.corners]
        nearest = min(range(4), key=distances.__getitem__)
        self._held = nearest if distances[nearest] <= _NEAR else None
        return self._held is not None

    def _move(self, position):
        if self._held is None:
            return False
        place = pixel.world_point(self.view, *position)
        if place is not None:
            self.corners[self._held] = tuple(place)
            self._draw()
        return True

    def _release(self, _position):
        if self._held is None:
            return False
        self._held = None
        said = self._place()
        self._draw()
        simple.Render(self.view)
        self._tell("", said)
        return True

    def _draw(self):
        outline = [*self.corners, self.corners[0]]
        self._marks.show(self.view, list(zip(self.corners, _COLORS)), [(outline, _COLORS[1])], size=11)

    def _ask_file(self):
        path, _ = QtWidgets.QFileDialog.getSaveFileName(self, "Save the chart's samples", "chart.csv", "CSV (*.csv)",
                                                        options=QtWidgets.QFileDialog.DontUseNativeDialog)
        if path:
            path += "" if os.path.splitext(path)[1] else ".csv"
            writer = servermanager.writers.SampleTableWriter(Input=self.samples, FileName=path)
            with messages.heard() as said:
                writer.UpdatePipeline()
            if not said.errors:
                self._made = []  # stays in the pipeline
            self._say(said.errors[0] if said.errors else f"Saved: {path}")

    def _forget(self):
        """What an earlier search has left in the view."""
        for interactor, tag in self._tags:
            interactor.RemoveObserver(tag)
        self._tags = []
        if self.view is not None and self.view.SMProxy.GetGlobalID() in {v.SMProxy.GetGlobalID() for v in
                                                                          simple.GetRenderViews()}:
            self._marks.clear(self.view)
        self.view = None

    def _put_back(self):
        """Everything as it was before the search, unless its samples were saved."""
        view, known = self.view, {source.SMProxy.GetGlobalID() for source in simple.GetSources().values()}
        self._forget()
        made = [source for source in reversed(self._made) if source.SMProxy.GetGlobalID() in known]
        self._made = []
        if not made:
            return
        active = simple.GetActiveSource()
        for source in made:
            simple.Delete(source)
        self.finder = self.samples = None
        if self._image.SMProxy.GetGlobalID() not in known:
            return
        if view is not None:
            simple.Show(self._image, view)
            simple.Render(view)
        if active is None or active.SMProxy in [source.SMProxy for source in made]:
            simple.SetActiveSource(self._image)

    def _end(self):
        self._put_back()
        self.save_button.setEnabled(False)
        self._say(_HINT)

    def done(self, result):
        self._end()
        super().done(result)

    def closeEvent(self, event):
        self._end()
        super().closeEvent(event)
