"""A cube goes from reader to error map in small blocks and gives the bytes of the whole; what is written reads back.

Argument: folder for the files.
"""

import filecmp
import glob
import os
import shutil
import sys

from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

root = os.environ["MULTISPECTRAL_ROOT"]
sys.path.insert(0, os.path.join(root, "Plugin", "Scripts"))
from support import command, pipeline  # noqa: E402

scene = os.path.join(root, "Data", "Images", "demo-fabric")
faults = []


def check(what, true):
    if not true:
        faults.append(what)


def reader(files, **options):
    return pipeline.create("SpectralImageReader", FileNames=files, **options)


def stack(**options):
    return reader(sorted(glob.glob(os.path.join(scene, "channel_*.tif"))), **options)


def write(source, path, **options):
    pipeline.save_image(source, path, **options)


def array(source, name):
    source.UpdatePipeline()
    pipeline.fail_on_error()
    data = source.SMProxy.GetClientSideObject().GetOutput()
    return vtk_to_numpy(data.GetPointData().GetArray(name)).copy()


def table(name):
    return pipeline.create("SampleTableReader", FileName=name)


def maps(folder, name, block, watch):
    """The error maps of the demo scene, computed and written in blocks; the extents that the reader was asked for."""
    extents = []
    image = stack(ScaleIntegers=1)
    if watch:
        algorithm = image.SMProxy.GetClientSideObject()
        algorithm.AddObserver("EndEvent", lambda a, _: extents.append(a.GetOutput().GetExtent()))
    fit = pipeline.create("ReflectanceCalibration", Input=table(
        os.path.join(root, "Data", "Samples", "demo-chart.csv")))
    estimate = pipeline.create("ReflectanceEstimation", Input=image, ReflectanceTransform=fit[0])
    labels = pipeline.create("LabelImageReader", FileName=os.path.join(scene, "labels.png"))
    reference = pipeline.create("PatchReferenceImage", Input=labels,
                                PatchTable=table(os.path.join(scene, "patches.csv")))
    errors = pipeline.create("CIEDE2000Evaluator", Input=estimate, Reference=reference)
    path = os.path.join(folder, name)
    write(errors, path, BlockSize=block, PointArrays=["rms", "dE00 D65", "dE00 F2"])
    return path, extents


def refused(what, work, text):
    """The work ends with an error of that text; what VTK said is then forgotten."""
    try:
        work()
        faults.append(f"{what} was written")
    except command.Failure as failure:
        check(f"{what}: {failure}", text in str(failure))
    pipeline._messages = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(pipeline._messages)


def check_streaming(folder):
    whole, _ = maps(folder, "whole.img", 65536, False)
    blocks, extents = maps(folder, "blocks.img", 1, True)
    rows = [extent[3] - extent[2] + 1 for extent in extents]
    check(f"the reader was asked {len(rows)} times for up to {max(rows)} rows",
          len(rows) >= 20 and max(rows) <= 192 // 4)
    check("blocks and whole differ", filecmp.cmp(whole, blocks, shallow=False))


def check_selection(folder):
    everything = array(stack(), "Responses").reshape(192, 256, 16)  # row 0 is the bottom row
    part = stack(Bands="2-4, 16", Region=[10, 19, 0, 49], Stride=[3, 7])
    values = array(part, "Responses").reshape(8, 4, 4)
    expected = everything[::-1][0:50:7, 10:20:3][:, :, [1, 2, 3, 15]][::-1]
    check("bands, region and stride", (values == expected).all())
    data = part.SMProxy.GetClientSideObject().GetOutput()
    check(f"place of the part {data.GetOrigin()} {data.GetSpacing()}",
          data.GetOrigin() == (10.0, 191.0 - 49.0, 0.0) and data.GetSpacing() == (3.0, 7.0, 1.0))
    visible = array(stack(WavelengthRange=[500, 600]), "Responses")
    check("range of wavelengths", (visible == everything.reshape(-1, 16)[:, 5:11]).all())


def check_names(folder):
    source = stack()
    values = array(source, "Responses")
    for name in ("a.bsq", "a.bil", "a.bip", "a.exr"):
        path = os.path.join(folder, name)
        write(source, path)
        check(f"{name} reads back as responses", (array(reader([path]), "Responses") == values).all())
        if name != "a.exr":
            with open(os.path.join(folder, "a.hdr"), encoding="ascii") as header:
                check(f"{name} says its interleave", f"interleave = {name[2:]}" in header.read())
    for name, options, error in (
            ("a.tif", {}, "has the extension '.tif', which no spectral image is written in"),
            ("a.bsq", {"Interleave": "BIP"}, "the name says another interleave than the property")):
        refused(f"{name} {options}", lambda: write(source, os.path.join(folder, name), **options), error)
    check("nothing stands where the name was refused", not os.path.exists(os.path.join(folder, "a.tif")))


def check_tables(folder):
    samples = table(os.path.join(root, "Data", "Samples", "demo-fabric.csv"))
    chart = table(os.path.join(root, "Data", "Samples", "demo-chart.csv"))
    for method in ("Direct", "Transfer"):
        fit = pipeline.create("MetamerismCorrection", Calibration=chart, Tuning=samples, Method=method)
        for port in (0, 1):
            first, second = (os.path.join(folder, f"{method}-{port}-{i}.csv") for i in (1, 2))
            pipeline.save_table(fit[port], first)
            pipeline.save_table(table(first), second)
            check(f"{method} {port} reads back", filecmp.cmp(first, second, shallow=False))
    numbered = os.path.join(folder, "numbered.csv")
    with open(numbered, "w", encoding="ascii") as file:
        file.write("sample,R400,C1,C3,C5\na,0.1,1,2,3\n")
    check("channel numbers stay", pipeline.column_names(table(numbered)) ==
          ["sample", "R400", "C1", "C3", "C5"])
    profile = pipeline.create("SpectralProfile", Input=stack(), Points=[5, 5])
    refused("a .ti3 without reflectance",
            lambda: pipeline.save_table(profile, os.path.join(folder, "none.ti3")),
            "the table has no reflectance, which CGATS is for")


def check_picture():
    view = simple.CreateView("RenderView")
    display = simple.Show(stack(), view)
    check(f"a cube opens as {display.SMProxy.GetXMLName()} colored by {list(display.ColorArrayName)}, "
          f"Map Scalars {display.MapScalars}",
          list(display.ColorArrayName) == ["POINTS", "sRGB"] and display.MapScalars == 0)


def main():
    folder = sys.argv[1]
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    pipeline.load_plugin()
    check_streaming(folder)
    check_selection(folder)
    check_names(folder)
    check_picture()
    check_tables(folder)
    print("\n".join(faults) or "streaming, parts, names, tables: as they should be")
    sys.stdout.flush()
    os._exit(1 if faults else 0)


main()
