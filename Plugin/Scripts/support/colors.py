"""Under which light, for which observer and by which formula colors are compared: options of the commands.

The color differences are those of the registry (Filters/Kernels/Difference/ColorDifference.h); a structure test compares
them."""

import argparse
import os
import re

# Name on the command line: the metric in tables and arrays, and what people call it.
DIFFERENCES = {"ciede2000": ("dE00", "\u0394E00"), "cie94": ("dE94", "\u0394E94"),
               "cie94-textiles": ("dE94t", "\u0394E94 (textiles)"), "cmc": ("dECMC", "\u0394E CMC(2:1)"),
               "din99": ("dE99", "\u0394E99"), "cie76": ("dEab", "\u0394E*ab"), "hyab": ("dEHyAB", "\u0394E HyAB")}
OBSERVERS = {"2": "CIE 1931 2 degree", "10": "CIE 1964 10 degree"}
DEFAULT_ILLUMINANTS = ("D65", "F2")
_NAMES = re.compile(r"A|C|D50|D65|E|CWF|TL8[345]|FL?([1-9]|1[0-2])|LED-(B[1-5]|BH1|RGB1|V[12])|D\d+(\.\d+)?K?|BB\d+(\.\d+)?K",
                    re.IGNORECASE)
_ILLUMINANTS = ("A, C, D50, D65, E, F1 to F12, TL84, LED-B1 to LED-B5, LED-BH1, LED-RGB1, LED-V1, LED-V2, D55, D75, D5500K "
                "(daylight), BB3200K (blackbody), or a file with the lamp's power: wavelength in nm, then a column per lamp")


def _looks_like_file(text):
    return os.path.exists(text) or "/" in text or bool(re.search(r"\.[A-Za-z]{2,5}$", text))


def _illuminant(text):
    if not _looks_like_file(text) and not _NAMES.fullmatch(text):
        raise argparse.ArgumentTypeError(f"'{text}' is no illuminant; expected {_ILLUMINANTS}")
    return text


def _observer(text):
    if text not in OBSERVERS and not _looks_like_file(text):
        raise argparse.ArgumentTypeError(
            f"'{text}' is no observer; expected 2, 10, or a file: wavelength in nm, x-bar, y-bar, z-bar")
    return text


def add_options(parser, lights_pictures=False):
    pictures = "; the first one also lights the pictures" if lights_pictures else ""
    parser.add_argument("--illuminant", metavar="NAME", nargs="+", type=_illuminant, default=list(DEFAULT_ILLUMINANTS),
                        help=f"illuminants of the color differences{pictures}: {_ILLUMINANTS} (default: D65 F2)")
    parser.add_argument("--observer", metavar="2|10|FILE", type=_observer, default="2",
                        help="CIE standard observer, degrees, or a file with one: wavelength in nm, x-bar, y-bar, z-bar "
                             "(default: %(default)s)")
    parser.add_argument("--difference", choices=list(DIFFERENCES), default="ciede2000",
                        help="the color difference (default: %(default)s)")


def files(options):
    """The files among the options, for outputs.require_files."""
    return [text for text in (*options.illuminant, options.observer) if _looks_like_file(text)]


class Colors:
    """What the options ask for, as properties of filters. Reads the files."""

    def __init__(self, options=None):
        lamps = list(options.illuminant) if options else list(DEFAULT_ILLUMINANTS)
        observer = options.observer if options else "2"
        self.difference = options.difference if options else "ciede2000"
        self.metric, self.label = DIFFERENCES[self.difference]
        own = [text for text in lamps if _looks_like_file(text)]
        self.illuminants = []
        for text in lamps:
            self.illuminants += _curves(text)[1] if _looks_like_file(text) else [text]
        # For people: under what the first color difference is; the 2 degree observer is not named.
        self.text = self.illuminants[0] + ("" if observer == "2" else f", {observer} degree observer" if observer in OBSERVERS else
                                           f", observer {os.path.splitext(os.path.basename(observer))[0]}")
        self._tables = {}
        if own:
            from . import pipeline
            self._tables["IlluminantTable"] = pipeline.create("CurveReader", FileNames=list(dict.fromkeys(own)))
            pipeline.update(self._tables["IlluminantTable"])
        if _looks_like_file(observer):
            self._tables["ObserverTable"], curves = _curves(observer)
            if len(curves) != 3:
                from .command import Failure
                raise Failure(f"{observer}: {len(curves)} curve{'s' if len(curves) != 1 else ''} beside the wavelength; "
                              "expected three: x-bar, y-bar and z-bar; remove or add columns")
        else:
            self._tables["Observer"] = OBSERVERS[observer]

    def of_view(self):
        """Properties of Spectral To Color."""
        return {"Illuminant": self.illuminants[0], **self._tables}

    def of_errors(self):
        """Properties of CIEDE2000 Evaluator."""
        return {"Illuminants": ", ".join(self.illuminants), "Metrics": self.difference, **self._tables}

    def of_comparison(self):
        """Properties of Method Comparison."""
        return {"Illuminants": ", ".join(self.illuminants), "Difference": self.difference, **self._tables}

    def error_arrays(self):
        return ("rms", *(f"{self.metric} {illuminant}" for illuminant in self.illuminants))


def _curves(path):
    """A reader of the file, and the names of its curves."""
    from . import pipeline
    reader = pipeline.create("CurveReader", FileNames=[path])
    pipeline.update(reader)
    return reader, pipeline.column_names(reader)[1:]
