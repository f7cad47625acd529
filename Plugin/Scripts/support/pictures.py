"""Pictures of pipelines: images with a color legend, and charts of tables."""

import os

from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from . import outputs

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
_TEXT = (0.1, 0.1, 0.1)
_GRID = (0.88, 0.88, 0.88)
_PANEL = 300  # pixels of one of several images side by side


class LineStyle:
    NONE, SOLID, DASH, DOT = 0, 1, 2, 3


class Marker:
    NONE, CROSS, PLUS, SQUARE, CIRCLE, DIAMOND = 0, 1, 2, 3, 4, 5


def _whole_extent(source):
    """Of the whole image: a rank's own data information would tell of its piece only."""
    information = source.SMProxy.GetClientSideObject().GetOutputInformation(
        getattr(source, "Port", 0))
    return information.Get(vtkStreamingDemandDrivenPipeline.WHOLE_EXTENT())


def _frame(source):
    """Extent, origin and spacing of the whole image."""
    information = source.SMProxy.GetClientSideObject().GetOutputInformation(
        getattr(source, "Port", 0))
    return (_whole_extent(source), information.Get(vtkDataObject.ORIGIN()),
            information.Get(vtkDataObject.SPACING()))


def size(source):
    """Columns and rows of an image."""
    source.UpdatePipelineInformation()
    extent = _whole_extent(source)
    return extent[1] - extent[0] + 1, extent[3] - extent[2] + 1


def image(source, array, path, value_range=None, rgb=False):
    """A picture of one array of an image, upright, each pixel enlarged by a whole number."""
    view = image_view(source, array, value_range, rgb)
    _save(view, path)


def image_view(source, array, value_range=None, rgb=False, shown=1000):
    """shown: pixels of the longer side that the picture will have before a reader; the legend is as large as that asks."""
    extent, origin, spacing = _frame(source)
    width, height = extent[1] - extent[0] + 1, extent[3] - extent[2] + 1
    scale = max(1, round(shown / max(width, height)))
    enlarged = _enlarged(max(width, height), shown)
    legend = 0 if rgb else round(150 * enlarged)
    view = simple.CreateView("RenderView")
    view.ViewSize = [width * scale + legend, height * scale]
    view.OrientationAxesVisibility = 0
    view.CameraParallelProjection = 1
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    display = simple.Show(source, view, "UniformGridRepresentation")
    display.SetRepresentationType("Slice")
    display.InterpolateScalarsBeforeMapping = 0
    if rgb:
        simple.ColorBy(display, ("POINTS", array))
        display.MapScalars = 0
    else:
        _map_errors(display, view, array, value_range, enlarged)
    # The image fills the view but for the legend at the right.
    units = spacing[0] / scale
    center_x = origin[0] + 0.5 * (extent[0] + extent[1]) * spacing[0] + 0.5 * legend * units
    center_y = origin[1] + 0.5 * (extent[2] + extent[3]) * spacing[1]
    view.CameraFocalPoint = [center_x, center_y, 0.0]
    view.CameraPosition = [center_x, center_y, 1000.0]
    view.CameraParallelScale = 0.5 * view.ViewSize[1] * units
    return view


def _enlarged(longer, shown):
    """How much larger than shown a picture of whole pixels is at least."""
    return max(1.0, longer / shown)


def _map_errors(display, view, array, value_range, enlarged):
    simple.ColorBy(display, ("POINTS", array))
    colors = simple.GetColorTransferFunction(array)
    colors.ApplyPreset("Viridis (matplotlib)", True)
    colors.NanColor = [0.82, 0.82, 0.82]
    if value_range:
        colors.RescaleTransferFunction(*value_range)
    else:
        display.RescaleTransferFunctionToDataRange(False, True)
    _place_bar(simple.GetScalarBar(colors, view), array, view, enlarged)
    display.SetScalarBarVisibility(view, True)


def _place_bar(bar, title, view, enlarged):
    """Into the margin at the right of an image."""
    bar.Title = title
    bar.ComponentTitle = ""
    bar.TitleColor = _TEXT
    bar.LabelColor = _TEXT
    bar.TitleFontSize = round(16 * enlarged)
    bar.LabelFontSize = round(14 * enlarged)
    bar.ScalarBarThickness = round(16 * enlarged)
    bar.Orientation = "Vertical"
    bar.WindowLocation = "Any Location"
    bar.Position = [1.0 - 120.0 * enlarged / view.ViewSize[0], 0.12]
    bar.ScalarBarLength = 0.7
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = "%-.3g"
    bar.RangeLabelFormat = "%-.3g"


