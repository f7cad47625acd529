"""The package multispectral in a plain Python, beside vtkmodules and without ParaView: reads a sample table, runs filters.

Arguments: the folder of the package, a folder for files."""

import csv
import os
import pathlib
import sys

sys.path.insert(0, sys.argv[1])
import multispectral  # noqa: E402
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow  # noqa: E402

root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
faults = []


def expect(holds, text):
    if not holds:
        faults.append(text)


def column(table, name):
    values = table.GetColumnByName(name)
    return [values.GetValue(row) for row in range(table.GetNumberOfRows())]


def main():
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)

    chart = root / "Data" / "Samples" / "demo-chart.csv"
    reader = multispectral.vtkSampleTableReader()
    reader.SetFileName(str(chart))
    reader.Update()
    with open(chart, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    expect(column(reader.GetOutput(), "R550") == [float(row["R550"]) for row in rows], "R550 is not the file's")

    # The perfect diffuser is L* = 100, a* = b* = 0 under every light.
    white = folder / "white.csv"
    bands = [f"R{nm}" for nm in range(400, 701, 10)]
    white.write_text(",".join(["sample", *bands]) + "\n" + ",".join(["W", *["1"] * len(bands)]) + "\n", encoding="ascii")
    samples = multispectral.vtkSampleTableReader()
    samples.SetFileName(str(white))
    color = multispectral.vtkSpectralToColor()
    color.SetInputConnection(samples.GetOutputPort())
    color.SetIlluminant("A")
    color.Update()
    found = [column(color.GetOutputDataObject(0), f"R_{name}")[0] for name in ("L", "a", "b")]
    expect(max(abs(x - y) for x, y in zip(found, (100.0, 0.0, 0.0))) < 1e-9, f"perfect white has L*a*b* {found}")

    # Errors are VTK's.
    said = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(said)
    reader.SetFileName(str(folder / "none.csv"))
    reader.Update()
    expect("none.csv" in said.GetOutput(), f"a missing file gives: {said.GetOutput()}")

    loaded = pathlib.Path("/proc/self/maps")
    if loaded.exists():
        expect("Remoting" not in loaded.read_text(), "ParaView is loaded")
    image = multispectral.vtkSpectralImageReader()
    for path in sorted((root / "Data" / "Images" / "demo-fabric").glob("channel_*.tif")):
        image.AddFileName(str(path))
    image.Update()
    components = image.GetOutput().GetPointData().GetArray(0).GetNumberOfComponents()
    expect(components == 16, f"the image has {components} channels")
    print("\n".join(faults) or "as expected")
    sys.exit(1 if faults else 0)


main()
