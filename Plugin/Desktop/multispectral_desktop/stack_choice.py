"""A channel that is opened by File > Open is opened with the other channels of its image: one alone is a gray picture of no use."""

from paraview import simple

from .memory import first


def adapt(source):
    # Once: who then chooses one channel keeps it.
    if source is None or source.SMProxy.GetXMLName() != "SpectralImageReader" or not first("opened", source):
        return
    if len(source.FileNames) != 1:
        return
    source.WholeStack = 1
    source.UpdatePipelineInformation()
    source.UpdatePropertyInformation()
    pattern = source.GetProperty("StackPattern").GetData() if source.GetProperty("StackPattern") is not None else ""
    if pattern:
        simple.RenameSource(pattern, source)
    else:
        source.WholeStack = 0
