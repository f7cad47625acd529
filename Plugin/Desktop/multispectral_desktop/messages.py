"""What VTK says while a step of the window's own runs: told once, by that step."""

import contextlib
import re

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

# "ERROR: In file, line n\nvtkClass (0xaddress): text\n\n", likewise "Warning: ".
_MESSAGE = re.compile(r"(ERROR|Warning): In [^\n]*, line \d+\n[^\n]*? \(0x[0-9a-f]+\): (.*?)\n\n", re.DOTALL)


class Missing(Exception):
    """A step of the window's own cannot be done; the text says why and what to do."""


class Heard:
    def __init__(self):
        self.errors, self.warnings = [], []


@contextlib.contextmanager
def heard():
    """Collects errors and warnings in place of ParaView's message window. They are known at the end; those of a server are not
    heard."""
    found, window, before = Heard(), vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(window)
    try:
        yield found
    finally:
        vtkOutputWindow.SetInstance(before)
        for kind, text in _MESSAGE.findall(window.GetOutput() + "\n\n"):
            (found.errors if kind == "ERROR" else found.warnings).append(" ".join(text.split()))
