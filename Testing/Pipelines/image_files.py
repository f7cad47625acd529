"""Images on their way through files: what a header says survives, what SaveData writes reads back, the first picture
of a cube has the colors of the spectra.

Argument: folder for the files. Colors are computed here with NumPy from the CIE's tables.
"""

import csv
import os
import shutil
import sys

import numpy as np
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

root = os.environ["MULTISPECTRAL_ROOT"]
sys.path.insert(0, os.path.join(root, "Plugin", "Scripts"))
from support import pipeline  # noqa: E402

faults = []
WIDTH, HEIGHT = 6, 5


def check(what, true):
    if not true:
        faults.append(what)


def curves(name):
    """The columns of a table of the CIE at 1 nm from 360 to 830 nm."""
    with open(os.path.join(root, "Data", "Tables", name), newline="", encoding="utf-8") as file:
        rows = [row for row in csv.reader(line for line in file if not line.startswith("#"))]
    numbers = np.array([[float(cell) for cell in row] for row in rows if row[0][:1].isdigit()])
    at = np.arange(360.0, 831.0)
    return [np.interp(at, numbers[:, 0], column) for column in numbers[:, 1:].T]


def srgb(spectra, nm):
    """IEC 61966-2-1 of CIE 15 tristimulus values under D65, 0..255; spectra: values x wavelengths."""
    light = curves("illuminant_D65.csv")[0]
    observer = np.array(curves("observer_CIE1931_2deg.csv"))
    at = np.arange(360.0, 831.0)
    fine = np.array([np.interp(at, nm, spectrum) for spectrum in spectra])
    xyz = fine @ (light * observer).T / np.sum(light * observer[1])
    linear = np.clip(xyz @ np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415],
                                     [0.0557, -0.2040, 1.0570]]).T, 0, 1)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def cube(folder, name, nm, values, more=""):
    """An ENVI file of float32, BIP, written here."""
    values.astype("<f4").tofile(os.path.join(folder, name + ".img"))
    path = os.path.join(folder, name + ".hdr")
    with open(path, "w", encoding="ascii") as header:
        header.write(f"ENVI\nsamples = {WIDTH}\nlines = {HEIGHT}\nbands = {len(nm)}\ndata type = 4\nbyte order = 0\n"
                     f"interleave = bip\nwavelength units = nm\nwavelength = {{{', '.join(map(str, nm))}}}\n{more}")
    return path


def spectra(nm):
    """Rows x columns x wavelengths: smooth, from black to white."""
    chance = np.random.default_rng(7)
    center, height = chance.uniform(400, 700, (HEIGHT, WIDTH, 1)), chance.uniform(0, 1, (HEIGHT, WIDTH, 1))
    values = 0.02 + 0.9 * height * np.exp(-((nm - center) / 60) ** 2)
    values[0, 0], values[4, 4], values[0, 1] = 1.0, 1.0, 0.0
    return values


def read(path, **options):
    reader = pipeline.create("SpectralImageReader", **options, FileNames=[path])
    pipeline.update(reader)
    return reader


def output(source):
    return source.SMProxy.GetClientSideObject().GetOutputDataObject(0)


def array(source, name):
    """Rows from the top x columns x components."""
    data = vtk_to_numpy(output(source).GetPointData().GetArray(name))
    return data.reshape(HEIGHT, WIDTH, -1)[::-1]


def field(source, name):
    values = output(source).GetFieldData().GetAbstractArray(name)
    return None if values is None else [values.GetValue(i) for i in range(values.GetNumberOfValues())]


MORE = ("fwhm = {%s}\nbbl = {%s}\ndescription = {a painting}\nsensor type = line camera\ndefault bands = {3, 2, 1}\n")


def check_fields(folder):
    nm = np.arange(400, 720, 10)
    bad = [i % 5 == 2 for i in range(len(nm))]
    more = MORE % (", ".join(f"{5 + i}" for i in range(len(nm))), ", ".join(str(int(not b)) for b in bad))
    values = spectra(nm)
    path = cube(folder, "fields", nm, values, more)
    whole, good = read(path), read(path, OnlyGoodBands=1)
    chosen = [i for i, b in enumerate(bad) if not b]
    check("bbl is field data", field(whole, "GoodBands") == [int(not b) for b in bad])
    check("bands without the bad ones", (array(good, "Responses") == values.astype("f4")[:, :, chosen]).all())
    flat = pipeline.create("FlatFieldCorrection", Input=whole, WhiteLevel=2.0)
    selected = pipeline.create("ChannelSelection", Input=whole, Channels=[str(i + 1) for i in chosen])
    pipeline.update(flat, selected)
    for name, source, bands in (("good bands", good, chosen), ("flat field", flat, range(len(nm))),
                                ("selection", selected, chosen)):
        check(f"{name}: wavelengths {field(source, 'Wavelength')}", field(source, "Wavelength") == [nm[i] for i in bands])
        check(f"{name}: fwhm {field(source, 'FWHM')}", field(source, "FWHM") == [5 + i for i in bands])
        check(f"{name}: good bands", field(source, "GoodBands") == [int(not bad[i]) for i in bands])
        check(f"{name}: metadata {field(source, 'FileMetadata')}",
              "description = a painting" in field(source, "FileMetadata"))
    saved = os.path.join(folder, "again.bsq")
    simple.SaveData(saved, proxy=flat)
    again = read(saved)
    for name in ("Wavelength", "FWHM", "GoodBands"):
        check(f"{name} is written and read", field(again, name) == field(whole, name))
    check(f"description is written and read: {field(again, 'FileMetadata')}",
          {"description = a painting", "sensor type = line camera"} <= set(field(again, "FileMetadata")))


