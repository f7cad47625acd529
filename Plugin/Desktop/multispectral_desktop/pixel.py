"""What the pipeline knows of one pixel: read from the data that ParaView holds, nothing is computed."""

import collections
import math

from paraview import servermanager, simple

SPECTRA = ("Reflectance", "Responses")

# values: the spectrum; deviation: its standard uncertainty, or None; measured: the reference at the pixel, or None;
# errors: {"dE00 D65": 1.2, ..}; region: None for one pixel, else two opposite corners, of whose pixels values are the mean and
# deviation is the standard deviation; count: the pixels of the region; source: its number among ParaView's, and port; grid: of the
# image, as grid_of says
Pixel = collections.namedtuple(
    "Pixel", "name column row point kind wavelengths values deviation measured errors source port grid region count", defaults=(None, 1))


def world_point(view, x, y):
    """The point of the plane z = 0 below a pixel of the view, or None."""
    renderer = view.GetRenderer()
    ends = []
    for depth in (0.0, 1.0):
        renderer.SetDisplayPoint(x, y, depth)
        renderer.DisplayToWorld()
        place = renderer.GetWorldPoint()
        if place[3] == 0.0:
            return None
        ends.append([value / place[3] for value in place[:3]])
    (near, far) = ends
    if near[2] == far[2]:
        return None
    share = near[2] / (near[2] - far[2])
    return [near[i] + share * (far[i] - near[i]) for i in range(2)]


def visible_images(view):
    """The images that the view shows, the last shown first: (source, port, display)."""
    for display in reversed(list(view.Representations)):
        shown = getattr(display, "Visibility", 0) and getattr(display, "Input", None)
        if shown and shown.GetDataInformation(shown.Port).GetDataSetTypeAsString() == "vtkImageData":
            yield display.Input, display.Input.Port, display


def data_of(source, port):
    """The image behind a port where this process holds it, else None."""
    algorithm = source.SMProxy.GetClientSideObject()
    data = algorithm.GetOutputDataObject(port) if algorithm is not None else None
    return data if data is not None and data.IsA("vtkImageData") else None


def _spectral_array(data):
    for name in SPECTRA:
        array = data.GetPointData().GetArray(name)
        if array is not None:
            return array
    return None


def wavelengths_of(data, array):
    known = data.GetFieldData().GetArray("Wavelength")
    count = array.GetNumberOfComponents()
    if known is not None and known.GetNumberOfTuples() == count:
        return [known.GetValue(i) for i in range(count)]
    return None


def _judges(evaluator, source):
    """Whether an evaluator judges the output of this source, itself or by filters that keep the spectra."""
    seen = evaluator.Input
    while seen is not None:
        if seen.SMProxy is source.SMProxy:
            return True
        seen = getattr(seen, "Input", None) if seen.SMProxy.GetXMLName() == "SpectralToColor" else None
    return evaluator.SMProxy is source.SMProxy


def _root(source):
    """The number of the reader that an image comes from."""
    while hasattr(getattr(source, "Input", None), "SMProxy"):
        source = source.Input
    return source.SMProxy.GetGlobalID()


def _of_kind(xml):
    return [source for source in simple.GetSources().values() if source.SMProxy.GetXMLName() == xml]


def _companions(source):
    """The error maps of an image, and its measured reflectance or None: what an error map compares it with, else the patches of its
    own scene. Another scene's image may have the same size."""
    evaluators = [evaluator for evaluator in _of_kind("CIEDE2000Evaluator") if _judges(evaluator, source)]
    references = [evaluator.Reference for evaluator in evaluators if evaluator.Reference is not None]
    references += [patches for patches in _of_kind("PatchReferenceImage") if _root(patches) == _root(source)]
    return evaluators, next(iter(references), None)


def _is_up_to_date(source, data):
    """Not where what it judges has changed since, and no view has asked for it."""
    executive = source.SMProxy.GetClientSideObject().GetExecutive()
    executive.UpdatePipelineMTime()
    return executive.GetPipelineMTime() <= data.GetUpdateTime()


