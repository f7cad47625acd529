"""A chart of spectra, drawn by Qt: fast enough to follow the cursor."""

import math

from PyQt5 import QtCore, QtGui, QtWidgets

_LEFT, _RIGHT, _TOP, _BOTTOM = 58, 14, 12, 44  # pixels around the plot
_TEXT = QtGui.QColor(40, 40, 40)
_GRID = QtGui.QColor(224, 224, 224)


class Curve:
    """x: wavelengths in nm, or channel numbers; y: values; deviation: standard uncertainty of each, or None."""

    def __init__(self, x, y, label, color, deviation=None, dashed=False, width=2.0):
        self.x, self.y, self.label, self.deviation, self.dashed, self.width = x, y, label, deviation, dashed, width
        self.color = QtGui.QColor(color)


class SpectrumChart(QtWidgets.QWidget):
    def __init__(self, parent=None):
        super().__init__(parent)
        self.setMinimumSize(260, 200)
        self._curves, self._titles, self._band = [], ("Wavelength (nm)", "Reflectance factor"), None

    def show_curves(self, curves, titles):
        self._curves, self._titles = curves, titles
        self.update()

    def show_band(self, x):
        """A vertical line at this wavelength; None for none."""
        self._band = x
        self.update()

    def curves(self):
        return self._curves

    def _ranges(self):
        across = [x for curve in self._curves for x in curve.x]
        up = [y + sign * 2.0 * (d or 0.0) for curve in self._curves
              for y, d in zip(curve.y, curve.deviation or [0.0] * len(curve.y)) for sign in (-1, 1)]
        up = [y for y in up if math.isfinite(y)]
        left, right = (min(across), max(across)) if across else (400.0, 700.0)
        low, high = min([0.0, *up]), max([0.1, *up] if up else [1.0])
        return left, max(right, left + 1.0), low - (0.05 * (high - low) if low < 0.0 else 0.0), high + 0.05 * (high - low)

    def paintEvent(self, _event):
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.Antialiasing)
        painter.fillRect(self.rect(), QtCore.Qt.white)
        plot = QtCore.QRectF(_LEFT, _TOP, self.width() - _LEFT - _RIGHT, self.height() - _TOP - _BOTTOM)
        left, right, low, high = self._ranges()

        def place(x, y):
            return QtCore.QPointF(plot.left() + (x - left) / (right - left) * plot.width(),
                                  plot.bottom() - (y - low) / (high - low) * plot.height())

        self._draw_axes(painter, plot, (left, right), (low, high), place)
        painter.setClipRect(plot)
        if self._band is not None:
            painter.setPen(QtGui.QPen(QtGui.QColor(150, 150, 150), 1, QtCore.Qt.DotLine))
            painter.drawLine(place(self._band, low), place(self._band, high))
        for curve in self._curves:
            self._draw_curve(painter, curve, place)
        painter.setClipping(False)
        self._draw_legend(painter, plot)

    def _draw_axes(self, painter, plot, across, upwards, place):
        metrics = painter.fontMetrics()
        for x in _steps(*across, max(2, int(plot.width() / 50))):
            painter.setPen(_GRID)
            painter.drawLine(place(x, upwards[0]), place(x, upwards[1]))
            painter.setPen(_TEXT)
            text = f"{x:g}"
            painter.drawText(QtCore.QPointF(place(x, 0).x() - metrics.horizontalAdvance(text) / 2, plot.bottom() + 16), text)
        for y in _steps(*upwards, max(2, int(plot.height() / 40))):
            painter.setPen(_GRID)
            painter.drawLine(place(across[0], y), place(across[1], y))
            painter.setPen(_TEXT)
            text = f"{y:g}"
            painter.drawText(QtCore.QPointF(plot.left() - metrics.horizontalAdvance(text) - 5, place(0, y).y() + 4), text)
        painter.drawText(QtCore.QRectF(plot.left(), plot.bottom() + 20, plot.width(), 20), QtCore.Qt.AlignCenter,
                         self._titles[0])
        painter.save()
        painter.translate(14, plot.center().y())
        painter.rotate(-90)
        painter.drawText(QtCore.QRectF(-100, -10, 200, 20), QtCore.Qt.AlignCenter, self._titles[1])
        painter.restore()

    @staticmethod
    def _draw_curve(painter, curve, place):
        points = [place(x, y) for x, y in zip(curve.x, curve.y) if math.isfinite(y)]
        if curve.deviation:
            band = [(x, y, d) for x, y, d in zip(curve.x, curve.y, curve.deviation) if math.isfinite(y) and math.isfinite(d)]
            outline = [place(x, y + 2.0 * d) for x, y, d in band] + [place(x, y - 2.0 * d) for x, y, d in reversed(band)]
            shade = QtGui.QColor(curve.color)
            shade.setAlpha(50)
            painter.setPen(QtCore.Qt.NoPen)
            painter.setBrush(shade)
            painter.drawPolygon(QtGui.QPolygonF(outline))
        painter.setBrush(QtCore.Qt.NoBrush)
        pen = QtGui.QPen(curve.color, curve.width)
        if curve.dashed:
            pen.setStyle(QtCore.Qt.DashLine)
        painter.setPen(pen)
        painter.drawPolyline(QtGui.QPolygonF(points))

    def _draw_legend(self, painter, plot):
        for row, curve in enumerate(self._curves[:12]):
            y = plot.top() + 12 + 16 * row
            pen = QtGui.QPen(curve.color, curve.width)
            if curve.dashed:
                pen.setStyle(QtCore.Qt.DashLine)
            painter.setPen(pen)
            painter.drawLine(QtCore.QPointF(plot.left() + 8, y - 4), QtCore.QPointF(plot.left() + 30, y - 4))
            painter.setPen(_TEXT)
            painter.drawText(QtCore.QPointF(plot.left() + 36, y), painter.fontMetrics().elidedText(
                curve.label, QtCore.Qt.ElideRight, int(plot.width()) - 40))


def _steps(low, high, most):
    """Round numbers from low to high, at most so many."""
    raw = (high - low) / max(1, most)
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(power * factor for factor in (1.0, 2.0, 5.0, 10.0) if power * factor >= raw)
    first = math.ceil(low / step - 1e-9)
    return [round((first + i) * step, 10) for i in range(int((high - first * step) / step + 1e-9) + 1)]
