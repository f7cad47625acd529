"""The main job as a pipeline: a scene, estimated with the chart alone and corrected by swatches, before and after side by
side, with maps of the error where the scene has measured patches."""

import os

from paraview import simple

from . import captions, lights, messages, questions
from .messages import Missing

METHOD = "Transfer"
_MOST_PIXELS_WITH_UNCERTAINTY = 1_000_000
_BESIDE_LEGEND = 0.08  # of the image's width: as far all views are moved, so that the legends have their place


warnings = []  # of the filters of the last job, to be shown with its result


def open_scene(folder):
    """The folder as one source, named after it."""
    name = os.path.basename(os.path.normpath(folder))
    return name, _make(lambda: simple.SceneReader(registrationName=name, FileName=folder), 0, "The scene could not be opened")


def build(folder, chart=None, swatches=None, method=METHOD, light=lights.LIGHT, observer=lights.OBSERVER):
    """chart, swatches: files; None: those of the scene. light, observer: names or files (module lights). Returns the views;
    where a part fails, nothing of the job stays."""
    warnings.clear()
    known = set(simple.GetSources())
    try:
        return _build(folder, chart, swatches, method, light, observer)
    except Missing:
        made = [source for key, source in simple.GetSources().items() if key not in known]
        for source in sorted(made, key=lambda source: -source.SMProxy.GetGlobalID()):
            simple.Delete(source)
        raise


def _build(folder, chart, swatches, method, light, observer):
    name, scene = open_scene(folder)
    conditions = lights.Conditions(name, light, observer, _make)
    calibration = _table(scene, 3, chart, f"{name}: chart",
                         "the chart's samples (reflectance and camera responses) are missing; name their file, or put "
                         "chart.csv into the scene's folder")
    tuning = _table(scene, 4, swatches, f"{name}: swatches", None)
    fit = _make(lambda: simple.ReflectanceCalibration(registrationName=f"{name}: chart alone, fit", Input=calibration,
                                                      Method="Pseudoinverse"), 0, "The chart's calibration failed")
    jobs = [("chart alone", fit, None)]
    if tuning is not None:
        fit = _make(lambda: simple.MetamerismCorrection(registrationName=f"{name}: corrected, fit", Calibration=calibration,
                                                        Tuning=tuning, Method=method), 0, "The correction by swatches failed")
        jobs.append(("corrected by swatches", fit, 1))
    reference = _reference(name, scene)
    if reference is not None:
        warnings.extend(questions.about(
            lambda: simple.PatchSampler(Input=scene[0], Labels=scene[1], PatchTable=scene[2]), "the patches in the image", calibration))
    rows = [_row(name, scene, title, fit, second, reference, conditions) for title, fit, second in jobs]
    return _show(name, rows, conditions)


def _has_data(source, port):
    information = source.GetDataInformation(port)
    return information.GetNumberOfPoints() > 0 or information.GetNumberOfRows() > 0


def _make(create, port, text):
    """A source, run; its fault is one message, and the source goes. Of a server's sources ParaView's message window says more."""
    with messages.heard() as said:
        source = create()
        source.UpdatePipeline()
    if said.errors or not _has_data(source, port):
        simple.Delete(source)
        raise Missing(f"{text}: {said.errors[0]}" if said.errors else f"{text}; the message window may say why")
    warnings.extend(said.warnings)
    return source


def _table(scene, port, path, name, missing):
    """The table of a file, or of the scene; None where there is none and that is no fault."""
    if path:
        return _make(lambda: simple.SampleTableReader(registrationName=name, FileName=path), 0, "No samples could be read")
    if _has_data(scene, port):
        return scene[port]
    if missing:
        raise Missing(missing)
    return None


def _reference(name, scene):
    if not (_has_data(scene, 1) and _has_data(scene, 2)):
        return None
    return _make(lambda: simple.PatchReferenceImage(registrationName=f"{name}: measured patches", Input=scene[1],
                                                    PatchTable=scene[2]), 0, "The measured patches could not be placed")


def _row(name, scene, title, fit, second, reference, conditions):
    """One estimate in its colors, and its errors: (title, estimate, errors or None)."""
    transforms = {"ReflectanceTransform": fit[0]}
    if second is not None:
        transforms["MetamerismTransform"] = fit[second]
    points = scene.GetDataInformation(0).GetNumberOfPoints()
    estimate = _make(lambda: simple.ReflectanceEstimation(
        registrationName=f"{name}: {title}", Input=scene[0], **transforms,
        Uncertainty="On" if points <= _MOST_PIXELS_WITH_UNCERTAINTY else "Automatic"), 0, f"{title}: nothing was estimated")
    if not conditions.standard:
        estimate = _make(lambda: simple.SpectralToColor(
            registrationName=f"{name}: {title}, {conditions.text}", Input=estimate, **conditions.of_picture()), 0,
            f"{title}: the colors could not be computed")
    errors = None
    if reference is not None:
        errors = _make(lambda: simple.CIEDE2000Evaluator(registrationName=f"{name}: errors, {title}", Input=estimate,
                                                         Reference=reference, **conditions.of_errors()), 0,
                       f"{title}: no color difference was computed")
    return title, estimate, errors


def _show(name, rows, conditions):
    """A view for each estimate and, below it, for its errors; all turn and zoom together."""
    layout = simple.CreateLayout(name=f"{name}: result")
    columns = [0]
    if len(rows) > 1:
        left = layout.SplitHorizontal(0, 0.5)
        columns = [left, left + 1]
    views = []
    for cell, (title, estimate, errors) in zip(columns, rows):
        cells = [cell]
        if errors is not None:
            top = layout.SplitVertical(cell, 0.5)
            cells = [top, top + 1]
        views.append(_view(layout, cells[0], estimate, title[0].upper() + title[1:]))
        if errors is not None:
            view = _view(layout, cells[1], errors, captions.of(errors, f"dE00 {conditions.light}"))
            display = simple.GetDisplayProperties(errors, view)
            display.SetScalarBarVisibility(view, True)
            captions.place_legend(display.ColorArrayName[1], view)
            views.append(view)
    for other in views[1:]:
        simple.AddCameraLink(views[0], other, f"{name}: camera {other.SMProxy.GetGlobalIDAsString()}")
    simple.SetActiveView(views[0])
    simple.SetActiveSource(rows[-1][1])
    for view in views:
        simple.Render(view)
    return views


def _view(layout, cell, source, title):
    view = simple.CreateView("RenderView")
    layout.AssignView(cell, view)
    view.OrientationAxesVisibility = 0
    view.InteractionMode = "2D"
    simple.Show(source, view)
    caption = simple.Text(registrationName=title, Text=title)
    shown = simple.Show(caption, view)
    shown.WindowLocation = "Upper Center"
    shown.FontSize = 16
    simple.ResetCamera(view)
    view.CameraParallelScale *= 0.9
    bounds = source.GetDataInformation(getattr(source, "Port", 0)).GetBounds()
    beside = _BESIDE_LEGEND * (bounds[1] - bounds[0])
    view.CameraFocalPoint[0] += beside
    view.CameraPosition[0] += beside
    return view
