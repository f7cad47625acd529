"""A channel that is opened by File > Open is opened with the other channels of its image: one alone is a gray picture of no use."""

from paraview import simple

_seen = set()  # global ids of readers: who then chooses one channel keeps it


def adapt(source):
    if source is None or source.SMProxy.GetXMLName() != "SpectralImageReader" or source.SMProxy.GetGlobalID() in _seen:
        return
    _seen.add(source.SMProxy.GetGlobalID())
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
