"""What a view shows at first is what the data are: pictures of the right spectra, error maps with one fixed legend."""

import os
import pathlib
import struct
import sys
import tempfile
import zlib

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, os.path.join(os.environ["MULTISPECTRAL_ROOT"], "Plugin", "Scripts"))
sys.path.insert(0, os.path.join(os.environ["MULTISPECTRAL_ROOT"], "Plugin", "Desktop"))
from multispectral_desktop import captions, messages, pixel, profile_chart  # noqa: E402
from support import pipeline  # noqa: E402

root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
images = root / "Data" / "Images" / "demo-fabric"
faults = []


def check(what, holds):
    if not holds:
        faults.append(what)


def stack(*folder):
    files = sorted(str(path) for path in images.joinpath(*folder).glob("channel_*.tif"))
    return pipeline.create("SpectralImageReader", FileNames=files)


def picture(source):
    return vtk_to_numpy(pipeline.whole(source).GetPointData().GetArray("sRGB")).astype(int)


def show(source):
    view = simple.CreateView("RenderView")
    display = simple.Show(source, view)
    simple.Render(view)
    pipeline.fail_on_error()
    return display, view


def check_colors(display, array, mapped):
    name = list(display.ColorArrayName)
    check(f"colored by {name} with MapScalars {display.MapScalars}, expected {array} with {mapped}",
          name == ["POINTS", array] and display.MapScalars == mapped)


def one_channel_and_photograph():
    """A channel alone says that there are others; a picture for the screen stays as it is."""
    channel = str(images / "channel_400nm.tif")
    whole = pipeline.create("SpectralImageReader", FileNames=[channel], WholeStack=1)
    pipeline.update(whole)
    whole.UpdatePropertyInformation()
    pattern = whole.GetProperty("StackPattern").GetData()
    check(f"the whole stack is {pattern}", pattern == "channel_*nm.tif" and
          (picture(whole) == picture(stack())).all())
    with messages.heard() as said:
        pipeline.create("SpectralImageReader", FileNames=[channel]).UpdatePipeline()
    check(f"one channel alone warns by {said.warnings}", [text.partition(": /")[0] for text in said.warnings] == [
        "this is one channel of 16 (channel_*nm.tif), shown as gray levels; set Whole Stack to read them as one image"])
    colors = np.array([[[10, 20, 30], [200, 100, 50]], [[0, 255, 128], [1, 2, 3]]], np.uint8)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "photo.png"
        rows = b"".join(b"\0" + row.tobytes() for row in colors)
        chunks = ((b"IHDR", struct.pack(">2I5B", 2, 2, 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(rows)), (b"IEND", b""))
        path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks))
        photo = pipeline.create("SpectralImageReader", FileNames=[str(path)])
        with messages.heard() as said:
            photo.UpdatePipeline()
    check(f"a photograph warns by {said.warnings}", len(said.warnings) == 1 and "ordinary color picture" in said.warnings[0])
    check("a photograph is shown in other colors", (picture(photo) == colors[::-1].reshape(-1, 3)).all())


def pixel_of_two_scenes(chart):
    """A pixel is compared with its own scene's patches, whichever scene was opened last; what is said of it follows what changes."""
    fit, place, found = pipeline.create("ReflectanceCalibration", Input=chart), (21.0, 160.0), []
    for _ in range(2):
        scene = pipeline.create("SceneReader", FileName=str(images))
        estimate = pipeline.create("ReflectanceEstimation", Input=scene[0], ReflectanceTransform=fit[0])
        patches = pipeline.create("PatchReferenceImage", Input=scene[1], PatchTable=scene[2])
        pipeline.update(estimate, patches)
        found.append((estimate, patches))
    for estimate, patches in found:
        known = pixel._companions(estimate)[1]
        check("a pixel is compared with another scene's patches", known is not None and known.SMProxy is patches.SMProxy)
        check("a pixel of a patch is not measured", pixel._of_point(estimate, 0, place).measured is not None)
    estimate, patches = found[0]
    errors = pipeline.create("CIEDE2000Evaluator", Input=estimate, Reference=patches)
    pipeline.update(errors)
    before, caption = pixel._of_point(estimate, 0, place), captions.of(errors, "dE00 D65")
    check(f"the caption is {caption}, the errors of the pixel {before.errors}", before.errors.keys() == {"dE00 D65", "dE00 F2"} and
          caption == "Errors: mean \u0394E00 3.36 (D65)")
    fit.Method = "Ridge"
    pipeline.update(estimate)
    check("errors of an earlier estimate are told of the new one", pixel.again(before).errors == {} and
          pixel.again(before).values != before.values)
    pipeline.update(errors)
    check("the caption tells of an earlier map", pixel.again(before).errors.keys() == before.errors.keys() and
          captions.of(errors, "dE00 D65") != caption and captions.of(errors, "dE00 F2").endswith(" (F2)"))
    errors.Observer = "CIE 1964 10 degree"
    pipeline.update(errors)
    check("the caption does not name the observer", captions.of(errors, "dE00 D65").endswith(" (D65, 10\u00b0)"))


