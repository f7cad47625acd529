"""Writes what ParaView's window shows into the file MULTISPECTRAL_WINDOW_STATE, five times a second."""

import json
import os

from paraview import servermanager, simple
from PyQt5 import QtCore, QtWidgets


def _middle(widget):
    place = widget.mapToGlobal(widget.rect().center())
    return [place.x(), place.y()]


# Middles of patches of the demo's image, columns and rows from the lower left.
_PATCHES = [(21.0, 160.0), (105.0, 118.0), (190.0, 75.0), (232.0, 33.0), (63.0, 75.0)]


def _places(view):
    """Where a view shows them, in pixels from its lower left."""
    renderer, places = view.GetRenderer(), []
    for x, y in _PATCHES:
        renderer.SetWorldPoint(x, y, 0.0, 1.0)
        renderer.WorldToDisplay()
        places.append(list(renderer.GetDisplayPoint()[:2]))
    return places


def _load_chart():
    """On the test's word: a synthetic chart in a view of its own."""
    word = os.path.join(os.path.dirname(os.environ["MULTISPECTRAL_WINDOW_STATE"]), "load-chart")
    if not os.path.exists(word):
        return
    with open(word, encoding="utf-8") as file:
        path = file.read()
    os.remove(word)
    scene = simple.SyntheticScene(registrationName="chart image", Subject="Chart of 24 Patches", Size=[240, 160])
    writer = servermanager.writers.SampleTableWriter(Input=servermanager.OutputPort(scene, 1), FileName=path)
    writer.UpdatePipeline()
    layout, view = simple.CreateLayout(name="chart"), simple.CreateView("RenderView")
    layout.AssignView(0, view)
    simple.Show(scene, view)
    view.InteractionMode = "2D"
    simple.ResetCamera(view)
    simple.SetActiveView(view)
    simple.SetActiveSource(scene)
    simple.Render(view)


def _told(name):
    """What the test has written for this step, once; None before."""
    word = os.path.join(os.path.dirname(os.environ["MULTISPECTRAL_WINDOW_STATE"]), name)
    if not os.path.exists(word):
        return None
    with open(word, encoding="utf-8") as file:
        content = json.load(file)
    os.remove(word)
    return content


def _show_panel():
    """On the test's word: a proxy with inputs and values, selected; nothing of it is applied."""
    told = _told("show-panel")
    if told is None:
        return
    proxy, inputs, values = told
    sources = {key: simple.FindSource(name) for key, name in inputs.items()}
    for source in sources.values():
        source.UpdatePipeline()
    made = getattr(simple, proxy)(**sources, **values)
    simple.SetActiveSource(made)


def _trigger_entry():
    """On the test's word: an entry of a menu's group Multispectral, as a click does it."""
    told = _told("trigger-entry")
    if told is None:
        return
    menu, entry, source = told
    simple.SetActiveSource(simple.FindSource(source))
    application = QtWidgets.QApplication.instance()
    main = next(w for w in application.topLevelWidgets() if isinstance(w, QtWidgets.QMainWindow) and w.isVisible())
    for title in main.menuBar().actions():
        if title.text().replace("&", "") != menu:
            continue
        title.menu().aboutToShow.emit()  # which enables the entries
        for group in title.menu().actions():
            if group.menu() is not None and group.text() == "Multispectral":
                group.menu().aboutToShow.emit()
                for action in group.menu().actions():
                    if action.text() == entry and action.isEnabled():
                        QtCore.QTimer.singleShot(0, action.trigger)


def _trigger_file():
    """On the test's word: an entry of the menu File."""
    told = _told("trigger-file")
    main = next((w for w in QtWidgets.QApplication.instance().topLevelWidgets() if isinstance(w, QtWidgets.QMainWindow)), None)
    for title in main.menuBar().actions() if told else ():
        if title.text().replace("&", "") == "File":
            QtCore.QTimer.singleShot(0, next(a for a in title.menu().actions() if _plain(a.text()) == told).trigger)


def _select():
    """On the test's word: a source, as a click in the Pipeline Browser does it."""
    told = _told("select")
    if told is not None:
        simple.SetActiveSource(simple.FindSource(told))


