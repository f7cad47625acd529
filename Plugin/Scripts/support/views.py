"""What ParaView shows when it opens a saved state: images in views side by side."""

from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

_TEXT = (0.1, 0.1, 0.1)


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