def at(view, x, y):
    """The pixel of the first spectral image under a place of the view, or None."""
    point = world_point(view, x, y)
    if point is None:
        return None
    for source, port, _ in visible_images(view):
        if source.SMProxy.GetXMLName() == "CIEDE2000Evaluator" and getattr(source, "Input", None) is not None:
            source, port = source.Input, source.Input.Port  # over an error map: the spectrum that it judges
        found = _of_point(source, port, point)
        if found is not None:
            return found
    return None


def _of_point(source, port, point):
    extent, origin, spacing = grid(source, port)
    if extent is None:
        return None
    column, row = (math.floor((point[i] - origin[i]) / spacing[i] + 0.5) for i in range(2))
    if not (extent[0] <= column <= extent[1] and extent[2] <= row <= extent[3]):
        return None
    number = (row - extent[2]) * (extent[1] - extent[0] + 1) + column - extent[0]

    def read(image, image_port, name=None):
        """What this image or one of its size holds there."""
        data = data_of(image, image_port)
        if data is None:
            return _profile(image, image_port, name, Points=list(point[:2]))
        array = data.GetPointData().GetArray(name) if name else _spectral_array(data)
        return _Profile(array.GetName(), wavelengths_of(data, array), list(array.GetTuple(number)), None, 1) if array is not None else None

    profile = read(source, port)
    if profile is None:
        return None
    deviation = read(source, port, "Uncertainty") if "Uncertainty" in arrays(source, port) else None
    evaluators, reference = _companions(source)
    errors = {}
    for evaluator in evaluators:
        data = data_of(evaluator, 0)
        if grid(evaluator, 0)[0] != extent or data is not None and not _is_up_to_date(evaluator, data):
            continue
        for name in arrays(evaluator, 0):
            error = read(evaluator, 0, name) if name.startswith("dE") and name not in errors else None
            if error is not None and math.isfinite(error.values[0]):
                errors[name] = error.values[0]
    top = extent[3] - row  # as images count rows: from the top
    return Pixel(name_of(source), column, top, list(point), profile.kind, profile.across, profile.values, deviation and deviation.values,
                 _measured(reference, profile, extent, read), errors, source.SMProxy.GetGlobalID(), port, grid_of(source, port))


def _measured(reference, profile, extent, read):
    """The wavelengths and values of the reference in the same place, where all of it was measured."""
    if reference is None or profile.kind != "Reflectance" or grid(reference, reference.Port)[0] != extent:
        return None
    known = read(reference, reference.Port, "Reflectance")
    if known is None or known.count != profile.count or not any(map(math.isfinite, known.values)):
        return None
    return known.across or profile.across, known.values


def source_of(pin):
    """The source of its image; None where there is none any more."""
    return next((source for source in simple.GetSources().values() if source.SMProxy.GetGlobalID() == pin.source), None)


def again(pin):
    """The same place as its image is now, or None where it has no spectrum there any more."""
    source = source_of(pin)
    if source is None:
        return None
    return _of_point(source, pin.port, pin.point) if pin.region is None else _mean(source, pin.port, pin.region)


def region(view, start, end):
    """The mean spectrum of the pixels between two places of a view, or None; also where the data are with a server."""
    ends = [world_point(view, *place) for place in (start, end)]
    if None in ends:
        return None
    for source, port, _ in visible_images(view):
        if source.SMProxy.GetXMLName() == "CIEDE2000Evaluator" and getattr(source, "Input", None) is not None:
            source, port = source.Input, source.Input.Port
        found = _mean(source, port, ends)
        if found is not None:
            return found
    return None


