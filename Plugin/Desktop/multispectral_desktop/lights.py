"""The light and the observer of the main job: by name, or from files, as --illuminant and --observer of the commands."""

import os

from paraview import servermanager, simple

from .messages import Missing

LIGHT, OBSERVER = "D65", "CIE 1931 2 degree"
# What the window offers; CIEDE2000 Evaluator knows more names.
LIGHTS = ("D65", "D50", "A", "F2", "F11", "LED-B3")
OBSERVERS = {OBSERVER: "2\u00b0", "CIE 1964 10 degree": "10\u00b0"}
_XYZ = 3  # curves of an observer


class Conditions:
    """Under which colors are shown and compared. make: creates a source, runs it, and tells its fault."""

    def __init__(self, name, light, observer, make):
        self.standard = (light, observer) == (LIGHT, OBSERVER)
        self._tables, lights = {}, [light]
        if _is_file(light):
            self._tables["IlluminantTable"], lights = _curves(f"{name}: light", light, make)
        self.light = lights[0]
        self._lights = ", ".join(lights)
        if _is_file(observer):
            self._tables["ObserverTable"], curves = _curves(f"{name}: observer", observer, make)
            if len(curves) != _XYZ:
                raise Missing(f"{observer}: {len(curves)} curve{'s' if len(curves) != 1 else ''} beside the wavelength; "
                              "expected three: x-bar, y-bar and z-bar; remove or add columns")
        else:
            self._tables["Observer"] = observer
        own = OBSERVERS.get(observer, os.path.splitext(os.path.basename(observer))[0])
        self.text = self.light if observer == OBSERVER else f"{self.light}, {own}"

    def of_picture(self):
        """Properties of Spectral To Color."""
        return {"Illuminant": self.light, **self._tables}

    def of_errors(self):
        """Properties of CIEDE2000 Evaluator: its own lights where nothing else is wanted."""
        return {} if self.standard else {"Illuminants": self._lights, **self._tables}


def _is_file(text):
    return os.path.exists(text) or os.sep in text


def _curves(name, path, make):
    reader = make(lambda: simple.CurveReader(registrationName=name, FileNames=[path]), 0, "No curve could be read")
    table = servermanager.Fetch(reader)
    return reader, [table.GetColumnName(i) for i in range(1, table.GetNumberOfColumns())]