def channel_row(panels, component, path):
    """One channel of several images side by side; panels: (source, array, title, (low, high)). No array: the active one."""
    layout = simple.CreateLayout(os.path.basename(path))
    cell, views, whole = 0, [], [0, 0]
    for i, (source, array, title, bounds) in enumerate(panels):
        name = array or source.PointData.GetArray(0).GetName()
        view = image_view(source, name, bounds, shown=_PANEL)
        display = simple.GetDisplayProperties(source, view)
        display.SetScalarBarVisibility(view, False)  # that of all channels together
        display.UseSeparateColorMap = 1
        simple.ColorBy(display, ("POINTS", name, source.PointData.GetArray(name).GetComponentName(component)),
                       separate=True)
        colors = simple.GetColorTransferFunction(name, display, separate=True)
        colors.ApplyPreset("Cool to Warm" if bounds[0] < 0.0 else "Viridis (matplotlib)", True)
        colors.NanColor = [0.82, 0.82, 0.82]
        colors.RescaleTransferFunction(*bounds)
        _place_bar(simple.GetScalarBar(colors, view), title, view, _enlarged(max(size(source)), _PANEL))
        display.SetScalarBarVisibility(view, True)
        if i + 1 < len(panels):
            cell = layout.SplitHorizontal(cell, 1.0 / (len(panels) - i))
            layout.AssignView(cell, view)
            cell += 1
        else:
            layout.AssignView(cell, view)
        whole = [whole[0] + view.ViewSize[0], max(whole[1], view.ViewSize[1])]
        views.append(view)
    layout.SetSize(whole)
    _save_screenshot(path, layout, whole)
    for view in views:
        simple.Delete(view)
    simple.Delete(layout)


class Chart:
    """An XY chart; series come from the columns of tables."""

    def __init__(self, title, x_title, y_title, log_y=False, size=(1000, 640)):
        self.view = simple.CreateView("XYChartView")
        view = self.view
        view.ViewSize = list(size)
        view.ChartTitle = title
        view.ChartTitleFontSize = 18
        view.BottomAxisTitle = x_title
        view.LeftAxisTitle = y_title
        view.LeftAxisLogScale = 1 if log_y else 0
        for axis in ("Left", "Bottom"):
            setattr(view, f"{axis}AxisTitleFontSize", 16)
            setattr(view, f"{axis}AxisLabelFontSize", 14)
            setattr(view, f"{axis}AxisGridColor", list(_GRID))
        view.LegendFontSize = 14
        view.ShowLegend = 1

    def add(self, source, x, series, line=LineStyle.SOLID, marker=Marker.NONE, width=2.0,
            marker_size=6.0):
        """series: {column: (label, color)} or {column: (label, color, line style, width)}; x None: the row number."""
        display = simple.Show(source, self.view, "XYChartRepresentation")
        display.AttributeType = "Row Data"
        display.UseIndexForXAxis = 1 if x is None else 0
        if x is not None:
            display.XArrayName = x
        display.SeriesVisibility = list(series)
        labels, colors, lines, widths, markers, sizes = [], [], [], [], [], []
        for column, (label, color, *style) in series.items():
            labels += [column, label]
            colors += [column] + [str(part) for part in color]
            lines += [column, str(style[0] if style else line)]
            widths += [column, str(style[1] if len(style) > 1 else width)]
            markers += [column, str(marker)]
            sizes += [column, str(marker_size)]
        display.SeriesLabel = labels
        display.SeriesColor = colors
        display.SeriesLineStyle = lines
        display.SeriesLineThickness = widths
        display.SeriesMarkerStyle = markers
        display.SeriesMarkerSize = sizes

    def limits(self, left=None, bottom=None):
        for axis, bounds in (("Left", left), ("Bottom", bottom)):
            if bounds:
                setattr(self.view, f"{axis}AxisUseCustomRange", 1)
                setattr(self.view, f"{axis}AxisRangeMinimum", bounds[0])
                setattr(self.view, f"{axis}AxisRangeMaximum", bounds[1])

    def legend_at(self, location):
        self.view.LegendLocation = location

    def save(self, path):
        _save(self.view, path)


def side_by_side(views):
    """A layout that ParaView shows when it opens the saved state: room around the image for any window,
    and surfaces, because a slice complains when a state is opened before it has data."""
    for view in views:
        view.CameraParallelScale *= 1.5
        for display in view.Representations:
            if hasattr(display, "SetRepresentationType"):
                display.SetRepresentationType("Surface")
                display.Ambient, display.Diffuse = 1.0, 0.0  # colors as they are
    layout = simple.CreateLayout("Multispectral")
    cell = 0
    for i, view in enumerate(views):
        if i + 1 < len(views):
            cell = layout.SplitHorizontal(cell, 1.0 / (len(views) - i))
        layout.AssignView(cell, view)
        cell += 1


def _save(view, path):
    simple.Render(view)
    _save_screenshot(path, view, list(view.ViewSize))
    simple.Delete(view)


def _save_screenshot(path, view, size):
    """ParaView says nothing when a picture cannot be written."""
    with outputs.written(path, outputs.END_OF_PNG) as part:
        simple.SaveScreenshot(part, view, ImageResolution=size, TransparentBackground=0)
