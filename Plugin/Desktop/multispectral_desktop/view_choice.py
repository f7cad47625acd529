"""The active view suits the selected source: ParaView shows a result in the active view where that can show it at all, and so an image as
a table of its pixels after a table was looked at. Another table would get a view of its own each time. A new image does not go into a view
of the main job, whose caption tells of another one."""

from paraview import simple

from .menus import CATEGORY


def adapt(is_new):
    """is_new: the source was not shown yet."""
    source, active = simple.GetActiveSource(), simple.GetActiveView()
    wanted = _view_of(source) if source is not None and active is not None else None
    fits = wanted is None or active.SMProxy.GetXMLName() == wanted
    if fits and not (is_new and wanted is not None and has_caption(active)):
        return
    view = free_view(wanted, at_all=not fits)
    if view is None and is_new and has_caption(active):
        view = free_view("RenderView", at_all=False)  # which is split: the main job keeps its four views as they are
    if view is not None:
        simple.SetActiveView(view)


def free_view(kind, at_all=True):
    """A view of this kind, best one without a caption; at_all: else one with a caption. None where there is none."""
    suitable = [view for view in simple.GetViews() if view.SMProxy.GetXMLName() == kind]
    free = [view for view in suitable if not has_caption(view)]
    return next(iter(free or (suitable if at_all else [])), None)


def has_caption(view):
    inputs = [getattr(display, "Input", None) for display in view.Representations]
    return any(source is not None and source.SMProxy.GetXMLName() == "TextSource" for source in inputs)


def is_ours(source):
    hints = source.SMProxy.GetHints()
    menu = hints.FindNestedElementByName("ShowInMenu") if hints is not None else None
    return menu is not None and menu.GetAttribute("category") == CATEGORY


def _view_of(source):
    """The kind of view for a source of this plugin, also before it was applied; None for others."""
    if not is_ours(source):
        return None
    hints = source.SMProxy.GetHints()
    if hints.FindNestedElementByName("Representation") is not None and _takes_image(source):
        return "RenderView"
    view = hints.FindNestedElementByName("View")
    return "SpreadSheetView" if view is None or view.GetAttribute("type") != "XYChartView" else None


def _takes_image(source):
    first = getattr(source, "Input", None)
    return first is None or first.GetDataInformation(first.Port).GetDataSetTypeAsString() == "vtkImageData"
