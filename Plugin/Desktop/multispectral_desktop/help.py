"""The page of a filter behind the button '?' of the Properties panel: Documentation/Filters, shown by Qt."""

import os

from PyQt5 import QtCore, QtWidgets
from paraview import simple


def folder():
    """Of the pages: in a clone, or where the package puts them."""
    root = os.environ["MULTISPECTRAL_ROOT"]
    places = (os.path.join(root, "Documentation"),
              os.path.join(os.path.dirname(os.path.normpath(root)), "doc", "multispectral"))
    return next((os.path.join(place, "Filters") for place in places if os.path.isdir(os.path.join(place, "Filters"))), None)


def page_of(source):
    """The page of a source of this plugin, or None."""
    place = folder()
    path = os.path.join(place, f"{source.SMProxy.GetXMLName()}.md") if place and source is not None else ""
    return path if os.path.isfile(path) else None


class HelpButton(QtCore.QObject):
    """Takes the clicks of ParaView's button where the selected source has a page; all others are ParaView's."""

    def __init__(self, window, button):
        super().__init__(window)
        self._window, self.viewer = window, None
        button.installEventFilter(self)

    def eventFilter(self, _button, event):
        if event.type() == QtCore.QEvent.MouseButtonRelease:
            page = page_of(simple.GetActiveSource())
            if page is not None:
                _button.setDown(False)
                self.show(page)
                return True
        return False

    def show(self, page):
        if self.viewer is None:
            self.viewer = Pages(self._window)
        self.viewer.open(page)


class Pages(QtWidgets.QDialog):
    def __init__(self, window):
        super().__init__(window)
        self.setObjectName("MultispectralHelp")
        self.resize(900, 700)
        self.text = QtWidgets.QTextBrowser()
        self.text.setOpenLinks(False)
        self.text.anchorClicked.connect(self._follow)
        layout = QtWidgets.QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.text)
        self._page = None

    def open(self, page):
        with open(page, encoding="utf-8") as file:
            self.text.document().setBaseUrl(QtCore.QUrl.fromLocalFile(page))
            self.text.setMarkdown(file.read())
        self._page = page
        self.setWindowTitle(os.path.splitext(os.path.basename(page))[0])
        self.text.verticalScrollBar().setValue(0)
        self.show()
        self.raise_()

    def _follow(self, link):
        path = os.path.normpath(os.path.join(os.path.dirname(self._page), link.path()))
        if not link.scheme() and path.endswith(".md") and os.path.isfile(path):
            self.open(path)


def install(window):
    """Returns what must be kept, or None where ParaView has no such button."""
    button = window.findChild(QtWidgets.QAbstractButton, "Help")
    return HelpButton(window, button) if button is not None else None
