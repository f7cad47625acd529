"""ParaView's window, driven by mouse and keys as a user does: the main job and its faults, spectra of pixels and regions, bands, files
that are written and opened, a chart whose corners are dragged.

Arguments: a folder for screenshots and logs; nothing more, or
  server PVSERVER MPIEXEC   the main job, its fault and the spectra with a server on two ranks
  examples LAUNCHER         the commands of Documentation/Window.md that open the window, and with a state file"""

import csv
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import time

ROOT = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
SCENE = ROOT / "Data" / "Images" / "demo-fabric"
SAMPLES = ROOT / "Data" / "Samples"
WATCH = f"--script={ROOT / 'Testing' / 'Pipelines' / 'window_state.py'}"
# Seconds on a busy machine: for what the window does by itself, and for what is computed or started.
PATIENCE, WORK = 30.0, 120.0
MOST_CLICKS = 10


class Failed(Exception):
    pass


class Window:
    def __init__(self, folder):
        self.folder, self.clicks, self.faults_end = folder, 0, 0
        self.state_file, self.labels = folder / "state.json", set()
        self.processes = []
        self.environment = dict(
            os.environ, HOME=str(folder / "home"), XDG_RUNTIME_DIR=str(folder / "run"), QT_QPA_PLATFORM="xcb",
            LIBGL_ALWAYS_SOFTWARE="1", MULTISPECTRAL_WINDOW_STATE=str(self.state_file), MULTISPECTRAL_SHOW="",
            PV_PLUGIN_CONFIG_FILE=str(folder / "plugins.xml"))
        settings = folder / "home" / ".config" / "ParaView"
        settings.mkdir(parents=True)
        (folder / "run").mkdir(mode=0o700)
        (settings / "ParaView5.11.0.ini").write_text("[General]\nGeneralSettings.ShowWelcomeDialog=false\n")
        (folder / "plugins.xml").write_text(
            f'<?xml version="1.0"?>\n<Plugins>\n  <Plugin name="Multispectral" '
            f'filename="{os.environ["MULTISPECTRAL_PLUGIN"]}" auto_load="1"/>\n</Plugins>\n')

    def start(self, *command, server=()):
        """command: what opens the window, where it is not ParaView alone; server: pvserver and mpiexec."""
        told, tell = os.pipe()
        self.run(["Xvfb", "-displayfd", str(tell), "-screen", "0", "1400x900x24"], pass_fds=[tell])
        os.close(tell)
        with os.fdopen(told) as display:
            self.environment["DISPLAY"] = ":" + display.readline().strip()
        self.run(["openbox"])
        if server:
            command = "paraview", self.serve(*server), WATCH
        self.log = open(self.folder / "paraview.log", "w", encoding="utf-8")
        self.run(command or ["paraview", WATCH], stdout=self.log, stderr=subprocess.STDOUT)
        self.wait("the panel and the toolbar", lambda s: "MultispectralMainJob" in s["named"], WORK)
        self.xdotool("search", "--onlyvisible", "--name", "ParaView 5", "windowmove", "0", "0", "windowsize", "1400", "880")
        self.wait("the larger window", lambda s: s["width"] > 1300)
        self.settle()

    def run(self, command, **options):
        options = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, **options}
        self.processes.append(subprocess.Popen(command, env=self.environment, start_new_session=True, **options))

    def serve(self, pvserver, mpiexec):
        """A server on two ranks; returns how ParaView is told of it."""
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        as_root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        log = self.folder / "server.log"
        with open(log, "w", encoding="utf-8") as file:
            self.run([mpiexec, "-q", *as_root, "--oversubscribe", "-np", "2", pvserver, f"--server-port={port}"], stdout=file,
                     stderr=subprocess.STDOUT)
        end = time.monotonic() + WORK
        while "Accepting connection" not in log.read_text(encoding="utf-8"):
            if time.monotonic() > end:
                raise Failed("the server does not listen: " + log.read_text(encoding="utf-8"))
            time.sleep(0.2)
        return f"--server-url=cs://127.0.0.1:{port}"

    def watch_from_python(self):
        """For a command that runs a script of its own: Python reads this when ParaView starts it."""
        folder = self.folder / "python"
        folder.mkdir()
        (folder / "sitecustomize.py").write_text(
            "import sys\nfrom PyQt5 import QtCore, QtWidgets\n"
            "if QtWidgets.QApplication.instance() is not None:\n"
            f"    sys.path.insert(0, {str(ROOT / 'Testing' / 'Pipelines')!r})\n"
            "    QtCore.QTimer.singleShot(3000, lambda: __import__('window_watch'))\n", encoding="utf-8")
        self.environment["PYTHONPATH"] = str(folder)

    def stop(self):
        for process in reversed(self.processes):
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()

    def xdotool(self, *arguments):
        subprocess.run(["xdotool", *map(str, arguments)], env=self.environment, check=True, stdout=subprocess.DEVNULL)

    def state(self):
        try:
            state = json.loads(self.state_file.read_text(encoding="utf-8"))
            self.labels.update(state["labels"])
            return state
        except FileNotFoundError:
            return None

    def wait(self, what, holds, patience=PATIENCE):
        end = time.monotonic() + patience
        while time.monotonic() < end:
            state = self.state()
            if state is not None and holds(state):
                return state
            if self.processes[-1].poll() is not None:
                raise Failed(f"{what}: ParaView has ended")
            time.sleep(0.1)
        self.picture("failed")
        raise Failed(f"{what}: not within {patience:.0f} s; there is {json.dumps(self.state())[:1500]}")

    def settle(self):
        """Until nothing moves any more."""
        last = None
        while (now := self.state()["named"]) != last:
            last = now
            time.sleep(1.0)

    def click(self, place):
        self.xdotool("mousemove", *place)
        time.sleep(0.3)
        self.xdotool("click", 1)
        self.clicks += 1

    def drag(self, start, end):
        self.xdotool("mousemove", *start)
        time.sleep(0.3)
        self.xdotool("mousedown", 1)
        for part in (0.3, 0.7, 1.0):
            time.sleep(0.2)
            self.xdotool("mousemove", *(int(a + part * (b - a)) for a, b in zip(start, end)))
        time.sleep(0.3)
        self.xdotool("mouseup", 1)

    def type(self, text):
        """Into the field with the focus, in the place of what stands there; again where a busy window lost letters."""
        for patience in (PATIENCE / 6, PATIENCE / 3, PATIENCE):
            self.wait("a field to type into", lambda s: s["typed"] is not None)
            self.xdotool("key", "ctrl+a")
            self.xdotool("type", "--delay", "5", text)
            try:
                self.wait(f"'{text}' in the field", lambda s: s["typed"] == str(text), patience)
                return
            except Failed:
                if patience == PATIENCE:
                    raise

    def key(self, *names):
        self.xdotool("key", *names)

    def picture(self, name):
        if shutil.which("import") is None:  # of imagemagick
            return
        subprocess.run(["import", "-window", "root", str(self.folder / f"{name}.png")], env=self.environment, check=False,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def load_chart(self):
        """The synthetic chart that the watching script makes, selected and shown."""
        (self.folder / "load-chart").write_text(str(self.folder / "chart-reference.csv"), encoding="utf-8")
        return self.wait("the chart's image", lambda s: "chart image" in s["sources"] and not s["dialogs"])

    def panel(self, proxy, inputs, **values):
        """The panel of a new source that is not applied yet."""
        before = len(self.state()["sources"])
        (self.folder / "show-panel").write_text(json.dumps([proxy, inputs, values]), encoding="utf-8")
        self.wait(f"the panel of {proxy}", lambda s: len(s["sources"]) == before + 1 and s["panel"])
        return self.state()["panel"]

    def log_text(self):
        return (self.folder / "paraview.log").read_text(encoding="utf-8", errors="replace")

    def pass_over_faults(self):
        """Those so far were to be."""
        self.faults_end = len(self.log_text())

    def errors(self):
        """Of the steps that are no fault."""
        text = self.log_text()[self.faults_end:]
        return [line for line in text.splitlines() if "ERR|" in line or "Traceback" in line or "WARN|" in line]


def one_message(window):
    """A scene of raw counts is refused: one message with the numbers, and nothing half made stays."""
    folder = window.folder / "raw counts"
    folder.mkdir()
    for path in SCENE.glob("channel_*.tif"):
        shutil.copy(path, folder)
    ask_main_job(window, folder)
    said = window.wait("the message", lambda s: s["messages"], WORK)["messages"]
    if len(said) != 1 or "reach 4.1 % of the largest ones of the calibration samples" not in said[0]:
        raise Failed(f"raw counts: {said}")
    window.picture("one_message")
    window.key("Return")
    state = window.wait("the message closed", lambda s: not s["messages"])
    if state["sources"] or state["output"]:
        raise Failed(f"raw counts leave {state['sources']} and the messages {state['output']}")
    window.clicks = 0
    window.pass_over_faults()


def ask_main_job(window, scene, light=None):
    window.click(window.state()["named"]["MultispectralMainJob"])
    state = window.wait("the dialog", lambda s: "MultispectralScene" in s["named"])
    window.click(state["named"]["MultispectralScene"])
    for path in (scene, SAMPLES / "demo-chart.csv", SAMPLES / "demo-fabric.csv"):
        window.type(path)
        window.key("Tab", "Tab")
    if light is not None:
        window.type(light)
    window.click(window.state()["named"]["MultispectralRun"])


def main_job(window):
    ask_main_job(window, SCENE)
    state = window.wait("four views", lambda s: len(s["frames"]) == 4 and
                        sum(len(view["texts"]) for view in s["views"].values()) == 4 and not s["dialogs"], WORK)
    if window.clicks > MOST_CLICKS:
        raise Failed(f"the main job took {window.clicks} clicks")
    texts = sorted(text for view in state["views"].values() for text in view["texts"])
    means = [float(text.split("\u0394E00 ")[1].split()[0]) for text in texts if "\u0394E00" in text]
    if texts[:2] != ["Chart alone", "Corrected by swatches"] or len(means) != 2 or not min(means) < 0.7 * max(means):
        raise Failed(f"the captions are {texts}")
    arrays = sorted(array for view in state["views"].values() for array in view["arrays"])
    if arrays != [["POINTS", "dE00 D65", 1]] * 2 + [["POINTS", "sRGB", 0]] * 2:
        raise Failed(f"the views are colored by {arrays}")


def own_lamp(window):
    """The main job under a lamp of the user's own, read from a file."""
    lamp = window.folder / "gallery.csv"
    lamp.write_text("wavelength,power\n380,0.2\n450,0.6\n520,0.8\n600,1.0\n700,1.1\n780,1.1\n", encoding="ascii")
    before = set(window.state()["views"])
    ask_main_job(window, SCENE, lamp)
    state = window.wait("four views under the lamp", lambda s: len(s["frames"]) == 4 and not s["dialogs"] and
                        sum(len(view["texts"]) for key, view in s["views"].items() if key not in before) == 4, WORK)
    views = [view for key, view in state["views"].items() if key not in before]
    arrays = sorted(array for view in views for array in view["arrays"])
    captions = sorted(text for view in views for text in view["texts"])
    if arrays != [["POINTS", "dE00 gallery", 1]] * 2 + [["POINTS", "sRGB", 0]] * 2 or \
            sum("(gallery)" in text for text in captions) != 2:
        raise Failed(f"under the lamp the views show {arrays}, {captions}")


def spectra(window):
    window.settle()
    state = window.state()
    left, top, width, height = state["frames"][1]  # corrected, upper right
    view = next(view for view in state["views"].values() if "Corrected by swatches" in view["texts"])
    for i, (across, up) in enumerate(view["places"]):
        window.click([left + across, top + height - up])
        window.wait(f"spectrum {i + 1}", lambda s, i=i: len(s["pins"]) == i + 1)
    window.xdotool("mousemove", left + 0.4 * width, top + 0.4 * height)
    pins = window.wait("the spectrum at the cursor", lambda s: s["live"])["pins"]
    for pin in pins:
        if not pin["name"].endswith("corrected by swatches") or len(pin["values"]) != 31 or not pin["deviation"]:
            raise Failed(f"a kept spectrum is of {pin['name']} with {len(pin['values'])} bands")
    if len({(pin["column"], pin["row"]) for pin in pins}) != 5 or not all(pin["measured"] and pin["errors"] for pin in pins):
        raise Failed("five clicks did not keep five pixels, each with its measured spectrum and error: " + ", ".join(
            f"({pin['column']}, {pin['row']}) measured: {pin['measured']}" for pin in pins))


def select(window, name, property_of_panel):
    """A source; returns the middle of the field of one of its properties."""
    (window.folder / "select").write_text(json.dumps(name), encoding="utf-8")
    window.wait(f"the panel of {name}", lambda s: property_of_panel in s["panel"] and not (window.folder / "select").exists())
    window.settle()
    return window.state()["panel"][property_of_panel]["middle"]


def what_follows(window):
    """Without the correction, the kept spectra, their errors and the caption of the map are those of the chart alone."""
    before = window.state()["pins"]
    window.click(select(window, "demo-fabric: corrected, fit", "Method"))
    time.sleep(0.5)
    window.key("Home", "Return")
    window.wait("another method", lambda s: s["panel"].get("Method", {}).get("text") == "Direct" and "Apply" in s["named"])
    apply(window)
    window.wait("two equal captions", lambda s: len(texts := [
        text for view in s["views"].values() for text in view["texts"] if "mean" in text]) == 2 and len(set(texts)) == 1)
    pins = window.wait("spectra of the new image", lambda s: s["pins"] and s["pins"][0]["values"] != before[0]["values"])["pins"]
    if any(old["name"] == pin["name"] and old["errors"] and old["errors"] == pin["errors"] for old, pin in zip(before, pins)) or \
            len(pins) != len(before):
        raise Failed("errors of spectra stay when their image has changed")
    window.click(select(window, "demo-fabric: errors, chart alone", "Metrics"))
    left, top, _, _ = window.state()["frames"][2]
    window.click([left + 10, top + 10])
    window.wait("no bands of a map of errors", lambda s: not s["bands"])


def region_and_files(window):
    """The mean of a rectangle that is dragged; the kept spectra as files; a band and back to the colors."""
    state = window.state()
    left, top, _, height = state["frames"][1]
    view = next(view for view in state["views"].values() if "Corrected by swatches" in view["texts"])
    (x0, y0), (x1, y1) = view["places"][0], view["places"][1]
    window.click(state["named"]["MultispectralRegion"])
    window.drag([left + x0, top + height - y0], [left + x1, top + height - y1])
    pin = window.wait("the mean of a region", lambda s: len(s["pins"]) == 6)["pins"][-1]
    if not (pin["count"] > 100 and pin["deviation"] and len(pin["values"]) == 31):
        raise Failed(f"the region is {pin}")
    window.click(state["named"]["MultispectralRegion"])
    for name, file in (("Csv", "kept.csv"), ("Png", "kept.png")):
        window.click(window.state()["named"][f"Multispectral{name}"])
        window.wait("the dialog for a file", lambda s: s["dialogs"])
        window.type(window.folder / pathlib.Path(file).stem)  # its extension is added
        window.key("Return")
        window.wait("the dialog closed", lambda s: not s["dialogs"])
        if not (window.folder / file).is_file():
            raise Failed(f"{file} was not written")
    with open(window.folder / "kept.csv", newline="", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    if len(rows) != 6 or rows[5]["count"] != str(pin["count"]) or abs(float(rows[5]["E550"]) - pin["values"][15]) > 1e-5:
        raise Failed(f"kept.csv: {rows}")
    window.click(window.state()["named"]["MultispectralBand"])
    state = window.wait("a band", lambda s: s["band"].endswith(" nm"))
    window.picture("band")
    window.key("Home")
    window.wait("the colors", lambda s: s["band"] == "colors")


def chart(window):
    """A chart is found; a corner that is dragged moves its patches; the table is written."""
    state = window.load_chart()
    window.click(state["named"]["MultispectralFindChart"])
    state = window.wait("the dialog of the chart", lambda s: "MultispectralChartReference" in s["named"])
    field, find = (state["named"][f"MultispectralChart{name}"] for name in ("Reference", "Find"))
    # The reference of another chart: one message, and nothing of the search stays.
    window.click(field)
    window.type(SAMPLES / "demo-chart.csv")
    window.click(find)
    now = window.wait("the refusal", lambda s: s["status"].startswith("the reference lists 140 samples"), WORK)
    window.pass_over_faults()
    if now["sources"] != state["sources"] or now["output"] != state["output"] or now["corners"]:
        raise Failed(f"another chart's reference leaves {now['sources']} and the messages {now['output']}")
    window.click(field)
    window.type(window.folder / "chart-reference.csv")
    window.click(find)
    found = window.wait("the chart", lambda s: len(s["corners"]) == 4 and "24 patches" in s["status"], WORK)
    if set(found["sources"]) == set(state["sources"]):
        raise Failed("Find makes nothing that Escape could take back")
    window.key("Escape")
    window.wait("the search taken back", lambda s: not s["dialogs"] and s["sources"] == state["sources"] and pictures(s) == pictures(state))
    window.click(state["named"]["MultispectralFindChart"])
    state = window.wait("the dialog of the chart again", lambda s: "MultispectralChartFind" in s["named"])
    window.click(state["named"]["MultispectralChartFind"])
    state = window.wait("the chart again", lambda s: len(s["corners"]) == 4 and "24 patches" in s["status"], WORK)
    first = state["corners"]
    window.picture("chart")
    window.drag(first[2], [first[2][0] - 60, first[2][1] - 40])
    moved = window.wait("a corner moved", lambda s: s["corners"] and s["corners"][2] != first[2] and "spots" in s["status"])["corners"]
    if moved[:2] != first[:2] or moved[3] != first[3]:
        raise Failed(f"more than one corner moved: {first} to {moved}")
    window.drag(moved[2], first[2])
    window.wait("the corner back", lambda s: s["corners"] and s["status"].startswith("24 patches") and "spots" not in s["status"])
    window.click(window.state()["named"]["MultispectralChartSave"])
    window.wait("the dialog for a file", lambda s: any("Save" in title for title in s["dialogs"]))
    window.type(window.folder / "chart")
    window.key("Return")
    window.wait("the table", lambda s: s["status"].startswith("Saved"))
    with open(window.folder / "chart.csv", newline="", encoding="utf-8") as table:
        rows = list(csv.DictReader(table))
    if len(rows) != 24 or "R400" not in rows[0]:
        raise Failed(f"chart.csv has {len(rows)} rows and the columns {list(rows[0])[:9]}")
    window.click(window.state()["named"]["MultispectralChartClose"])
    window.wait("the dialog closed", lambda s: not s["dialogs"])


def help_page(window):
    """'?' shows the page of the selected filter, with its mathematics."""
    window.click(window.state()["named"]["Help"])
    text = window.wait("the page of the filter", lambda s: s["help"])["help"]
    if not text.startswith("Reflectance Estimation") or "Mathematics" not in text:
        raise Failed(f"'?' shows {text[:200]}")
    window.picture("help")
    window.key("Escape")
    window.wait("the page closed", lambda s: not s["help"])


def menus(window):
    """The plugin's sources and filters stand in groups, each entry with an icon."""
    for menu, first, count in (("Sources", "Synthetic Scene", 2), ("Filters", "Flat Field Correction", 24)):
        window.click(window.state()["named"][menu])
        state = window.wait(f"the menu {menu}", lambda s: "Multispectral menu" in s["named"])
        x, y = state["named"]["Multispectral menu"]
        for shift in 3 * (-40, -20, 0):  # a menu opens under a pointer that moves over it, not under one that is there at once
            window.xdotool("mousemove", x + shift, y)
            time.sleep(0.4)
            if any(separator for _, separator, _ in window.state()["menu"]):
                break
        if not any(separator for _, separator, _ in window.state()["menu"]):
            window.click([x, y])
        entries = window.wait("its entries", lambda s: any(separator for _, separator, _ in s["menu"]))["menu"]
        window.picture(f"menu {menu}")
        window.key("Escape", "Escape", "Escape")
        window.wait("the menu closed", lambda s: "Multispectral menu" not in s["named"])
        titles = [text for text, separator, _ in entries if separator]
        filters = [text for text, separator, icon in entries if not separator and icon]
        if len(titles) < 2 or "Other" in titles or filters[0] != first or len(filters) + len(titles) != len(entries) or \
                len(filters) != count:
            raise Failed(f"the menu {menu} > Multispectral has {entries}")


def pictures(state):
    """What the views of images show."""
    return sorted(str(view["arrays"]) for view in state["views"].values())


def type_into_open(window, path):
    """File > Open, up to Enter."""
    window.key("ctrl+o")
    window.wait("the dialog of File > Open", lambda s: any("Open File" in title for title in s["dialogs"]))
    window.type(path)
    window.key("Return")


def ask_file(window, path):
    """File > Open, up to the panel of the file's reader."""
    type_into_open(window, path)
    # A question that is answered by itself may be seen for a moment.
    name = re.sub(r"\d+(?=nm\.tif$)", "*", path.name)  # a channel comes with the others
    state = window.wait(f"the reader of {name}", lambda s: any(key.startswith(name) for key in s["sources"]) and not s["dialogs"])
    return next(kind for key, kind in state["sources"].items() if key.startswith(name))


def apply(window):
    window.click(window.wait("something to apply", lambda s: "Apply" in s["named"])["named"]["Apply"])
    return window.wait("applied", lambda s: "Apply" not in s["named"])


def cancelled(window):
    """Escape at each step of a dialog leaves everything as it was, without a message."""
    def things(state):
        return state["sources"], pictures(state), state["messages"], state["output"], state["pins"]

    before = things(window.state())
    rows = [f"Multispectral{row}Browse" for row in ("Scene", "Chart", "Swatches", "Light", "Observer")]
    for button, browse in (("MultispectralOpenScene", ()), ("MultispectralMainJob", rows), ("MultispectralFindChart", ())):
        window.click(window.state()["named"][button])
        state = window.wait(f"the dialog of {button}", lambda s: len(s["dialogs"]) == 1)
        for name in browse:
            window.click(state["named"][name])
            window.wait(f"the dialog of {name}", lambda s: len(s["dialogs"]) == 2)
            window.key("Escape")
            window.wait(f"{name} cancelled", lambda s: len(s["dialogs"]) == 1)
        window.key("Escape")
        window.wait(f"{button} cancelled", lambda s: not s["dialogs"])
    window.key("ctrl+s")  # File > Save Data
    window.wait("the dialog of Save Data", lambda s: s["dialogs"])
    window.type(window.folder / "kept.hdr")
    window.key("Return")
    window.wait("the options of the writer", lambda s: any("Writer" in title for title in s["dialogs"]))
    window.key("Escape")
    window.wait("Save Data cancelled", lambda s: not s["dialogs"])
    if (window.folder / "kept.hdr").exists() or things(window.state()) != before:
        raise Failed(f"cancelled dialogs leave {things(window.state())}; there was {before}")


def refused_folder(window):
    """A folder that no reader knows: ParaView's own readers of folders would end the program."""
    (window.folder / "no image" / "inside").mkdir(parents=True)
    before = window.state()["sources"]
    type_into_open(window, f"{window.folder / 'no image'}/")
    window.wait("the folder entered", lambda s: s["typed"] == "")
    window.type("inside")
    window.key("Tab")  # closes the proposals
    window.click(window.state()["buttons"]["OK"])
    time.sleep(3.0)
    if not window.state()["messages"]:  # the proposals were still there and took the click
        window.click(window.state()["buttons"]["OK"])
    said = window.wait("the refusal", lambda s: s["messages"])["messages"]
    window.picture("refused")
    window.key("Return")
    state = window.wait("the refusal closed", lambda s: not s["dialogs"])
    if len(said) != 1 or "inside: the folder holds no spectral image" not in said[0] or state["sources"] != before:
        raise Failed(f"a folder without an image: {said}, {state['sources']}")


def unknown_file(window):
    """A file that no reader knows: ParaView then loads readers of its own in Python, some of which fail. The window must not wait for
    itself when that is told."""
    before = window.state()["output"]
    path = window.folder / "unknown.kind"
    path.write_bytes(bytes(range(256)) * 20)
    type_into_open(window, path)
    window.wait("the question which reader", lambda s: any("Open Data With" in title for title in s["dialogs"]), WORK)
    window.key("Escape")
    window.wait("the question closed", lambda s: not s["dialogs"] and s["output"] == before)
    window.pass_over_faults()


def failed_filter(window):
    """A filter that fails leaves its input in view, and shows its result when it has one."""
    before = pictures(window.state())
    (window.folder / "trigger-entry").write_text(json.dumps(["Filters", "Flat Field Correction", "channel_*nm.tif"]), encoding="utf-8")
    window.wait("the filter", lambda s: "FlatFieldCorrection1" in s["sources"])
    apply(window)
    state = window.wait("the input in view", lambda s: len(s["output"]) == 1 and s["shown"] == ["channel_*nm.tif"])
    if "connect a white image" not in state["output"][0]:
        raise Failed(f"Flat Field Correction alone says {state['output']}")
    window.pass_over_faults()
    window.click(window.wait("the panel", lambda s: "White" in s["panel"])["panel"]["White"]["middle"])
    time.sleep(0.5)
    window.key("Down", "Return")
    apply(window)
    window.wait("the result in view", lambda s: s["shown"] == ["FlatFieldCorrection1"] and pictures(s) == before)


def without_input(window):
    """An input that was not chosen is one message, which names it; chosen in the panel, it brings the result."""
    def messages():
        # The images without white of the steps before may say so again.
        return [message for message in window.state()["output"] if "neither a white nor a dark image" not in message]

    ask_file(window, SAMPLES / "demo-chart.csv")
    apply(window)
    window.settle()
    before = messages()
    (window.folder / "trigger-entry").write_text(json.dumps(["Filters", "Method Comparison", "demo-chart.csv"]), encoding="utf-8")
    window.click(window.wait("the dialog for inputs", lambda s: "Change Input Dialog" in s["dialogs"] and "OK" in s["buttons"])["buttons"]["OK"])
    window.wait("the filter", lambda s: "MethodComparison1" in s["sources"] and not s["dialogs"])
    apply(window)
    window.settle()
    if (said := messages()) != [*before, "MethodComparison1: no Target is chosen; choose it in the panel Properties"]:
        raise Failed(f"without a target Method Comparison says {said}")
    across, down = window.state()["panel"]["Target"]["middle"]
    window.click([min(across, 180), down])  # long names make the panel wider than what is seen of it
    time.sleep(0.5)
    window.xdotool("type", "--delay", "20", "demo-chart")
    window.key("Return")
    apply(window)
    window.wait("the comparison", lambda s: "MethodComparison1" in s["shown in tables"] and "method" in s["first columns"], WORK)
    if len(now := messages()) != len(said) + 1 or "the target table: Twice?" not in now[-1]:  # the chart is its own target
        raise Failed(f"with a target Method Comparison says {now}")
    window.pass_over_faults()


def scene_without_white(window):
    """Raw counts are shown, and the view says whose colors those are, as long as they are shown."""
    window.click(window.state()["named"]["MultispectralOpenScene"])
    window.wait("the dialog of Open scene", lambda s: len(s["dialogs"]) == 1)
    window.type(window.folder / "raw counts")
    window.key("Return")
    window.wait("the remark", lambda s: "raw counts" in s["shown"] and len(s["remarks"]) == 1 and "no white frames" in s["remarks"][0])
    window.picture("raw counts")
    (window.folder / "trigger-entry").write_text(json.dumps(["Filters", "Flat Field Correction", "channel_*nm.tif"]), encoding="utf-8")
    window.wait("another filter", lambda s: "Apply" in s["named"])


def several_at_once(window):
    """Sources that are applied together go into the views that suit them, whichever is active."""
    for path in (SCENE / "white").glob("channel_[45]*.tif"):
        shutil.copy(path, window.folder / path.name.replace("channel", "tile"))
    for path in (window.folder / "tile_400nm.tif", SAMPLES / "demo-fabric.csv"):
        ask_file(window, path)
    apply(window)
    state = window.wait("the image and the table", lambda s: "tile_*nm.tif" in s["shown"] and "demo-fabric.csv" in s["shown in tables"] and
                        "tile_*nm.tif: 10 channels were read" in s["bar"])
    if "tile_*nm.tif" in state["shown in tables"]:
        raise Failed("an image is shown in a spreadsheet")


def open_files(window):
    """No question stays, and the right reader is taken, also where only the content tells."""
    shutil.copy(SAMPLES / "demo-fabric.csv", window.folder / "measured.csv")
    shutil.copy(ROOT / "Data" / "Captures" / "demo-warm-camera" / "camera.csv", window.folder / "curves.csv")
    for path, reader in ((window.folder / "measured.csv", "SampleTableReader"), (window.folder / "curves.csv", "CameraReader"),
                         (SCENE / "channel_400nm.tif", "SpectralImageReader"), (SCENE / "labels.png", "LabelImageReader"),
                         (SAMPLES / "demo-chart.csv", "SampleTableReader")):
        found = ask_file(window, path)
        if found != reader:
            window.picture("failed")
            raise Failed(f"File > Open took {found} for {path.name}")
        apply(window)
    # The label image lies over the channels' picture, which is hidden; curves are a chart; tables begin with what a row is.
    state = window.wait("the files", lambda s: s["charts"] == 1 and s["first columns"] and any(
        view["arrays"] == [["POINTS", "Label", 1]] for view in s["views"].values()))
    if any(len(view["arrays"]) > 1 for view in state["views"].values()) or set(state["first columns"]) != {"sample"}:
        raise Failed(f"the views of the files show {state['views']}, tables beginning with {state['first columns']}")


def panels(window):
    """What the panels offer, and what they hide because it does not apply."""
    scene, chart = "channel_*nm.tif", "demo-chart.csv"

    def shown(panel, wanted, hidden=()):
        if not set(wanted) <= set(panel) or set(hidden) & set(panel):
            raise Failed(f"the panel shows {sorted(panel)}; expected {wanted} and not {hidden}")

    shown(window.panel("MetamerismCorrection", {"Calibration": chart, "Tuning": chart}), ["Method"], ["StopOnColor", "ColorThreshold"])
    shown(window.panel("MetamerismCorrection", {"Calibration": chart, "Tuning": chart}, Method="Banded"), ["StopOnColor"],
          ["ColorThreshold"])
    shown(window.panel("MetamerismCorrection", {"Calibration": chart, "Tuning": chart}, Method="Banded", StopOnColor=1),
          ["StopOnColor", "ColorThreshold"])
    shown(window.panel("CameraSimulator", {"Input": chart, "Camera": "curves.csv"}, Noise="None"), ["Noise", "Repeats"],
          ["ReadNoise", "Seed"])
    shown(window.panel("PatchSampler", {"Input": scene}), ["Labels", "GridColumns", "Corner1"])
    shown(window.panel("PatchSampler", {"Input": scene, "Labels": "labels.png"}), ["Labels"], ["GridColumns", "Corner1"])
    channels = window.panel("ChannelSelection", {"Input": chart})["Channels"]["offered"]
    if channels != [f"{nm} nm" for nm in range(400, 720, 20)]:
        raise Failed(f"the channels that are ticked are {channels}")
    window.picture("panel of channels")

    if (kind := window.panel("CaptureReader", {})["FurtherCaptures"]["kind"]) != "pqFileListPropertyWidget":
        raise Failed(f"further captures are asked by {kind}")
    shown(window.panel("SpectralToColor", {"Input": chart}), ["Illuminant", "ObserverFile"], ["OtherIlluminant", "IlluminantFile"])
    shown(window.panel("SpectralToColor", {"Input": chart}, Illuminant="other"), ["Illuminant", "OtherIlluminant", "IlluminantFile"])
    if (box := window.panel("SpectralToColor", {"Input": chart}, Illuminant="D5300")["Illuminant"])["text"] != "D5300":
        raise Failed(f"the panel changes the illuminant D5300 to {box['text']}")
    ticked = window.panel("CIEDE2000Evaluator", {"Input": chart})["Illuminants"]["offered"]
    if sorted(ticked) != ["D65", "F2"]:
        raise Failed(f"the illuminants that are ticked are {ticked}")
    box = window.panel("SpectralToColor", {"Input": chart})["Illuminant"]
    if box["text"] != "D65" or not {"D50", "F12", "LED-V2"} <= set(box["offered"]):
        raise Failed(f"the illuminants are {box}")


def file_dialog(window, entry, path):
    (window.folder / "trigger-file").write_text(json.dumps(entry), encoding="utf-8")
    window.wait(f"the dialog of {entry}", lambda s: any(f"{entry} File" in title for title in s["dialogs"]))
    window.type(path)
    window.key("Return")


def reset(window):
    """Edit > Reset Session takes the spectra of what is deleted along; a state file brings the views back as they were."""
    def views(state):
        return sorted((str(view["arrays"]), str(view["texts"])) for view in state["views"].values())

    before = window.state()
    if not before["pins"]:
        raise Failed("there are no spectra that could stay")
    file_dialog(window, "Save State", window.folder / "all.pvsm")
    window.wait("the state file", lambda s: not s["dialogs"])
    for load in (True, False):
        window.key("ctrl+r")
        window.wait("the question", lambda s: "Delete All?" in s["dialogs"])
        window.key("Return")
        window.wait("no spectra", lambda s: not s["sources"] and not s["pins"] and not s["live"])
        if load:
            file_dialog(window, "Load State", window.folder / "all.pvsm")
            window.wait("the options", lambda s: "Load State Options" in s["dialogs"])
            window.key("Return")
            # ParaView reads keys while it reads a state; it has done when it shows a layout.
            window.wait("the state file read", lambda s: s["sources"] == before["sources"] and s["frames"], WORK)
            window.settle()
            window.settle()  # the window looks twice a second at what is new
            if views(window.state()) != views(before):
                raise Failed(f"a state file becomes {views(window.state())}, it was {views(before)}")
            window.picture("state file")


def open_channels(window):
    """Channels without a scene: the view says whose colors those are."""
    ask_file(window, SCENE / "channel_400nm.tif")
    apply(window)
    window.wait("the remark on raw channels", lambda s: len(s["remarks"]) == 1 and "as stored" in s["remarks"][0])


def page_names_what_is_there(window):
    """Every name in italics on the page about the window is written somewhere in the window."""
    page = re.sub(r"`[^`]*`", "", (ROOT / "Documentation" / "Window.md").read_text(encoding="utf-8"))
    names = {part for name in re.findall(r"(?<!\*)\*{1,2}([^*\n]+)\*{1,2}(?!\*)", page) for part in name.split(" > ")}
    missing = sorted(names - window.labels)
    if len(names) < 15 or missing:
        raise Failed(f"Documentation/Window.md names {missing} (of {len(names)}), which the window has not shown")


def shows_scene(state):
    return state["sources"] == {"demo-fabric": "SceneReader"} and \
        [view["arrays"] for view in state["views"].values()] == [[["POINTS", "sRGB", 0]]]


def shows_fabric(state):
    return len(state["frames"]) == 4 and sum(len(view["texts"]) for view in state["views"].values()) == 4


def shows_capture(state):
    return state["tables"] == 2 and "verdict" in state["first columns"] and state["sources"].get("warm camera: gap") == "SimToRealGap"


def shows_state(state):
    return state["sources"] == {"kept": "SampleTableReader"} and len(state["first columns"]) == 1


EXAMPLES = {"scene": shows_scene, "fabric": shows_fabric, "capture": shows_capture}


# Saves a state file: PLUGIN, FILE.
SAVE_STATE = f"""import sys
from paraview import simple
simple.LoadPlugin(sys.argv[1], remote=False, ns=simple.__dict__)
table = simple.SampleTableReader(registrationName="kept", FileName={str(SCENE / "patches.csv")!r})
view = simple.CreateView("SpreadSheetView")
simple.AssignViewToLayout(view)
simple.Show(table, view)
simple.Render(view)
simple.SaveState(sys.argv[2])
"""


def examples(folder, launcher):
    """Each example by its command, and a state file; the page and the launcher name all examples."""
    page = (ROOT / "Documentation" / "Window.md").read_text(encoding="utf-8")
    named = set(re.findall(r"^multispectral paraview (\w+)", page, re.MULTILINE))
    if named != set(EXAMPLES):
        return f"Documentation/Window.md names the examples {sorted(named)}, expected {sorted(EXAMPLES)}"
    (folder / "save_state.py").write_text(SAVE_STATE, encoding="utf-8")
    state_file = folder / "saved.pvsm"
    subprocess.run(["pvpython", folder / "save_state.py", os.environ["MULTISPECTRAL_PLUGIN"], state_file], check=True)
    for name, shown in {**EXAMPLES, str(state_file): shows_state}.items():
        window = Window(folder / pathlib.Path(name).stem)
        window.watch_from_python()
        try:
            window.start(launcher, "paraview", name)
            window.wait(f"{name} shown", lambda s, shown=shown: shown(s) and not s["dialogs"], WORK)
            window.picture("shown")
            if window.errors():
                return f"{name}: ParaView said: " + "\n".join(window.errors()[:10])
        except Failed as failed:
            return f"{name}: {failed}"
        finally:
            window.stop()
    return None


def run_steps(window, steps):
    """What went wrong, or None."""
    try:
        for step in steps:
            start = time.monotonic()
            step(window)
            window.picture(step.__name__)
            print(f"{step.__name__}: {time.monotonic() - start:.0f} s", flush=True)
            if window.errors():  # here, since a later step may pass over its own
                return f"{step.__name__}: ParaView said: " + "\n".join(window.errors()[:10])
        return None
    except Failed as failed:
        return "\n".join([str(failed), *window.errors()[:10]])


def in_window(folder, steps, server=()):
    window = Window(folder)
    try:
        window.start(server=server)
        return run_steps(window, steps)
    except Failed as failed:
        return str(failed)
    finally:
        window.stop()


def main():
    for tool in ("xdotool", "openbox", "Xvfb"):
        if shutil.which(tool) is None:
            print(f"skipped: there is no {tool}")
            sys.exit(77)
    folder = pathlib.Path(sys.argv[1]).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if "examples" in sys.argv[2:3]:
        fault = examples(folder, sys.argv[3])
    elif "server" in sys.argv[2:3]:
        fault = in_window(folder, (one_message, main_job, spectra), sys.argv[3:])
    else:
        fault = in_window(folder, (one_message, main_job, spectra, cancelled, region_and_files, help_page, what_follows, menus, refused_folder,
                                   open_files, several_at_once, panels, own_lamp, chart, page_names_what_is_there, reset, open_channels, failed_filter,
                                   scene_without_white, unknown_file, without_input))
    print(fault or "the window does as a user expects")
    sys.exit(1 if fault else 0)


if __name__ == "__main__":
    main()
