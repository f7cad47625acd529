"""From images and samples to a reflectance image, its RGB view and its error maps."""

import collections
import os
import re

from . import cameras, command, pictures, pipeline, report, state
from .colors import Colors

# Images of more pixels than this are shown by every n-th one, so that a side has at most so many.
MOST_PIXELS_SHOWN = 4_000_000
PIXELS_OF_THINNED_SIDE = 384

Judged = collections.namedtuple("Judged", "errors summary patches arrays")


def read_image(files, wavelengths=None, stride=1):
    """Camera responses, whatever the file calls them."""
    options = {"Wavelengths": wavelengths} if wavelengths else {}
    # ParaView opens a file as soon as its name is set: what it depends on comes first.
    return pipeline.create("SpectralImageReader", **options, FileNames=files, ArrayKind="Responses",
                           Preview=0, Stride=[stride, stride])


def read_labels(path, stride=1):
    return pipeline.create("LabelImageReader", FileName=path, Stride=[stride, stride])


def flat_field(image, white, dark, **options):
    """(raw - dark) / (white - dark), with the frames that there are; options: properties of the filter."""
    if white is None and dark is None and not options:
        return image
    frames = dict(options)
    if white is not None:
        frames["White"] = white
    if dark is not None:
        frames["Dark"] = dark
    return pipeline.create("FlatFieldCorrection", Input=image, Preview=0, **frames)


def registered(image, displacements):
    """The channels of the image on one another; the image itself without displacements."""
    if displacements is None:
        return image
    return pipeline.create("ChannelRegistration", Input=image, Displacements=displacements, Preview=0)


