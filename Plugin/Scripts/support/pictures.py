"""Pictures of pipelines, drawn without a display: images with a color legend, and charts of tables."""

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from . import command, outputs, painter, pipeline, report

# Okabe and Ito's palette: told apart with any color vision.
COLORS = {
    "measured": (0.0, 0.0, 0.0),
    "direct": (0.60, 0.60, 0.60),
    "pinv": (0.90, 0.62, 0.0),
    "pooled": (0.34, 0.71, 0.91),
    "r-model": (0.80, 0.47, 0.65),
    "banded": (0.0, 0.45, 0.70),
    "transfer": (0.84, 0.37, 0.0),
    # The other methods of the literature: the palette again, lighter.
    "wiener": (0.0, 0.62, 0.45),
    "adaptive-wiener": (0.50, 0.81, 0.72),
    "pca": (0.94, 0.89, 0.26),
    "kernel-ridge": (0.35, 0.20, 0.55),
    "local-linear": (0.60, 0.50, 0.75),
    "polynomial": (0.55, 0.27, 0.07),
    "root-polynomial": (0.78, 0.62, 0.45),
    "sparse": (0.40, 0.40, 0.40),
    "calibration": (0.60, 0.60, 0.60),
    "held out": (0.34, 0.71, 0.91),
    "tuning": (0.84, 0.37, 0.0),
    "estimated": (0.84, 0.37, 0.0),
}
DIFFERENCES = (0.0, 1.0, 2.0, 3.0, 5.0)  # the scale of every map of color differences, as in ParaView's window
_NO_VALUE = "#D1D1D1"
_GRID = "#E0E0E0"
_DPI = 100
_LEGEND = 150  # pixels at the right of an image
_PANEL = 300  # pixels of one of several images side by side
_BLOCK_PIXELS = 1 << 20
_MOST_NAMES_WITHIN = 4  # a longer legend stands beside its chart
_STYLE = {"font.size": 12, "axes.spines.top": False, "axes.spines.right": False, "axes.axisbelow": True,
          "axes.grid": True, "grid.color": _GRID, "axes.titlesize": 15, "axes.labelsize": 13}


class LineStyle:
    NONE, SOLID, DASH, DOT = 0, 1, 2, 3


class Marker:
    NONE, CROSS, PLUS, SQUARE, CIRCLE, DIAMOND = 0, 1, 2, 3, 4, 5


_LINES = {LineStyle.NONE: "none", LineStyle.SOLID: "-", LineStyle.DASH: "--", LineStyle.DOT: ":"}
_MARKERS = {Marker.NONE: "none", Marker.CROSS: "x", Marker.PLUS: "+", Marker.SQUARE: "s", Marker.CIRCLE: "o",
            Marker.DIAMOND: "D"}


def size(source):
    """Columns and rows of an image."""
    source.UpdatePipelineInformation()
    pipeline.fail_on_error()
    information = source.SMProxy.GetClientSideObject().GetOutputInformation(getattr(source, "Port", 0))
    extent = information.Get(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT())
    return extent[1] - extent[0] + 1, extent[3] - extent[2] + 1


def values(source, array=None):
    """An array of an image, the first one by default: rows from the top, columns, components."""
    data = pipeline.whole(source)
    width, height, _ = data.GetDimensions()
    known = data.GetPointData()
    found = vtk_to_numpy(known.GetArray(array) if array else known.GetArray(0))
    return found.reshape(height, width, -1)[::-1]


def image(source, array, path, value_range=None, rgb=False, shown=1000):
    """A picture of one array of an image, upright, each pixel enlarged by a whole number.

    shown: pixels of the longer side that the picture has at least."""
    pixels = values(source, array)
    if rgb:
        painter.draw(path, _draw_colors, pixels, shown)
    else:
        painter.draw(path, _draw_image, pixels[:, :, 0], array, value_range, shown)


