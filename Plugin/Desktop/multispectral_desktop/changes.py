"""Whether the data of the pipeline have changed: what is written beside a picture must not tell of an earlier one."""

from paraview import simple


class Changes:
    def __init__(self):
        self._watched, self._changed = {}, False

    def any(self):
        """Since it was asked last."""
        sources = {source.SMProxy.GetGlobalID(): source.SMProxy for source in simple.GetSources().values()}
        for number, proxy in sources.items():
            # A source that was deleted and brought back by Undo has the same number.
            if self._watched.get(number) is not proxy:
                proxy.AddObserver("UpdateDataEvent", self._tell)
                self._changed = True
        self._watched = sources  # no others, which would keep deleted sources and their data alive
        changed, self._changed = self._changed, False
        return changed

    def _tell(self, *_):
        self._changed = True
