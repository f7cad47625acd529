"""Waits for ParaView's window, then adds the panel and the toolbar, and shows MULTISPECTRAL_SHOW: an example or a state file."""

import os
import sys
import traceback

# What Python would otherwise take for unused, as nothing but Qt refers to it.
_kept = []


_told = set()


def _tell(kind, error, trace):
    """Qt for Python ends the program at an exception that nobody caught: ParaView with all that the user has in it. One of ours may
    come again at every tick of a timer, and is told once."""
    text = "".join(traceback.format_exception(kind, error, trace))
    if os.path.dirname(__file__) not in text:
        sys.__excepthook__(kind, error, trace)
    elif text not in _told:
        _told.add(text)
        print(text, file=sys.stderr)


def start():
    sys.excepthook = _tell
    try:
        from PyQt5 import QtCore, QtWidgets
    except ImportError:
        print("multispectral: note: the panel and the toolbar need the package python3-pyqt5", file=sys.stderr)
        return
    application = QtWidgets.QApplication.instance()
    timer = QtCore.QTimer()
    _kept.append((application, timer))

    def install():
        window = next((w for w in application.topLevelWidgets()
                       if isinstance(w, QtWidgets.QMainWindow) and w.isVisible()), None)
        if window is None:
            return
        timer.stop()
        try:
            from . import examples, window as desktop
            _kept.append((window, desktop.install(window)))
            examples.show(os.environ.get("MULTISPECTRAL_SHOW"))
        except Exception:
            traceback.print_exc()

    timer.timeout.connect(install)
    timer.start(200)


start()