def _panel(main):
    """What the panel Properties asks of the selected source: name, middle of the field, and what stands in it or is offered."""
    found = {}
    for place in main.findChild(QtWidgets.QDockWidget, "propertiesDock").findChild(QtWidgets.QWidget, "PropertiesFrame").findChildren(
            QtWidgets.QWidget):
        if not place.isVisible() or not place.metaObject().className().endswith(("PropertyWidget", "pqInputSelectorWidget")):
            continue
        box, line, tree = (next(iter(place.findChildren(kind)), None)
                           for kind in (QtWidgets.QComboBox, QtWidgets.QLineEdit, QtWidgets.QTreeView))
        field = box or line or tree or place
        rows = [tree.model().index(i, 0) for i in range(tree.model().rowCount())] if tree is not None else []
        found[place.objectName()] = {
            "kind": place.metaObject().className(), "middle": _middle(field),
            "text": box.currentText() if box is not None else line.text() if line is not None else "",
            "offered": [box.itemText(i) for i in range(box.count())] if box is not None else
            [row.data() for row in rows if row.data(QtCore.Qt.CheckStateRole) == QtCore.Qt.Checked]}
    return found


def _corners(placement, frame):
    """Of the chart, on the screen."""
    if placement is None or not placement.isVisible() or placement.view is None:
        return []
    return [[int(frame[0] + x), int(frame[1] + frame[3] - y)] for x, y in map(placement.on_screen, placement.corners)]


def _shown(kind, content):
    """The names of what the views of a kind show."""
    names = {source.SMProxy.GetGlobalID(): name for (name, _), source in simple.GetSources().items()}
    return sorted({names.get(display.Input.SMProxy.GetGlobalID(), "") for view, displays in content
                   if view.SMProxy.GetXMLName() == kind for display in displays
                   if getattr(display, "Input", None) is not None and getattr(display, "Visibility", 0)})


_buttons = {}


def _button(main, name):
    """Of the panel Properties, which stays."""
    if name not in _buttons:
        _buttons[name] = main.findChild(QtWidgets.QAbstractButton, name)
    return _buttons[name]


def _plain(text):
    return text.replace("&", "").rstrip(".\u2026").strip()


def _labels(main, windows):
    """What is written on all that a user sees or opens."""
    found = {dock.windowTitle() for dock in main.findChildren(QtWidgets.QDockWidget)}
    found.update(bar.windowTitle() for bar in main.findChildren(QtWidgets.QToolBar))
    for window in windows:
        for kind in (QtWidgets.QAbstractButton, QtWidgets.QLabel):
            found.update(widget.text() for widget in window.findChildren(kind) if widget.isVisible())
    for title in main.menuBar().actions():
        found.add(title.text())
        if title.menu() is not None:
            found.update(action.text() for action in title.menu().actions())
    return sorted({_plain(text) for text in found} - {""})


_labels_of = []  # the dialogs, how often they were seen, the labels


def _labels_now_and_then(main, windows):
    """They take longer than all else together: anew where other windows are open, and every third second."""
    open_now = [id(window) for window in windows]
    if not _labels_of or _labels_of[0] != open_now or _labels_of[1] >= 15:
        _labels_of[:] = [open_now, 0, _labels(main, windows)]
    _labels_of[1] += 1
    return _labels_of[2]


