"""What a line chart of Spectral Profile shows first: wavelength across, titles, one curve per place."""

from paraview import simple

_done = set()  # global ids of the charts' displays


def adapt_views():
    for view in simple.GetViews():
        if view.SMProxy.GetXMLName() != "XYChartView":
            continue
        for display in view.Representations:
            source = getattr(display, "Input", None)
            key = display.SMProxy.GetGlobalID()
            if source is not None and key not in _done and source.SMProxy.GetXMLName() == "SpectralProfile" and \
                    source.GetDataInformation(source.Port).GetNumberOfRows() > 0:
                _done.add(key)
                _adapt(view, display, source)


def _adapt(view, display, source):
    rows = source.GetDataInformation(source.Port).DataInformation.GetRowDataInformation()
    columns = [rows.GetArrayInformation(i).GetName() for i in range(rows.GetNumberOfArrays())]
    across = "wavelength" if "wavelength" in columns else "channel"
    image = source.Input
    kind = "Reflectance" if image is not None and image.PointData.GetArray("Reflectance") else "Responses"
    display.UseIndexForXAxis = 0
    display.XArrayName = across
    hidden = ("deviation", "-s", "+s")
    display.SeriesVisibility = [name for name in columns if name != across and not name.endswith(hidden)]
    view.BottomAxisTitle = "Wavelength (nm)" if across == "wavelength" else "Channel"
    view.LeftAxisTitle = "Reflectance factor" if kind == "Reflectance" else "Response (1 = white)"
    simple.Render(view)
