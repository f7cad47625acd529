"""What was done for each source, display, view and widget: the one memory of the modules that do a thing once, so that it stays as the
user changes it."""

_records = {}


def key(proxy):
    return proxy.SMProxy.GetGlobalID()


def of(thing, port=0):
    """The record of a proxy, or of one of its ports, or of a widget: a dictionary that starts empty."""
    return _records.setdefault((key(thing) if hasattr(thing, "SMProxy") else thing, port), {})


def first(what, thing, port=0):
    """Whether it is the first time."""
    record = of(thing, port)
    known, record[what] = what in record, True
    return not known


def forget():
    """All of it: the numbers of proxies are those of others now."""
    _records.clear()
