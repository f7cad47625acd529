"""Every proxy can be made, is found where a user looks for it, and File > Open knows the readers."""

import os
import pathlib
import struct
import sys

from paraview import servermanager, simple

simple.LoadPlugin(os.environ["MULTISPECTRAL_PLUGIN"], remote=False, ns=simple.__dict__)
root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
manager = servermanager.ProxyManager()
faults = []

for path in sorted((root / "Plugin" / "Proxies").glob("*.xml")):
    name = path.stem
    group = next(g for g in ("sources", "filters", "writers") if manager.GetPrototypeProxy(g, name))
    prototype = manager.GetPrototypeProxy(group, name)
    if group == "writers":
        continue
    proxy = getattr(simple, name)()
    if proxy.SMProxy.GetClientSideObject() is None:
        faults.append(f"{name}: no object behind the proxy")
    hints = prototype.GetHints()
    shown = hints.FindNestedElementByName("ShowInMenu") if hints else None
    if shown is None or shown.GetAttribute("category") != "Multispectral":
        faults.append(f"{name}: not in the menu category Multispectral")

factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
session = servermanager.ActiveConnection.Session
wanted = {
    "SceneReader": root / "Data" / "Images" / "demo-fabric",
    "CaptureReader": root / "Data" / "Captures" / "demo-warm-camera" / "capture.json",
    "CameraReader": root / "Data" / "Captures" / "demo-warm-camera" / "camera.csv",
    "SampleTableReader": root / "Data" / "Samples" / "demo-chart.csv",
    "SpectralImageReader": root / "Data" / "Images" / "demo-fabric" / "channel_400nm.tif",
    "LabelImageReader": root / "Data" / "Images" / "demo-fabric" / "labels.png",
}
for reader, path in wanted.items():
    found = factory.GetReaders(str(path), session)
    names = [found.GetString(i) for i in range(found.GetNumberOfStrings())]
    if reader not in names:
        faults.append(f"File > Open offers {names} for {path.name}, not {reader}")
    # Of this plugin's readers one takes the file; ParaView's own may take it too.
    others = {name for name in names if (root / "Plugin" / "Proxies" / f"{name}.xml").is_file()} - {reader}
    if others:
        faults.append(f"File > Open offers {others} too for {path.name}")

# What the panels offer is what the filters take.
chart = simple.SampleTableReader(FileName=str(wanted["SampleTableReader"]))
image = simple.SpectralImageReader(FileNames=[str(wanted["SpectralImageReader"])])
lamps = pathlib.Path(sys.argv[1]) / "proxies-lamps.csv"
lamps.parent.mkdir(parents=True, exist_ok=True)
lamps.write_text("wavelength,gallery,shop\n380,0.2,1\n780,1.1,1\n", encoding="ascii")
curves = simple.CurveReader(FileNames=[str(lamps)])
for source in (chart, image, curves):
    source.UpdatePipeline()


def strings(proxy, name, domain):
    found = proxy.SMProxy.GetProperty(name).GetDomain(domain)
    return [found.GetString(i) for i in range(found.GetNumberOfStrings())]


def rows(source):
    source.UpdatePipeline()
    return source.GetDataInformation(0).GetNumberOfRows()


color = simple.SpectralToColor(Input=chart)
illuminants = strings(color, "Illuminant", "illuminants")
if len(illuminants) < 20 or color.Illuminant != "D65":
    faults.append(f"Spectral To Color offers {illuminants} and starts with {color.Illuminant}")
own = strings(simple.SpectralToColor(Input=chart, IlluminantTable=curves), "Illuminant", "illuminants")
if own != ["gallery", "shop", *illuminants]:
    faults.append(f"with a table of one's own Spectral To Color offers {own}")
for name in own:
    if rows(simple.SpectralToColor(Input=chart, IlluminantTable=curves, Illuminant=name, OtherIlluminant="D5300K")) == 0:
        faults.append(f"Spectral To Color does not take {name}")


def color_of_first(**properties):
    source = simple.SpectralToColor(Input=chart, **properties)
    source.UpdatePipeline()
    table = servermanager.Fetch(source)
    return [table.GetColumnByName(f"R_{name}").GetValue(0) for name in "XYZ"] if table.GetNumberOfRows() else []


# A file as a property is the same as the same file through Curve Reader.
lamp, observer, estimates = (os.path.join(sys.argv[1], name) for name in ("gallery lamp.csv", "eye.csv", "estimates.csv"))
with open(lamp, "w", encoding="ascii") as file:
    file.write("wavelength,power\n380,0.2\n450,0.6\n520,0.8\n600,1.0\n700,1.1\n780,1.1\n")
with open(observer, "w", encoding="ascii") as file:
    file.write("wavelength,x,y,z\n" + "".join(f"{nm},{1 + nm / 1000},1,{2 - nm / 1000}\n" for nm in range(380, 781, 5)))
