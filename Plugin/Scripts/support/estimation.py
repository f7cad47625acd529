"""From images and samples to a reflectance image, its RGB view and its error maps."""

import collections
import os

from . import command, outputs, pictures, pipeline, report, state

ERROR_ARRAYS = ("rms", "dE00 D65", "dE00 F2")


# Images of more pixels than this are shown by every n-th one, so that a side has at most so many.
MOST_PIXELS_SHOWN = 4_000_000
PIXELS_OF_THINNED_SIDE = 384

Judged = collections.namedtuple("Judged", "errors summary patches")


def read_image(files, wavelengths=None, stride=1):
    """Camera responses, whatever the file calls them."""
    options = {"Wavelengths": wavelengths} if wavelengths else {}
    # ParaView opens a file as soon as its name is set: what it depends on comes first.
    return pipeline.create("SpectralImageReader", **options, FileNames=files, ArrayKind="Responses",
                           Preview=0, Stride=[stride, stride])


def read_labels(path, stride=1):
    return pipeline.create("LabelImageReader", FileName=path, Stride=[stride, stride])


def flat_field(image, white, dark):
    """(raw - dark) / (white - dark), with the frames that there are."""
    if white is None and dark is None:
        return image
    frames = {}
    if white is not None:
        frames["White"] = white
    if dark is not None:
        frames["Dark"] = dark
    return pipeline.create("FlatFieldCorrection", Input=image, Preview=0, **frames)


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


def estimate(image, transforms, folder):
    """The reflectance image, which nothing has computed yet; its transforms are written."""
    for name, source in transforms.items():
        words = "".join("-" + c.lower() if c.isupper() else c for c in name).lstrip("-")
        pipeline.save_table(source, os.path.join(folder, f"{words}.csv"))
    return pipeline.create("ReflectanceEstimation", Input=image, Preview=0, **transforms)


def require_plausible(image, transforms):
    """The filter's judgement of responses, which it gives of whole images only: before a large one is worked through in
    pieces. image: every n-th pixel of it."""
    pipeline.whole(pipeline.create("ReflectanceEstimation", Input=image, **transforms))


def save_view(reflectance, folder):
    """The RGB view as rgb.png."""
    color = pipeline.create("SpectralToColor", Input=reflectance)
    pipeline.update(color)
    pictures.image(color, "sRGB", os.path.join(folder, "rgb.png"), rgb=True)


def save_reflectance(reflectance, folder):
    """Block by block: the image never stands in memory whole."""
    pipeline.save_image(reflectance, os.path.join(folder, "reflectance.exr"))


def error_maps(reflectance, labels, held_out):
    reference = pipeline.create("PatchReferenceImage", Input=labels, PatchTable=held_out, Preview=0)
    return pipeline.create("CIEDE2000Evaluator", Input=reflectance, Reference=reference)


def judge(reflectance, labels, held_out, folder, tops=None, view=None):
    """Error maps over the held-out patches, their statistics, and the errors of the patches' mean spectra.

    view: reflectance and labels for the pictures, where the image is too large to be shown pixel by pixel."""
    maps = os.path.join(folder, "error-maps.img")
    pipeline.save_image(error_maps(reflectance, labels, held_out), maps,
                        PointArrays=list(ERROR_ARRAYS))
    summary = pipeline.create("ErrorSummary",
                              Input=pipeline.create("SpectralImageReader", FileNames=[maps], Preview=0))
    pipeline.update(summary)
    pipeline.save_table(summary, os.path.join(folder, "errors-of-pixels.csv"))

    errors = error_maps(*(view or (reflectance, labels)), held_out)
    pipeline.update(errors)
    for array, top in zip(ERROR_ARRAYS, tops or top_errors(summary)):
        pictures.image(errors, array, error_picture(folder, array), value_range=(0.0, top))

    sampled = pipeline.create("PatchSampler", Input=reflectance, Labels=labels,
                              PatchTable=held_out)
    patches = pipeline.create("CIEDE2000Evaluator", Input=sampled)
    pipeline.update(patches)
    pipeline.save_table(patches, os.path.join(folder, "patches.csv"))
    pipeline.save_table(pipeline.port(patches, 1), os.path.join(folder, "errors-of-patches.csv"))
    return Judged(errors, summary, patches)


def print_summary(title, source):
    names, rows = pipeline.table(source)
    if not rows:
        return
    at = names.index
    command.say(title)
    for row in rows:
        label = f"{row[at('metric')]} {row[at('illuminant')]}".strip()
        form = "{:.4f}" if row[at("metric")] == "rms" else "{:.2f}"
        figures = "   ".join(f"{name} {form.format(row[at(name)])}"
                             for name in ("mean", "median", "p95", "max"))
        command.say(f"  {label:<10}{figures}   ({row[at('count')]:.0f})")


def top_errors(summary):
    """The 95th percentile of each error: where the color scale of its map ends."""
    names, rows = pipeline.table(summary)
    return pipeline.share([row[names.index("p95")] for row in rows], len(ERROR_ARRAYS))


def error_picture(folder, array):
    return os.path.join(folder, f"error-{array.replace(' ', '-')}.png")


def report_errors(judged, folder):
    """The report's sections on where the result is wrong."""
    maps = {os.path.basename(error_picture(folder, array)):
            f"{array} over the held-out patches; the color scale ends at the 95th percentile"
            for array in ERROR_ARRAYS}
    return [report.pictures("Where it is wrong", folder, maps),
            report.table("Errors of the held-out patches (mean spectrum of each)",
                         *pipeline.table(pipeline.port(judged.patches, 1))),
            report.table("Errors of the held-out pixels",
                         *pipeline.table(judged.summary)),
            report.table("Each held-out patch", *pipeline.table(judged.patches),
                         columns=patch_columns(judged.patches))]


def patch_columns(patches):
    names, _ = pipeline.table(patches)
    return [name for name in ("sample", "label", "medium", "count", *ERROR_ARRAYS) if name in names]


def save_state(path, reflectance, judged=None):
    """The pipeline as a ParaView state that opens with the RGB view and the error map side by side."""
    color = pipeline.create("SpectralToColor", Input=reflectance)
    pipeline.update(color)
    top = top_errors(judged.summary)[1] if judged else 1.0
    state.save(path, color, judged and judged.errors, top)
