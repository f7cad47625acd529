"""Runs in ParaView's window: starts the panel as users get it, and tells the test again and again what is to be seen."""

import os
import sys

_root = os.environ["MULTISPECTRAL_ROOT"]
with open(os.path.join(_root, "Plugin", "Desktop", "start.py"), encoding="utf-8") as _file:
    exec(_file.read())
sys.path.insert(0, os.path.join(_root, "Testing", "Pipelines"))
import window_watch  # noqa: E402,F401
