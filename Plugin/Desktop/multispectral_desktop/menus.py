"""The plugin's entries of the menus Sources and Filters, in groups with a title and an icon each.

ParaView makes one list of them, and makes it anew whenever a plugin is loaded: it is put in order when it is opened."""

import os

from PyQt5 import QtCore, QtGui, QtWidgets

CATEGORY = "Multispectral"
# Title, icon, proxies.
GROUPS = (
    ("Images", "scene", ("SceneReader", "SpectralImageReader", "LabelImageReader", "SyntheticScene")),
    ("Tables", "table", ("SampleTableReader", "CurveReader")),
    ("Cameras", "camera", ("CameraReader", "CaptureReader")),
    ("Prepare", "chart", ("FlatFieldCorrection", "ChannelDisplacement", "ChannelRegistration", "ChannelSelection", "ChartFinder", "PatchSampler")),
    ("Samples", "table", ("SampleSplit", "SampleChoice", "SampleCheck")),
    ("Estimate", "estimate", ("ReflectanceCalibration", "MetamerismCorrection", "ReflectanceEstimation", "MethodComparison")),
    ("Judge", "compare", ("PatchReferenceImage", "CIEDE2000Evaluator", "ErrorSummary")),
    ("Look", "see", ("SpectralToColor", "SpectralProfile", "SpectralCubeVolume")),
    ("Simulate and diagnose", "camera", ("CameraModelFit", "CameraSimulator", "ResponseDifference", "SimToRealGap",
                                         "ImageSimToRealGap")))


def icon(name):
    return QtGui.QIcon(os.path.join(os.path.dirname(__file__), "icons", f"{name}.svg"))


class Order(QtCore.QObject):
    def __init__(self, window):
        super().__init__(window)
        self._menus = []  # Python would forget them, and with them what was connected
        for action in window.menuBar().actions():
            if action.menu() is not None and action.text().replace("&", "") in ("Sources", "Filters"):
                self._watch(action.menu(), self._arrange)

    def _watch(self, menu, act):
        self._menus.append(menu)
        menu.aboutToShow.connect(lambda: act(menu))

    def _arrange(self, menu):
        for action in menu.actions():
            group = action.menu()
            if group is not None and action.text().replace("&", "") == CATEGORY:
                arrange(group)
                if not group.property("multispectral"):
                    group.setProperty("multispectral", True)
                    self._watch(group, arrange)


def arrange(menu):
    """Titles over the entries. An entry that no group names comes last."""
    entries = {action.data()[1]: action for action in menu.actions()
               if isinstance(action.data(), (list, tuple)) and len(action.data()) == 2}
    if not entries or any(action.isSeparator() for action in menu.actions()):
        return
    for action in entries.values():
        menu.removeAction(action)
    named = [name for _, _, names in GROUPS for name in names]
    for title, picture, names in (*GROUPS, ("Other", "table", [name for name in entries if name not in named])):
        group = [entries[name] for name in names if name in entries]
        if group:
            menu.addSection(title)
        for action in group:
            action.setIcon(icon(picture))
            action.setIconVisibleInMenu(True)
            menu.addAction(action)