def main():
    pipeline.load_plugin()
    raw = stack()
    flat = pipeline.create("FlatFieldCorrection", Input=raw, White=stack("white"), Dark=stack("dark"))
    chart = pipeline.create("SampleTableReader", FileName=str(root / "Data" / "Samples" / "demo-chart.csv"))
    fit = pipeline.create("ReflectanceCalibration", Input=chart)
    estimate = pipeline.create("ReflectanceEstimation", Input=flat, ReflectanceTransform=fit[0])
    color = pipeline.create("SpectralToColor", Input=estimate)
    pipeline.update(raw, flat, estimate, color)

    # The picture of an estimate is that of its reflectance, not that of the responses before it.
    off = np.abs(picture(estimate) - picture(color)).max()
    check(f"the estimate's picture is {off} of 255 off Spectral To Color", off <= 1)
    check("the flat field keeps the raw picture", (picture(flat) != picture(raw)).any())

    for source in (raw, flat, estimate, color):
        display, view = show(source)
        check_colors(display, "sRGB", 0)
        spectral = "Responses" if source in (raw, flat) else "Reflectance"
        simple.ColorBy(display, ("POINTS", spectral))
        simple.Render(view)
        pipeline.fail_on_error()
        check_colors(display, spectral, 1)
        colors = simple.GetColorTransferFunction(spectral)
        check(f"{spectral} is colored by its {colors.VectorMode}", colors.VectorMode == "Component")
        simple.ColorBy(display, ("POINTS", "sRGB"))
        simple.Render(view)
        pipeline.fail_on_error()
        check_colors(display, "sRGB", 0)

    labels = pipeline.create("LabelImageReader", FileName=str(images / "labels.png"))
    patches = pipeline.create("SampleTableReader", FileName=str(images / "patches.csv"))
    reference = pipeline.create("PatchReferenceImage", Input=labels, PatchTable=patches)
    errors = pipeline.create("CIEDE2000Evaluator", Input=estimate, Reference=reference)
    pipeline.update(errors)
    check("the errors carry a picture", pipeline.whole(errors).GetPointData().GetArray("sRGB") is None)
    display, view = show(errors)
    check_colors(display, "dE00 D65", 1)
    colors = simple.GetColorTransferFunction("dE00 D65")
    steps = list(colors.RGBPoints)[::4]
    check(f"the steps of the error map are {steps}", steps == [0.0, 1.0, 2.0, 3.0, 5.0])
    check(f"NaN is {list(colors.NanColor)}", len(set(colors.NanColor)) == 1)
    display.SetScalarBarVisibility(view, True)
    check("the legend has no title", "E00 D65" in simple.GetScalarBar(colors, view).Title)

    # A lamp of the user's own: its errors have the same steps.
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "lamp.csv"
        path.write_text("wavelength,power\n380,0.2\n450,0.6\n520,0.8\n600,1.0\n700,1.1\n780,1.1\n", encoding="ascii")
        lamp = pipeline.create("CurveReader", FileNames=[str(path)])
        pipeline.update(lamp)
    errors = pipeline.create("CIEDE2000Evaluator", Input=estimate, Reference=reference, IlluminantTable=lamp,
                             Illuminants="lamp", Metrics="cmc")
    pipeline.update(errors)
    display, view = show(errors)
    check_colors(display, "dECMC lamp", 1)
    steps = list(simple.GetColorTransferFunction("dECMC lamp").RGBPoints)[::4]
    check(f"the steps of the error map under a lamp are {steps}", steps == [0.0, 1.0, 2.0, 3.0, 5.0])

    # Signed: one band, centered on zero. Unsigned: viridis, which is dark at the low end.
    difference = pipeline.create("ResponseDifference", Input=flat, Simulated=raw)
    quality = pipeline.create("ReflectanceEstimation", Input=flat, ReflectanceTransform=fit[0], QualityMaps=1)
    pipeline.update(difference, quality)
    display, view = show(difference)
    check_colors(display, "Difference", 1)
    colors = simple.GetColorTransferFunction("Difference")
    points = list(colors.RGBPoints)
    check(f"the range of a signed difference is {points[0]} to {points[-4]}", points[0] == -points[-4] and points[0] < 0.0)
    check(f"a signed difference is colored by its {colors.VectorMode}", colors.VectorMode == "Component")
    display, view = show(quality)
    simple.ColorBy(display, ("POINTS", "OutOfRange"))
    colors = simple.GetColorTransferFunction("OutOfRange")
    check(f"OutOfRange begins with the color {list(colors.RGBPoints)[1:4]}", max(list(colors.RGBPoints)[1:4]) < 0.4)
    check(f"NaN of OutOfRange is {list(colors.NanColor)}", len(set(colors.NanColor)) == 1)
    wide = pipeline.create("SpectralToColor", Input=estimate, Display="Display P3")
    wide.Input.Preview = 0
    pipeline.update(wide)
    display, view = show(wide)
    check_colors(display, "Display P3", 0)
    wide.Input.Preview = 1

    same = pipeline.create("ResponseDifference", Input=flat, Simulated=flat)
    pipeline.update(same)
    show(same)
    points = list(simple.GetColorTransferFunction("Difference").RGBPoints)
    check(f"the range of no difference is {points[0]} to {points[-4]}", points[0] == -points[-4] < 0.0)

    # Slices need two directions.
    for region, wanted in (([40, 40, 20, 20], "Points"), ([40, 70, 20, 20], "Surface"), ([40, 70, 20, 50], "Slice")):
        part = stack()
        part.Region = region
        pipeline.update(part)
        display, view = show(part)
        check(f"the pixels {region} are shown as {display.Representation}", display.Representation == wanted)
        check_colors(display, "sRGB", 0)

    # What the window does with the chart of a profile.
    profile = pipeline.create("SpectralProfile", Input=estimate)
    chart_view = simple.CreateView("XYChartView")
    curves = simple.Show(profile, chart_view)
    profile_chart.adapt_views()
    shown = curves.UseIndexForXAxis, curves.XArrayName, list(curves.SeriesVisibility), chart_view.BottomAxisTitle, \
        chart_view.LeftAxisTitle
    check(f"the chart of a profile shows {shown}",
          shown == (0, "wavelength", ["region"], "Wavelength (nm)", "Reflectance factor"))

    cube = pipeline.create("SpectralCubeVolume", Input=estimate)
    pipeline.update(cube)
    display, view = show(cube)
    check(f"a cube is shown as {display.Representation}", display.Representation == "Surface")
    check_colors(display, "Reflectance", 1)
    one_channel_and_photograph()
    pixel_of_two_scenes(chart)

    # A folder without a white reference says why its colors are off.
    for folder, wanted in ((images, False), (images / "white", True)):
        scene = pipeline.create("SceneReader", FileName=str(folder))
        pipeline.update(scene)
        scene.UpdatePropertyInformation()
        notes = str(scene.GetProperty("Notes").GetData())
        check(f"the scene {folder.name} notes {notes}", notes.startswith("no white reference") == wanted)

    print("\n".join(faults) or "every first view is right")
    sys.stdout.flush()
    os._exit(1 if faults else 0)


main()
