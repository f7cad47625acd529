"""RGB view, error map and a chart of reflectances of the demo scene against baselines.

Arguments: folder of baselines, folder for the pictures, a factor on the reflectance. With 1.0 every picture must
keep within its bound; with another factor, a deliberate error, every picture must leave it.

The comparison is the mean absolute difference of 8-bit values over all pixels and channels. Pixels are drawn
without interpolation or antialiasing, so the same data give the same picture; MEAN leaves room for another
font rasterizer in legends and axes and is well below what one percent of reflectance does (printed with
each comparison)."""

import glob
import os
import shutil
import sys

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

root = os.environ["MULTISPECTRAL_ROOT"]
sys.path.insert(0, os.path.join(root, "Plugin", "Scripts"))
from support import pictures, pipeline  # noqa: E402

MEAN = {"rgb.png": 0.05, "error.png": 0.15, "swatches.png": 0.02, "spectra.png": 0.02}


def read(path):
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    values = vtk_to_numpy(image.GetPointData().GetScalars())
    return image.GetDimensions(), values.reshape(len(values), -1)[:, :3].astype(float)


def differences(folder, baselines, deliberate):
    for name, bound in MEAN.items():
        baseline = os.path.join(baselines, name)
        if not os.path.isfile(baseline):
            yield f"{name}: there is no baseline {baseline}"
            continue
        size, pixels = read(os.path.join(folder, name))
        wanted_size, wanted = read(baseline)
        if size != wanted_size:
            yield f"{name}: {size} pixels, the baseline has {wanted_size}"
            continue
        mean = numpy.abs(pixels - wanted).mean()
        print(f"{name}: mean difference {mean:.4f} of 255, bound {bound}")
        if (mean > bound) != deliberate:
            yield f"{name}: mean difference {mean:.4f}, bound {bound}" + (
                "; the deliberate error was not seen" if deliberate else "")


def draw(folder, factor):
    pipeline.load_plugin()
    scene = os.path.join(root, "Data", "Images", "demo-fabric")

    def stack(*parts):
        files = sorted(glob.glob(os.path.join(scene, *parts, "channel_*.tif")))
        return pipeline.create("SpectralImageReader", FileNames=files)
    image = pipeline.create("FlatFieldCorrection", Input=stack(), White=stack("white"),
                            Dark=stack("dark"))
    chart = pipeline.create("SampleTableReader",
                            FileName=os.path.join(root, "Data", "Samples", "demo-chart.csv"))
    labels = pipeline.create("LabelImageReader", FileName=os.path.join(scene, "labels.png"))
    patches = pipeline.create("SampleTableReader", FileName=os.path.join(scene, "patches.csv"))
    fit = pipeline.create("ReflectanceCalibration", Input=chart)
    estimate = pipeline.create("ReflectanceEstimation", Input=image, ReflectanceTransform=fit[0])
    pipeline.update(estimate)
    if factor != 1.0:
        # By ParaView's own calculator.
        scaled = simple.PythonCalculator(
            Input=estimate, Expression=f"inputs[0].PointData['Reflectance'] * {factor}",
            ArrayName="Reflectance")
        simple.UpdatePipeline(proxy=scaled)
        estimate = scaled
    arrays = {"SpectralArray": "Reflectance"}
    color = pipeline.create("SpectralToColor", Input=estimate, **arrays)
    pipeline.update(color)
    pictures.image(color, "sRGB", os.path.join(folder, "rgb.png"), rgb=True)
    reference = pipeline.create("PatchReferenceImage", Input=labels, PatchTable=patches)
    errors = pipeline.create("CIEDE2000Evaluator", Input=estimate, Reference=reference,
                             EstimateArray="Reflectance")
    pipeline.update(errors)
    pictures.image(errors, "dE00 D65", os.path.join(folder, "error.png"), value_range=(0.0, 7.0))
    sampled = pipeline.create("PatchSampler", Input=estimate, SpectralArray="Reflectance",
                              Labels=labels)
    pipeline.update(sampled)
    plot = pictures.Chart("Estimated reflectance of the swatches", "Swatch", "Reflectance factor")
    plot.add(sampled, "label", {"R450": ("450 nm", (0.0, 0.45, 0.70)),
                                "R550": ("550 nm", (0.0, 0.62, 0.45)),
                                "R650": ("650 nm", (0.84, 0.37, 0.0))})
    plot.limits(left=(0.0, 1.0))
    plot.save(os.path.join(folder, "swatches.png"))

    profile = pipeline.create("SpectralProfile", Input=estimate, SpectralArray="Reflectance",
                              Labels=labels)
    pipeline.update(profile)
    spectra = pictures.Chart("Spectra of three swatches, mean and standard deviation", "Wavelength (nm)",
                             "Reflectance factor")
    series = {}
    for number, color in ((3, (0.0, 0.45, 0.70)), (10, (0.0, 0.62, 0.45)), (17, (0.84, 0.37, 0.0))):
        name = f"label {number}"
        series[name] = (name, color)
        for side in ("-s", "+s"):
            series[f"{name} {side}"] = ("", color, pictures.LineStyle.DOT, 1.0)
    spectra.add(profile, "wavelength", series)
    spectra.limits(left=(0.0, 1.0))
    spectra.save(os.path.join(folder, "spectra.png"))


def main():
    baselines, folder, factor = sys.argv[1], sys.argv[2], float(sys.argv[3])
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    draw(folder, factor)
    faults = list(differences(folder, baselines, factor != 1.0))
    print("\n".join(faults))
    sys.stdout.flush()
    os._exit(1 if faults else 0)


main()