def _mean(source, port, ends):
    extent, origin, spacing = grid(source, port)
    if extent is None:
        return None
    first, last = ([origin[i] + spacing[i] * extent[2 * i + end] for i in range(2)] for end in range(2))
    low, high = ([min(max(choose(place[i] for place in ends), first[i]), last[i]) for i in range(2)] for choose in (min, max))
    if any(low[i] >= high[i] for i in range(2)):
        return None

    def read(image, image_port, name=None):
        return _profile(image, image_port, name, Points=[], Region=[low[0], high[0], low[1], high[1]])

    profile = read(source, port)
    if profile is None:
        return None
    measured = _measured(_companions(source)[1], profile, extent, read)
    place = [(low[i] + high[i]) / 2 for i in range(2)]
    column, up = (math.floor((place[i] - origin[i]) / spacing[i] + 0.5) for i in range(2))
    return Pixel(name_of(source), column, extent[3] - up, place, profile.kind, profile.across, profile.values,
                 profile.deviation, measured, {}, source.SMProxy.GetGlobalID(), port, grid_of(source, port), (low, high), profile.count)


def grid(source, port):
    """Extent, origin and spacing of an image; (None, None, None) where there is none."""
    data = data_of(source, port)
    if data is not None:  # what ParaView gathered of it may be of a part that a filter has asked for
        extent, origin, spacing = data.GetExtent(), data.GetOrigin(), data.GetSpacing()
        return (extent, origin, spacing) if extent[0] <= extent[1] else (None, None, None)
    information = source.GetDataInformation(port).DataInformation
    extent = information.GetExtent()
    if information.GetDataSetTypeAsString() != "vtkImageData" or extent[0] > extent[1]:
        return None, None, None
    bounds = information.GetBounds()
    spacing = [(bounds[2 * i + 1] - bounds[2 * i]) / max(1, extent[2 * i + 1] - extent[2 * i]) or 1.0 for i in range(2)]
    return extent, [bounds[2 * i] - spacing[i] * extent[2 * i] for i in range(2)], spacing


def grid_of(source, port):
    """What two images have in common whose pixels lie in the same places."""
    extent, origin, spacing = grid(source, port)
    return None if extent is None else (*extent, *origin, *spacing)


def visible_grids(view):
    return {grid_of(source, port) for source, port, _ in visible_images(view)}


_profiles = {}


def forget(known):
    """The profiles of all sources but these: they would keep a deleted source alive, and take an undone one for it."""
    for key in [key for key in _profiles if key[0] not in known]:
        del _profiles[key]


_Profile = collections.namedtuple("_Profile", "kind across values deviation count")


def arrays(source, port):
    """The names of the point arrays behind a port."""
    arrays = source.GetDataInformation(port).DataInformation.GetPointDataInformation()
    return [arrays.GetArrayInformation(i).GetName() for i in range(arrays.GetNumberOfArrays())]


def _profile(source, port, array=None, **places):
    """What the filter Spectral Profile gives of a place: one row per wavelength; None where there is no spectrum."""
    kind = array or next((name for name in SPECTRA if name in arrays(source, port)), None)
    if kind is None:
        return None
    key = source.SMProxy.GetGlobalID(), port, kind
    try:
        if key not in _profiles:
            _profiles[key] = servermanager.filters.SpectralProfile(
                Input=servermanager.OutputPort(source, port), SpectralArray=kind)
        profile = _profiles[key]
        for name, value in places.items():
            setattr(profile, name, value)
        profile.UpdatePipeline()
        table = servermanager.Fetch(profile)
    except RuntimeError:
        return None
    names = [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())] if table else []
    if len(names) < 2 or table.GetNumberOfRows() == 0:
        return None
    columns = [[table.GetColumn(i).GetValue(row) for row in range(table.GetNumberOfRows())] for i in range(min(3, len(names)))]
    counts = table.GetFieldData().GetAbstractArray("Count")
    return _Profile(kind, columns[0] if names[0] == "wavelength" else None, columns[1],
                    columns[2] if len(columns) > 2 else None, counts.GetValue(0) if counts is not None else 1)


def name_of(source):
    for (name, _), known in simple.GetSources().items():
        if known.SMProxy is source.SMProxy:
            return name
    return source.SMProxy.GetXMLLabel()