def stride_of_pictures(image):
    """1, or every how many pixels a picture of this image shows."""
    width, height = pictures.size(image)
    return 1 if width * height <= MOST_PIXELS_SHOWN else -(-max(width, height) // PIXELS_OF_THINNED_SIDE)


def stride_of_judgement(image):
    """Every how many pixels tell what an image is like."""
    return -(-max(pictures.size(image)) // PIXELS_OF_THINNED_SIDE)


def correction(calibration, tuning, method):
    """The transforms W and D (or the transfer model) as inputs of Reflectance Estimation.

    Without tuning samples the chart alone: by pseudoinverse for the method Direct, else by ridge."""
    if tuning is None:
        fit = pipeline.create("ReflectanceCalibration", Input=calibration,
                              Method="Pseudoinverse" if method == "Direct" else "Ridge")
        pipeline.update(fit)
        return {"ReflectanceTransform": pipeline.port(fit, 0)}, pipeline.port(fit, 1)
    fit = pipeline.create("MetamerismCorrection", Calibration=calibration, Tuning=tuning,
                          Method=method)
    pipeline.update(fit)
    return ({"ReflectanceTransform": pipeline.port(fit, 0),
             "MetamerismTransform": pipeline.port(fit, 1)}, pipeline.port(fit, 2))


def estimate(image, transforms, folder, trust=False):
    """The reflectance image, which nothing has computed yet; its transforms are written. trust: the user vouches for
    responses that look like raw counts."""
    for name, source in transforms.items():
        words = "".join("-" + c.lower() if c.isupper() else c for c in name).lstrip("-")
        pipeline.save_table(source, os.path.join(folder, f"{words}.csv"))
    return pipeline.create("ReflectanceEstimation", Input=image, Preview=0, TrustResponses=int(trust), **transforms)


def check_samples(samples, name, calibration=None):
    """Notes what is to be doubted about samples, beside the chart's where it is given; nothing where channels have no number."""
    if not cameras.responses(samples):
        return
    chart = {"Calibration": calibration} if calibration else {}
    pipeline.update(pipeline.create("SampleCheck", Input=samples, SamplesName=name, **chart))


def require_plausible(image, transforms, trust=False):
    """The filter's judgement of responses, which it gives of whole images only: before a large one is worked through in
    pieces. image: every n-th pixel of it. Returns the estimate with its quality maps, the share of the pixels whose
    responses lie outside of the range of the fitted samples, None where it is not known, and the share without a result."""
    estimated = pipeline.create("ReflectanceEstimation", Input=image, QualityMaps=1, TrustResponses=int(trust), **transforms)
    pipeline.whole(estimated)
    estimated.UpdatePropertyInformation()
    outside, missing = (float(estimated.GetProperty(name).GetData()) for name in ("OutOfRangeShare", "MissingShare"))
    return estimated, outside if outside >= 0.0 else None, missing


QUALITY_MAPS = {"OutOfRange": ("out-of-range.png", "How far the responses lie outside of the range of the fitted samples "
                               "(0: within; 1: by the width of the range)"),
                "UncertaintyRms": ("uncertainty.png", "Standard uncertainty of the reflectance, root mean square over the "
                                   "bands")}


def save_quality(estimated, folder):
    """Pictures of the maps that the estimate knows; the report's section on them."""
    arrays = pipeline.whole(estimated).GetPointData()
    captions = {}
    for array, (name, caption) in QUALITY_MAPS.items():
        path = os.path.join(folder, name)
        if arrays.GetArray(array) is not None:
            pictures.image(estimated, array, path)
            captions[name] = caption
    return report.pictures("How far to trust each pixel", folder, captions) if captions else ""


def save_view(reflectance, folder, whole=None, colors=None, name="rgb.png"):
    """The RGB view; whole: the image in full, whose colors are written as srgb.png."""
    options = (colors or Colors()).of_view()
    color = pipeline.create("SpectralToColor", Input=reflectance, **options)
    pipeline.update(color)
    pictures.image(color, "sRGB", os.path.join(folder, name), rgb=True)
    if whole is not None:
        pictures.srgb(pipeline.create("SpectralToColor", Input=whole, **options), os.path.join(folder, "srgb.png"))


CUBES = {"exr": "reflectance.exr", "envi": "reflectance.img"}


def save_reflectance(reflectance, folder, cube="exr"):
    """Block by block: the image never stands in memory whole."""
    pipeline.save_image(reflectance, os.path.join(folder, CUBES[cube]))


def error_maps(reflectance, labels, held_out, conditions):
    reference = pipeline.create("PatchReferenceImage", Input=labels, PatchTable=held_out, Preview=0)
    return pipeline.create("CIEDE2000Evaluator", Input=reflectance, Reference=reference, **conditions)


def patch_errors(reflectance, labels, held_out, conditions):
    """Of the mean spectrum of each patch; their statistics are the second output."""
    sampled = pipeline.create("PatchSampler", Input=reflectance, Labels=labels, PatchTable=held_out)
    patches = pipeline.create("CIEDE2000Evaluator", Input=sampled, **conditions)
    pipeline.update(patches)
    return patches


def judge(reflectance, labels, held_out, folder, tops=None, view=None, colors=None):
    """Error maps over the held-out patches, their statistics, and the errors of the patches' mean spectra.

    view: reflectance and labels for the pictures, where the image is too large to be shown pixel by pixel."""
    colors = colors or Colors()
    conditions, arrays = colors.of_errors(), colors.error_arrays()
    maps = os.path.join(folder, "error-maps.img")
    pipeline.save_image(error_maps(reflectance, labels, held_out, conditions), maps, PointArrays=list(arrays))
    summary = pipeline.create("ErrorSummary",
                              Input=pipeline.create("SpectralImageReader", FileNames=[maps], Preview=0))
    pipeline.update(summary)
    pipeline.save_table(summary, os.path.join(folder, "errors-of-pixels.csv"))

    errors = error_maps(*(view or (reflectance, labels)), held_out, conditions)
    pipeline.update(errors)
    for array, top in zip(arrays, tops or top_errors(summary)):
        pictures.image(errors, array, error_picture(folder, array), value_range=(0.0, top))

    patches = patch_errors(reflectance, labels, held_out, conditions)
    pipeline.save_table(patches, os.path.join(folder, "patches.csv"))
    pipeline.save_table(pipeline.port(patches, 1), os.path.join(folder, "errors-of-patches.csv"))
    return Judged(errors, summary, patches, arrays)


def print_summary(title, source):
    names, rows = pipeline.table(source)
    if not rows:
        return
    at = names.index
    command.say(title)
    labels = [f"{row[at('metric')]} {row[at('illuminant')]}".strip() for row in rows]
    width = max(map(len, labels))
    for label, row in zip(labels, rows):
        form = "{:.4f}" if row[at("metric")] == "rms" else "{:.2f}"
        figures = "   ".join(f"{name} {form.format(row[at(name)])}"
                             for name in ("mean", "median", "p95", "max"))
        command.say(f"  {label:<{width}}  {figures}   ({row[at('count')]:.0f})")


def top_errors(summary):
    """Where the color scale of each map ends: color differences always at the same value, rms at its 95th percentile."""
    names, rows = pipeline.table(summary)
    tops = [pictures.DIFFERENCES[-1] if row[names.index("metric")].startswith("dE") else row[names.index("p95")] for row in rows]
    return pipeline.share(tops, pipeline.number_of_rows(summary))


def error_picture(folder, array):
    return os.path.join(folder, f"error-{re.sub('[^A-Za-z0-9.-]', '-', array)}.png")


def report_errors(judged, folder, shown=()):
    """The report's sections on where the result is wrong. shown: maps that the page has already."""
    maps = {os.path.basename(error_picture(folder, array)):
            f"{report.in_words(array)} over the held-out patches; " + (
                "the color scale is the same for all maps of color differences" if array.startswith("dE") else
                "the color scale ends at the 95th percentile")
            for array in judged.arrays if array not in shown}
    return [report.pictures("Where it is wrong", folder, maps),
            report.table("Errors of the held-out patches (mean spectrum of each)",
                         *pipeline.table(pipeline.port(judged.patches, 1))),
            report.table("Errors of the held-out pixels",
                         *pipeline.table(judged.summary)),
            report.table("Each held-out patch", *pipeline.table(judged.patches),
                         columns=patch_columns(judged))]


def patch_columns(judged):
    names, _ = pipeline.table(judged.patches)
    return [name for name in ("sample", "label", "medium", "count", *judged.arrays) if name in names]


def mean_of(patches, metric, illuminant=""):
    """Mean and largest error of the patches' mean spectra, and their number; None where there is none (or not on this rank)."""
    names, rows = pipeline.table(pipeline.port(patches, 1))
    for row in rows:
        if row[names.index("metric")] == metric and row[names.index("illuminant")] == illuminant:
            return row[names.index("mean")], row[names.index("max")], int(row[names.index("count")])
    return None


def save_state(path, reflectance, judged=None, colors=None):
    """The pipeline as a ParaView state that opens with the RGB view and the error map side by side."""
    color = pipeline.create("SpectralToColor", Input=reflectance, **(colors or Colors()).of_view())
    pipeline.update(color)
    top = top_errors(judged.summary)[1] if judged else 1.0
    state.save(path, color, judged and judged.errors, top, judged.arrays[1] if judged else "")