tables = {"IlluminantTable": simple.CurveReader(FileNames=[lamp]), "ObserverTable": simple.CurveReader(FileNames=[observer])}
by_file = color_of_first(Illuminant="other", IlluminantFile=lamp, ObserverFile=observer)
if not by_file or by_file != color_of_first(Illuminant="gallery-lamp", **tables) or by_file == color_of_first():
    faults.append(f"Spectral To Color under the file of a lamp: {by_file}")
with open(estimates, "w", encoding="ascii") as file:
    known = range(400, 701, 10)
    file.write(",".join(["sample", *(f"R{nm}" for nm in known), *(f"E{nm}" for nm in known)]) + "\n")
    file.write(",".join(["1", *("0.5" for _ in known), *(f"{0.5 + (nm - 550) / 3000:.4f}" for nm in known)]) + "\n")
judged = simple.CIEDE2000Evaluator(Input=simple.SampleTableReader(FileName=estimates), IlluminantFile=lamp, ObserverFile=observer)
judged.UpdatePipeline()
table = servermanager.Fetch(judged)
names = [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())]
if [name for name in names if name.startswith("dE00")] != ["dE00 D65", "dE00 F2", "dE00 gallery-lamp"]:
    faults.append(f"CIEDE2000 Evaluator with the file of a lamp gives {names}")
typed = simple.SpectralToColor(Input=chart, Illuminant="D5300")
if "D5300" not in strings(typed, "Illuminant", "illuminants"):
    faults.append("a list without the typed D5300 would change it")
# The variables of a MAT file (level 4) are offered, also where the file cannot be opened before one is chosen.
mat = os.path.join(sys.argv[1], "two.mat")
with open(mat, "wb") as file:
    for name, height in ((b"first", 3), (b"second", 5)):
        file.write(struct.pack("<5i", 0, height, 4, 0, len(name) + 1) + name + b"\0" + struct.pack(f"<{4 * height}d", *range(4 * height)))
reader, said = simple.SpectralImageReader(), []
reader.SMProxy.GetClientSideObject().AddObserver("ErrorEvent", lambda *_: said.append("an error"))
reader.FileNames = [mat]
reader.UpdatePipelineInformation()
reader.UpdatePropertyInformation()
if said:
    faults.append("the reader complains of several variables before one can be chosen")
reader.UpdatePipeline()
if not said:
    faults.append("the reader reads one of several variables without a choice")
if strings(reader, "Variable", "names") != ["", "first", "second"] or reader.Variable != "":
    faults.append(f"the reader offers the variables {strings(reader, 'Variable', 'names')} and starts with {reader.Variable}")
found = factory.GetReaders(mat, session)
if "SpectralImageReader" not in [found.GetString(i) for i in range(found.GetNumberOfStrings())]:
    faults.append("File > Open does not take a MAT file of which a variable is to be chosen")
reader.Variable = "second"
reader.UpdatePipeline()
if reader.GetDataInformation(0).GetNumberOfPoints() != 20:
    faults.append("the reader does not read the variable that is chosen")
errors = simple.CIEDE2000Evaluator(Input=chart)
metrics, lights = (strings(errors, name, "names") for name in ("Metrics", "Illuminants"))
if list(errors.Metrics) != ["ciede2000"] or list(errors.Illuminants) != ["D65", "F2"] or \
        not {"cmc", "sam", "metamerism"} <= set(metrics) or not {"D65", "F2", "LED-V2"} <= set(lights):
    faults.append(f"CIEDE2000 Evaluator starts with {errors.Metrics}, {errors.Illuminants} and offers {metrics}, {lights}")
methods = strings(simple.MethodComparison(Calibration=chart, Target=chart), "Methods", "names")
if not {"direct", "transfer", "wiener"} <= set(methods):
    faults.append(f"Method Comparison offers {methods}")
fit = simple.ReflectanceCalibration(Input=chart)
channels = simple.ChannelSelection(Input=chart)
if list(channels.Channels) != [f"{nm} nm" for nm in range(400, 720, 20)]:
    faults.append(f"Channel Selection starts with {channels.Channels}")
# A state file of Python sets them before anything is read.
channels = simple.ChannelSelection(Input=simple.SampleTableReader(FileName=chart.FileName))
channels.Channels = ["400 nm", "700 nm"]
channels.UpdatePipeline()
table = servermanager.Fetch(channels)
kept = [table.GetColumnName(i) for i in range(table.GetNumberOfColumns()) if table.GetColumnName(i).startswith("C")]
if kept != ["C400", "C700"]:
    faults.append(f"Channel Selection keeps {kept}")
arrays = strings(simple.ReflectanceEstimation(Input=image, ReflectanceTransform=fit), "ResponseArray", "arrays")
if "" not in arrays or "Responses" not in arrays:
    faults.append(f"Reflectance Estimation offers the arrays {arrays}")

print("\n".join(faults) or "all proxies are there")
os._exit(1 if faults else 0)
