"""Proxies of the plugin in a batch program: loading, errors as one line, progress, tables to Python."""

import os
import re
import sys

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow

from . import outputs, painter
from .command import Failure, in_paraview, printable, rank

if in_paraview():
    from paraview import servermanager, simple
else:
    from .plain import servermanager, simple

# What VTK has to say: "ERROR: In file, line n\nvtkClass (0xaddress): text\n\n", likewise "Warning: ".
_messages = vtkStringOutputWindow()
_MESSAGE = re.compile(r"(ERROR|Warning): In [^\n]*, line \d+\n[^\n]*? \(0x[0-9a-f]+\): (.*?)\n\n", re.DOTALL)
_noted = set()
_tables = []  # readers, which may have notes on what they recognized
warnings = []  # of the filters, for the report


def load_plugin():
    """Also takes over VTK's messages: an error ends the work as one line, a warning becomes a note."""
    painter.start()
    # ParaView sends Python's output through VTK's window too; ours goes straight to the terminal.
    sys.stdout = open(1, "w", closefd=False, errors="backslashreplace")
    sys.stderr = open(2, "w", closefd=False, errors="backslashreplace")
    vtkOutputWindow.SetInstance(_messages)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    if in_paraview():
        simple.LoadPlugin(os.environ["MULTISPECTRAL_PLUGIN"], remote=False, ns=simple.__dict__)
        simple._DisableFirstRenderCameraReset()
    fail_on_error()


def fail_on_error():
    """The first error ends the work; warnings are told once."""
    for kind, text in _MESSAGE.findall(_messages.GetOutput() + "\n\n"):
        line = " ".join(text.split())
        if kind == "ERROR":
            raise Failure(line)
        _tell(line)
        if kind == "Warning" and line not in warnings:
            warnings.append(line)


def forget_messages():
    """After a failure that was dealt with: another pipeline starts without its errors."""
    global _messages
    _messages = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(_messages)


def create(name, **properties):
    """A proxy of the plugin by its name without spaces, watched for progress."""
    proxy = getattr(simple, name)(registrationName=name, **properties)
    fail_on_error()
    watch(proxy)
    if name == "SampleTableReader":
        _tables.append(proxy)
    return proxy


def watch(proxy):
    algorithm = proxy.SMProxy.GetClientSideObject()
    if sys.stderr.isatty():
        label = proxy.SMProxy.GetXMLLabel()
        algorithm.AddObserver("ProgressEvent", lambda a, _: _show_progress(
            label, a.GetProgress(), a.GetProgressText()))
        algorithm.AddObserver("EndEvent", lambda *_: _show_progress(None, 1.0))


def _show_progress(label, share, doing=None):
    if rank() == 0:
        text = f"\r\033[K{label} {100 * share:3.0f} %" + (f", {doing}" if doing else "")
        print(text if label else "\r\033[K", end="", file=sys.stderr, flush=True)


def update(*proxies):
    """Runs the pipeline up to these proxies; the first error ends the work."""
    for proxy in proxies:
        proxy.UpdatePipeline()
        fail_on_error()


def tell_notes(*readers):
    """What readers recognized; all that read tables, once the work is done and an error would have been the only line."""
    for reader in readers or _tables:
        reader.UpdatePropertyInformation()
        for note in filter(None, str(reader.GetProperty("Notes").GetData() or "").split("\n")):
            _tell(note)


def _tell(note):
    """Once."""
    if note not in _noted and rank() == 0:
        print(f"multispectral: note: {printable(note)}", file=sys.stderr, flush=True)
    _noted.add(note)


def port(proxy, index):
    return proxy[index]


def fetch(source):
    """The data of a source on rank 0, elsewhere None or empty."""
    return servermanager.Fetch(source, idx=getattr(source, "Port", 0))


def table(source):
    """A table as a list of columns' names and a list of rows; on rank 0, elsewhere empty."""
    data = fetch(source)
    if data is None or not data.IsA("vtkTable"):
        return [], []
    names = [data.GetColumnName(i) for i in range(data.GetNumberOfColumns())]
    rows = [[_value(data.GetColumn(i), row) for i in range(len(names))]
            for row in range(data.GetNumberOfRows())]
    return names, rows


def share(numbers, count):
    """Rank 0's numbers, on every rank."""
    from vtkmodules.vtkCommonCore import vtkDoubleArray
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    values = vtkDoubleArray()
    values.SetNumberOfValues(count)
    for i, number in enumerate(numbers):
        values.SetValue(i, number)
    controller = vtkMultiProcessController.GetGlobalController()
    if controller and controller.GetNumberOfProcesses() > 1:
        controller.Broadcast(values, 0)
    return [values.GetValue(i) for i in range(count)]


def whole(source):
    """A small table in full, as a vtkTable on every rank."""
    algorithm = source.SMProxy.GetClientSideObject()
    algorithm.UpdatePiece(0, 1, 0)
    fail_on_error()
    return algorithm.GetOutputDataObject(getattr(source, "Port", 0))


def column_names(source):
    data = whole(source)
    return [data.GetColumnName(i) for i in range(data.GetNumberOfColumns())]


def number_of_rows(source):
    return whole(source).GetNumberOfRows()


def _value(column, row):
    return column.GetValue(row)


def save_table(source, path):
    """Writes CSV through the plugin's writer: complete or absent."""
    save("SampleTableWriter", source, path)


def save_image(source, path, **properties):
    """Writes a spectral image through the plugin's writer, block by block: complete or absent."""
    save("SpectralImageWriter", source, path, **properties)


def save_png(source, array, path):
    """Writes one array of bytes or 16 bit numbers at the image's own size."""
    from vtkmodules.vtkIOImage import vtkPNGWriter
    image = whole(source)
    if rank() != 0:
        return
    shown = image.NewInstance()
    shown.ShallowCopy(image)
    shown.GetPointData().SetActiveScalars(array)
    writer = vtkPNGWriter()
    writer.SetInputData(shown)
    with outputs.written(path, outputs.END_OF_PNG) as part:
        writer.SetFileName(part)
        writer.Write()
        fail_on_error()


def save_camera(source, path):
    """Writes a camera's description and curves through the plugin's writer."""
    save("CameraWriter", source, path)


def save(name, source, path, **properties):
    """Writes through the named writer of the plugin."""
    writer = getattr(servermanager.writers, name)(Input=source, FileName=outputs.check(path), **properties)
    watch(writer)
    writer.UpdatePipeline()
    fail_on_error()
