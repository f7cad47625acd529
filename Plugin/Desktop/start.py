"""The Multispectral panel and toolbar of ParaView's window; ParaView runs this file at its start (paraview --script=FILE).

A plugin could bring them by itself, but the ParaView 5.11 of Debian 12 loads no plugin that is written in Python. What stays
is imported: ParaView forgets the names of this file when it has run it."""

import os
import sys

_desktop = os.path.join(os.environ["MULTISPECTRAL_ROOT"], "Plugin", "Desktop")
if _desktop not in sys.path:
    sys.path.insert(0, _desktop)
import multispectral_desktop.start  # noqa: E402,F401
