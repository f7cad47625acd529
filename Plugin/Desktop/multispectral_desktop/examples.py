"""Pipelines on the embedded data, to look at and to change: ./multispectral paraview EXAMPLE."""

import os

from paraview import simple

from . import main_job


def _data(*parts):
    return os.path.join(os.environ["MULTISPECTRAL_ROOT"], "Data", *parts)


def scene():
    """A scene folder: the image divided by its white reference, with labels and patches."""
    _, reader = main_job.open_scene(_data("Images", "demo-fabric"))
    view = simple.GetActiveViewOrCreate("RenderView")
    simple.Show(reader, view)
    view.InteractionMode = "2D"
    simple.ResetCamera(view)
    simple.SetActiveSource(reader)
    simple.Render(view)


def fabric():
    """The main job: dyed fabric, estimated with a paper chart alone and corrected by swatches."""
    main_job.build(_data("Images", "demo-fabric"), _data("Samples", "demo-chart.csv"), _data("Samples", "demo-fabric.csv"))


# Of the diagnosis, what a user looks for first.
_SUMMARY = ("verdict", "rms_before", "rms_after", "noise_floor", "shrink", "unknown_probability")
_CAUSES = ("title", "medium", "share", "probability", "parameter", "value", "unit", "standard_error")


def capture():
    """Why a simulated and a real camera disagree."""
    reader = simple.CaptureReader(registrationName="warm camera", FileName=_data("Captures", "demo-warm-camera",
                                                                                "capture.json"))
    gap = simple.SimToRealGap(registrationName="warm camera: gap", Camera=reader[0], Samples=reader[1],
                              Responses=reader[2])
    gap.UpdatePipeline()
    layout = simple.CreateLayout(name="warm camera: gap")
    top = layout.SplitVertical(0, 0.4)
    for cell, port, columns in ((top, 0, _SUMMARY), (top + 1, 2, _CAUSES)):
        view = simple.CreateView("SpreadSheetView")
        layout.AssignView(cell, view)
        simple.Show(simple.OutputPort(gap, port), view)
        rows = gap.GetDataInformation(port).DataInformation.GetRowDataInformation()
        names = [rows.GetArrayInformation(i).GetName() for i in range(rows.GetNumberOfArrays())]
        view.HiddenColumnLabels = ["Row ID", *(name for name in names if name not in columns)]
        simple.Render(view)
    simple.SetActiveSource(gap)


EXAMPLES = {"scene": scene, "fabric": fabric, "capture": capture}


def show(what):
    """An example by its name, or a state file by its path."""
    if what in EXAMPLES:
        EXAMPLES[what]()
    elif what:
        simple.LoadState(what)
        if simple.GetViews():  # of its views LoadState brings only images to the front
            simple.SetActiveView(simple.GetViews()[0])
