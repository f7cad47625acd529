"""What a line chart of the plugin's tables shows first: wavelength across, titles, one curve per place or channel."""

from paraview import simple

from . import notes
from .memory import first

# The title of the vertical axis; that of a profile depends on its image.
_TITLES = {"SpectralProfile": None, "CameraReader": "Sensitivity", "CameraModelFit": "Sensitivity (fitted)", "CurveReader": "Value"}
_HIDDEN = ("deviation", "-s", "+s")


def adapt_views():
    for view in simple.GetViews():
        if view.SMProxy.GetXMLName() != "XYChartView":
            continue
        for display in view.Representations:
            source = getattr(display, "Input", None)
            if source is not None and source.SMProxy.GetXMLName() in _TITLES and \
                    source.GetDataInformation(source.Port).GetNumberOfRows() > 0 and first("adapted", display):
                _adapt(view, display, source)


def _adapt(view, display, source):
    rows = source.GetDataInformation(source.Port).DataInformation.GetRowDataInformation()
    columns = [rows.GetArrayInformation(i).GetName() for i in range(rows.GetNumberOfArrays())]
    across = "wavelength" if "wavelength" in columns else "channel"
    if across not in columns:
        return
    display.UseIndexForXAxis = 0
    display.XArrayName = across
    display.SeriesVisibility = [name for name in columns if name != across and not name.endswith(_HIDDEN)]
    view.BottomAxisTitle = "Wavelength (nm)" if across == "wavelength" else "Channel"
    view.LeftAxisTitle = _TITLES[source.SMProxy.GetXMLName()] or _title_of_profile(source)
    simple.Render(view)


def _title_of_profile(source):
    image = source.Input
    return "Reflectance factor" if image is not None and image.PointData.GetArray("Reflectance") else notes.title_of_responses(image)