def srgb(source, path):
    """The array sRGB at the image's own size, with the ICC profile that says so. Block by block: of the spectra behind the
    colors only a few rows are in memory at a time."""
    width, height = size(source)
    if command.rank() != 0:
        return
    rows = max(1, _BLOCK_PIXELS // width)
    colors = numpy.empty((height, width, 3), numpy.uint8)
    algorithm = source.SMProxy.GetClientSideObject()
    for begin in range(0, height, rows):
        end = min(begin + rows, height)
        algorithm.UpdateExtent((0, width - 1, begin, end - 1, 0, 0))
        pipeline.fail_on_error()
        data = algorithm.GetOutputDataObject(getattr(source, "Port", 0))
        block = vtk_to_numpy(data.GetPointData().GetArray("sRGB")).reshape(-1, width, 3)
        first = begin - data.GetExtent()[2]
        colors[height - end:height - begin] = block[first:first + end - begin][::-1]
    painter.draw(path, _write_srgb, colors)


def _write_srgb(path, colors):
    from PIL import Image, ImageCms
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    with outputs.written(path, outputs.END_OF_PNG) as part:
        Image.fromarray(colors, "RGB").save(part, format="PNG", icc_profile=profile)


def _scale(pixels, shown):
    return max(1, round(shown / max(pixels.shape[:2])))


def _draw_colors(path, pixels, shown):
    scale = _scale(pixels, shown)
    _write_png(numpy.repeat(numpy.repeat(pixels, scale, 0), scale, 1), path)


def _draw_image(path, pixels, title, value_range, shown):
    """With its color legend at the right."""
    scale = _scale(pixels, shown)
    height, width = (scale * count for count in pixels.shape)
    enlarged = max(1.0, max(pixels.shape) / shown)
    legend = round(_LEGEND * enlarged)
    figure = _figure((width + legend, height))
    plot = figure.add_axes((0.0, 0.0, width / (width + legend), 1.0))
    fixed = title.startswith("dE") and value_range == (DIFFERENCES[0], DIFFERENCES[-1])
    drawn = _draw(plot, pixels, "viridis", value_range, _even_steps() if fixed else None)
    bar = figure.colorbar(drawn, ticks=DIFFERENCES if fixed else None, cax=figure.add_axes(((width + 0.15 * legend) / (width + legend), 0.12,
                                                      0.12 * legend / (width + legend), 0.76)))
    bar.set_label(report.in_words(title), fontsize=13 * enlarged)
    bar.ax.tick_params(labelsize=11 * enlarged)
    bar.outline.set_visible(False)
    _save(figure, path)


def _even_steps():
    """As much color from one step of DIFFERENCES to the next."""
    from matplotlib.colors import FuncNorm
    place = numpy.linspace(0.0, 1.0, len(DIFFERENCES))
    return FuncNorm((lambda x: numpy.interp(x, DIFFERENCES, place), lambda y: numpy.interp(y, place, DIFFERENCES)),
                    DIFFERENCES[0], DIFFERENCES[-1])


def _draw(plot, pixels, colors, value_range, norm=None):
    """One pixel of the image is a whole number of pixels; no value is grey."""
    import matplotlib
    plot.set_axis_off()
    low, high = (None, None) if norm else value_range or (None, None)
    shades = matplotlib.colormaps[colors].with_extremes(bad=_NO_VALUE)
    return plot.imshow(numpy.ma.masked_invalid(pixels), cmap=shades, norm=norm, vmin=low, vmax=high, aspect="auto",
                       interpolation="nearest")


def channel_row(panels, path):
    """Images of one channel side by side; panels: (pixels, title, (low, high))."""
    painter.draw(path, _draw_row, panels)


def _draw_row(path, panels):
    height, width = panels[0][0].shape
    scale = max(1, round(_PANEL / max(width, height)))
    enlarged = max(1.0, max(width, height) / _PANEL)
    width, height, foot = scale * width, scale * height, round(70 * enlarged)
    gap = round(16 * enlarged)
    whole = (len(panels) * width + (len(panels) - 1) * gap, height + foot)
    figure = _figure(whole)
    for number, (pixels, title, bounds) in enumerate(panels):
        left = number * (width + gap)
        plot = figure.add_axes((left / whole[0], foot / whole[1], width / whole[0], height / whole[1]))
        drawn = _draw(plot, pixels, "coolwarm" if bounds[0] < 0.0 else "viridis", bounds)
        bar = figure.colorbar(drawn, orientation="horizontal", cax=figure.add_axes(
            ((left + 0.1 * width) / whole[0], 0.68 * foot / whole[1], 0.8 * width / whole[0], 0.18 * foot / whole[1])))
        bar.set_label(report.in_words(title), fontsize=10 * enlarged, labelpad=1)
        bar.locator.set_params(nbins=4)
        bar.update_ticks()
        bar.ax.tick_params(labelsize=8 * enlarged, pad=1)
        bar.outline.set_visible(False)
    _save(figure, path)


class Chart:
    """An XY chart; series come from the columns of tables."""

    def __init__(self, title, x_title, y_title, log_y=False, size=(1000, 640)):
        self._titles = title, x_title, y_title
        self._log_y, self._size = log_y, size
        self._series, self._bands = [], []
        self._limits = {}
        self._legend = "best"

    def add(self, source, x, series, line=LineStyle.SOLID, marker=Marker.NONE, width=2.0,
            marker_size=6.0):
        """series: {column: (label, color)} or {column: (label, color, line style, width)}; x: a column, or the values; None: the
        row number."""
        data = pipeline.whole(source)
        across = list(range(data.GetNumberOfRows())) if x is None else _column(data, x) if isinstance(x, str) else x
        for column, (label, color, *style) in series.items():
            self._series.append((across, _column(data, column), dict(
                label=label or "_", color=color, linestyle=_LINES[style[0] if style else line],
                linewidth=style[1] if len(style) > 1 else width, marker=_MARKERS[marker],
                markersize=marker_size)))

    def band(self, source, x, low, high, color):
        """A shaded band between two columns; none where a value is missing."""
        data = pipeline.whole(source)
        self._bands.append(([_column(data, name) for name in (x, low, high)], color))

    def limits(self, left=None, bottom=None):
        self._limits.update({axis: bounds for axis, bounds in (("y", left), ("x", bottom)) if bounds})

    def legend_at(self, location):
        self._legend = {"TopLeft": "upper left", "TopRight": "upper right", "BottomLeft": "lower left",
                        "BottomRight": "lower right"}[location]

    def save(self, path):
        painter.draw(path, _draw_chart, self)

    def draw(self, path):
        import matplotlib
        with matplotlib.rc_context(_STYLE):
            figure = _figure(self._size, layout="constrained")
            plot = figure.subplots()
            for columns, color in self._bands:
                plot.fill_between(*columns, color=color, alpha=0.15, linewidth=0.0)
            for across, upwards, style in self._series:
                plot.plot(across, upwards, **style)
            title, x_title, y_title = self._titles
            plot.set_title(title)
            plot.set_xlabel(x_title)
            plot.set_ylabel(y_title)
            if self._log_y:
                _scale_by_decades(plot)
            for axis, bounds in self._limits.items():
                (plot.set_ylim if axis == "y" else plot.set_xlim)(*bounds)
            self._add_legend(plot)
            _save(figure, path)

    def _add_legend(self, plot):
        names = [style["label"] for _, _, style in self._series if not style["label"].startswith("_")]
        if len(names) > _MOST_NAMES_WITHIN:
            plot.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=11)
        elif names:
            plot.legend(loc=self._legend, fontsize=11)