def _state():
    application = QtWidgets.QApplication.instance()
    windows = [w for w in application.topLevelWidgets() if w.isVisible()]
    main = next((w for w in windows if isinstance(w, QtWidgets.QMainWindow)), None)
    # One search: Qt goes through some thousand widgets each time.
    widgets = main.findChildren(QtWidgets.QWidget) if main else []
    known = {widget.objectName(): widget for widget in widgets}
    panel = known.get("MultispectralSpectrum")
    if panel is None:
        return None
    everything = [*widgets, *(widget for window in windows if window is not main and isinstance(window, QtWidgets.QDialog)
                              for widget in window.findChildren(QtWidgets.QWidget))]
    named = {widget.objectName(): _middle(widget) for widget in everything
             if widget.objectName().startswith("Multispectral") and widget.isVisible()}
    toolbar = known["MultispectralToolbar"]
    for action in toolbar.actions():
        named[action.objectName()] = _middle(toolbar.widgetForAction(action))
    named["Help"] = _middle(_button(main, "Help"))
    if _button(main, "Accept").isEnabled():
        named["Apply"] = _middle(_button(main, "Accept"))
    # Menus: those of the bar, and the entries of the one that is open.
    entries = []
    for action in main.menuBar().actions():
        title = action.text().replace("&", "")
        if title in ("Sources", "Filters") and action.menu() is not None:
            place = main.menuBar().mapToGlobal(main.menuBar().actionGeometry(action).center())
            named[title] = [place.x(), place.y()]
            ours = next((a for a in action.menu().actions() if a.menu() is not None and a.text() == "Multispectral"), None)
            if ours is not None and action.menu().isVisible():
                place = action.menu().mapToGlobal(action.menu().actionGeometry(ours).center())
                named["Multispectral menu"] = [place.x(), place.y()]
                if ours.menu().isVisible():
                    entries = [[a.text(), a.isSeparator(), not a.icon().isNull()] for a in ours.menu().actions()]
    pages = known.get("MultispectralHelp")
    content = [(view, list(view.Representations) if hasattr(view, "Representations") else []) for view in simple.GetViews()]
    kinds = [view.SMProxy.GetXMLName() for view, _ in content]
    views = {}
    for view, displays in content:
        if view.SMProxy.GetXMLName() != "RenderView":
            continue
        texts = [d.Input.Text for d in displays if getattr(d, "Input", None) is not None and
                 d.Input.SMProxy.GetXMLName() == "TextSource"]
        arrays = [list(d.ColorArrayName) + [d.MapScalars] for d in displays
                  if hasattr(d, "MapScalars") and getattr(d, "Visibility", 0)]
        views[view.SMProxy.GetGlobalIDAsString()] = {"texts": texts, "arrays": arrays, "places": _places(view)}
    # Where the views are on the screen, as their widgets stand: the upper left first.
    frames = [w for w in widgets
              if w.metaObject().className() == "pqQVTKWidget" and w.isVisible()]
    frames = sorted([[w.mapToGlobal(QtCore.QPoint(0, 0)).x(), w.mapToGlobal(QtCore.QPoint(0, 0)).y(), w.width(), w.height()]
                     for w in frames], key=lambda f: (f[1] // 50, f[0]))
    placement = known.get("MultispectralChartDialog")
    tree = known["outputWidgetDock"].findChild(QtWidgets.QTreeView)
    return {
        "shown": _shown("RenderView", content),
        "shown in tables": _shown("SpreadSheetView", content),
        "buttons": {_plain(button.text()): _middle(button) for window in windows if isinstance(window, QtWidgets.QDialog)
                    for button in window.findChildren(QtWidgets.QAbstractButton) if button.isVisible() and button.text()},
        "remarks": _remarks(content),
        "typed": _text_with_focus(),
        "bar": main.statusBar().currentMessage(),
        "messages": [w.text() for w in windows if isinstance(w, QtWidgets.QMessageBox)],
        "output": [tree.model().index(row, 0).data() for row in range(tree.model().rowCount())],
        "width": main.width(),
        "menu": entries,
        "labels": _labels_now_and_then(main, windows),
        "first columns": [str(header.model().headerData(header.logicalIndex(0), QtCore.Qt.Horizontal)) for header in (
            table.horizontalHeader() for table in widgets if isinstance(table, QtWidgets.QTableView)
            and table.metaObject().className() == "pqSpreadSheetViewWidget" and table.isVisible()) if header.count() > 0],
        "charts": kinds.count("XYChartView"),
        "tables": kinds.count("SpreadSheetView"),
        "band": panel.band_text.text(),
        "bands": panel.band.isEnabled(),
        "panel": _panel(main),
        "corners": _corners(placement, frames[0]) if frames else [],
        "status": placement.status.text() if placement is not None else "",
        "named": named,
        "dialogs": [w.windowTitle() for w in windows if isinstance(w, QtWidgets.QDialog)],
        "help": pages.text.toPlainText()[:2000] if pages is not None and pages.isVisible() else "",
        "views": views,
        "frames": frames,
        "sources": {name: s.SMProxy.GetXMLName() for (name, _), s in simple.GetSources().items()},
        "pins": [{"name": p.name, "column": p.column, "row": p.row, "values": p.values, "errors": p.errors,
                  "count": p.count, "measured": p.measured is not None, "deviation": p.deviation is not None} for p in panel.pins],
        "live": panel.live is not None}


def _remarks(content):
    """Written over the pictures."""
    from multispectral_desktop import memory  # which the start of the window has found
    actors = [memory.of(view).get("remark actor") for view, _ in content]
    return [actor.GetInput() for actor in actors if actor is not None and actor.GetVisibility()]


def _text_with_focus():
    """Of the field that takes what is typed; None where none does."""
    field = QtWidgets.QApplication.focusWidget()
    if isinstance(field, QtWidgets.QComboBox):
        field = field.lineEdit()
    return field.text() if isinstance(field, QtWidgets.QLineEdit) else None


def _write():
    _load_chart()
    _show_panel()
    _trigger_entry()
    _select()
    _trigger_file()
    state = _state()
    if state is not None:
        path = os.environ["MULTISPECTRAL_WINDOW_STATE"]
        with open(path + ".part", "w", encoding="utf-8") as file:
            json.dump(state, file)
        os.replace(path + ".part", path)


_timer = QtCore.QTimer()
_timer.timeout.connect(_write)
_timer.start(200)
