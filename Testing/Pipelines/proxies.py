"""Every proxy can be made, is found where a user looks for it, and File > Open knows the readers."""

import os
import pathlib
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

print("\n".join(faults) or "all proxies are there")
os._exit(1 if faults else 0)