def _draw_chart(path, chart):
    chart.draw(path)


def _scale_by_decades(plot):
    """Numbers at 1, 2 and 5 of each decade, as they are."""
    from matplotlib import ticker
    plot.set_yscale("log")
    plot.yaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
    plot.yaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    plot.yaxis.set_minor_formatter(ticker.NullFormatter())
    plot.grid(which="minor", color=_GRID, linewidth=0.5)


def _column(table, name):
    column = table.GetColumnByName(name)
    return [column.GetValue(row) for row in range(table.GetNumberOfRows())]


def _figure(pixels, **options):
    # Not by pyplot, which takes a while to load and keeps every figure.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    figure = Figure(figsize=(pixels[0] / _DPI, pixels[1] / _DPI), dpi=_DPI, **options)
    FigureCanvasAgg(figure)
    return figure


def _save(figure, path):
    with outputs.written(path, outputs.END_OF_PNG) as part:
        figure.savefig(part, format="png", dpi=_DPI, metadata={"Software": None})


def _write_png(pixels, path):
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkIOImage import vtkPNGWriter
    flipped = numpy.ascontiguousarray(pixels[::-1])
    data = vtkImageData()
    data.SetDimensions(flipped.shape[1], flipped.shape[0], 1)
    data.GetPointData().SetScalars(numpy_to_vtk(flipped.reshape(-1, flipped.shape[2])))
    writer = vtkPNGWriter()
    writer.SetInputData(data)
    with outputs.written(path, outputs.END_OF_PNG) as part:
        writer.SetFileName(part)
        writer.Write()
        pipeline.fail_on_error()
