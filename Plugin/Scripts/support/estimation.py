"""From images and samples to a reflectance image, its RGB view and its error maps."""

import os

from paraview import simple

from . import command, pictures, pipeline, report

ERROR_ARRAYS = ("rms", "dE00 D65", "dE00 F2")


def read_image(files, wavelengths=None):
    options = {"Wavelengths": wavelengths} if wavelengths else {}
    image = pipeline.create("SpectralImageReader", FileNames=files, **options)
    pipeline.update(image)
    return image


def flat_field(image, white, dark):
    """(raw - dark) / (white - dark), with the frames that there are."""
    if white is None and dark is None:
        return image
    frames = {}
    if white is not None:
        frames["White"] = white
    if dark is not None:
        frames["Dark"] = dark
    corrected = pipeline.create("FlatFieldCorrection", Input=image, **frames)
    pipeline.update(corrected)
    return corrected


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
    """The reflectance image, written with its transforms, and its RGB view as rgb.png."""
    reflectance = pipeline.create("ReflectanceEstimation", Input=image, **transforms)
    pipeline.update(reflectance)
    for name, source in transforms.items():
        words = "".join("-" + c.lower() if c.isupper() else c for c in name).lstrip("-")
        pipeline.save_table(source, os.path.join(folder, f"{words}.csv"))
    color = pipeline.create("SpectralToColor", Input=reflectance)
    pipeline.update(color)
    pictures.image(color, "sRGB", os.path.join(folder, "rgb.png"), rgb=True)
    return reflectance


def save_reflectance(reflectance, folder):
    path = os.path.join(folder, "reflectance.exr")
    pipeline.save_image(reflectance, path)
    return path


def judge(reflectance, labels, held_out, folder, tops=None):
    """Error maps over the held-out patches, and the errors of the patches' mean spectra."""
    reference = pipeline.create("PatchReferenceImage", Input=labels, PatchTable=held_out)
    errors = pipeline.create("CIEDE2000Evaluator", Input=reflectance, Reference=reference)
    pipeline.update(errors)
    tops = tops or top_errors(errors)
    for array, top in zip(ERROR_ARRAYS, tops):
        pictures.image(errors, array, error_picture(folder, array), value_range=(0.0, top))
    pipeline.save_table(pipeline.port(errors, 1), os.path.join(folder, "errors-of-pixels.csv"))

    sampled = pipeline.create("PatchSampler", Input=reflectance, Labels=labels,
                              PatchTable=held_out)
    patches = pipeline.create("CIEDE2000Evaluator", Input=sampled)
    pipeline.update(patches)
    pipeline.save_table(patches, os.path.join(folder, "patches.csv"))
    pipeline.save_table(pipeline.port(patches, 1), os.path.join(folder, "errors-of-patches.csv"))
    return errors, patches


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


def top_errors(errors):
    """The 95th percentile of each error: where the color scale of its map ends."""
    names, rows = pipeline.table(pipeline.port(errors, 1))
    return pipeline.share([row[names.index("p95")] for row in rows], len(ERROR_ARRAYS))


def error_picture(folder, array):
    return os.path.join(folder, f"error-{array.replace(' ', '-')}.png")


def report_errors(errors, patches, folder):
    """The report's sections on where the result is wrong."""
    maps = {os.path.basename(error_picture(folder, array)):
            f"{array} over the held-out patches; the color scale ends at the 95th percentile"
            for array in ERROR_ARRAYS}
    return [report.pictures("Where it is wrong", folder, maps),
            report.table("Errors of the held-out patches (mean spectrum of each)",
                         *pipeline.table(pipeline.port(patches, 1))),
            report.table("Errors of the held-out pixels",
                         *pipeline.table(pipeline.port(errors, 1))),
            report.table("Each held-out patch", *pipeline.table(patches),
                         columns=patch_columns(patches))]


def patch_columns(patches):
    names, _ = pipeline.table(patches)
    return [name for name in ("sample", "label", "medium", "count", *ERROR_ARRAYS) if name in names]


def save_state(path, reflectance, errors=None):
    """The pipeline as a ParaView state that opens with the RGB view and the error map side by side."""
    color = pipeline.create("SpectralToColor", Input=reflectance)
    pipeline.update(color)
    views = [pictures.image_view(color, "sRGB", rgb=True)]
    if errors is not None:
        views.append(pictures.image_view(errors, "dE00 D65", (0.0, top_errors(errors)[1])))
    pictures.side_by_side(views)
    if command.rank() == 0:
        simple.SaveState(path)