def check_save_data(folder):
    nm = np.array([410.5, 500, 610, 705.25])
    values = spectra(nm).astype("f4")
    source = read(cube(folder, "source", nm, values), ArrayKind="Reflectance")
    for name, options in (("a.img", {}), ("b.hdr", {}), ("c.bip", {}), ("d.dat", {"Interleave": "BSQ"}),
                          ("e.exr", {}), ("f.img", {"SampleType": "float64", "BigEndian": 1})):
        path = os.path.join(folder, name)
        simple.SaveData(path, proxy=source, **options)
        pipeline.fail_on_error()
        back = read(path)
        check(f"{name} reads back", (array(back, "Reflectance") == values).all())
        check(f"{name}: wavelengths {field(back, 'Wavelength')}", field(back, "Wavelength") == list(nm))
    scaled = os.path.join(folder, "g.img")
    simple.SaveData(scaled, proxy=source, SampleType="uint16", ScaleFactor=10000)
    check("scaled integers", np.abs(array(read(scaled), "Reflectance") - values).max() <= 0.5001e-4)

    table = pipeline.create("SampleTableReader", FileName=os.path.join(root, "Data", "Samples", "demo-chart.csv"))
    pipeline.update(table)
    names, rows = pipeline.table(table)
    for name in ("a.ti3", "a.cie", "a.csv"):
        path = os.path.join(folder, name)
        if name == "a.csv":  # ParaView has a writer of its own for SaveData
            pipeline.save_table(table, path)
        else:
            simple.SaveData(path, proxy=table)
        pipeline.fail_on_error()
        back = pipeline.create("SampleTableReader", FileName=path)
        pipeline.update(back)
        again = dict(zip(pipeline.table(back)[0], zip(*pipeline.table(back)[1])))
        same = all(again.get(column) == tuple(row[i] for row in rows) for i, column in enumerate(names)
                   if column[:1] == "R" and column[1:].isdigit())
        check(f"{name} reads back", same and len(rows) == 140)


def check_colors(folder):
    nm = np.arange(380, 740, 10)
    values = spectra(nm)
    expected = srgb(values.reshape(-1, len(nm)), nm).reshape(HEIGHT, WIDTH, 3)

    def difference(source):
        return np.abs(array(source, "sRGB").astype(float) - expected).max()

    path = cube(folder, "reflectance", nm, values, "reflectance scale factor = 1\n")
    reflectance = read(path)
    check(f"reflectance: {difference(reflectance)} of 255 off", difference(reflectance) <= 1.0)
    check(f"white is {array(reflectance, 'sRGB')[0, 0]}", (array(reflectance, "sRGB")[0, 0] >= 254).all())
    check(f"black is {array(reflectance, 'sRGB')[0, 1]}", (array(reflectance, "sRGB")[0, 1] == 0).all())
    # Counts of a camera: white is the 99th percentile of the pixels' largest values, the lesser of two whites here.
    counts = read(cube(folder, "counts", nm, 4095 * values))
    check(f"counts: {difference(counts)} of 255 off", difference(counts) <= 1.0)
    # The wavelengths in another order are the same picture.
    turned = read(cube(folder, "turned", nm[::-1], values[:, :, ::-1], "reflectance scale factor = 1\n"))
    check(f"turned: {difference(turned)} of 255 off", difference(turned) <= 1.0)

    # Not all of the visible spectrum: the bands that the file names, else the longest, the middle, the shortest.
    infrared = np.array([800, 900, 1000, 1100])
    for name, more, bands in (("shown", "default bands = {2, 4, 1}\n", (1, 3, 0)), ("not-shown", "", (3, 2, 0))):
        source = read(cube(folder, name, infrared, values[:, :, :4] / values[:, :, :4].max(), more +
                           "reflectance scale factor = 1\n"))
        levels = values[:, :, list(bands)] / values[:, :, :4].max()
        picture = 255 * np.where(levels <= 0.0031308, 12.92 * levels, 1.055 * levels ** (1 / 2.4) - 0.055)
        off = np.abs(array(source, "False Color").astype(float) - picture).max()
        check(f"{name}: {off} of 255 off", off <= 1.0)


def check_first_view(folder):
    """What a view shows of a cube that was just opened."""
    source = read(os.path.join(folder, "reflectance.hdr"))
    view = simple.CreateView("RenderView")
    display = simple.Show(source, view)
    check("the view maps colors", list(display.ColorArrayName) == ["POINTS", "sRGB"] and display.MapScalars == 0)


def main():
    folder = sys.argv[1]
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    pipeline.load_plugin()
    check_fields(folder)
    check_save_data(folder)
    check_colors(folder)
    check_first_view(folder)
    print("\n".join(faults) or "fields, files and colors: as they should be")
    sys.stdout.flush()
    os._exit(1 if faults else 0)


main()
