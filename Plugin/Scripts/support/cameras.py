"""A simulated camera beside the real one: responsivities, tables and pictures."""

import colorsys
import os

import numpy

from . import command, pictures, pipeline, report

MOST_CHANNEL_PICTURES = 16


def read(path):
    camera = pipeline.create("CameraReader", FileName=path)
    pipeline.update(camera)
    return camera


def fit(samples, nominal, draws, folder, curve=False):
    """Fits the camera to the samples and keeps it with all that the fit knows; returns the fit's proxy."""
    inputs = {"NominalCamera": nominal} if nominal is not None else {}
    fitted = pipeline.create("CameraModelFit", Input=samples, Draws=draws, DetectorCurve=int(curve), **inputs)
    pipeline.update(fitted)
    save(pipeline.port(fitted, 0), os.path.join(folder, "camera.json"))
    for index, name in ((1, "uncertainty"), (2, "fit"), (3, "channels")):
        pipeline.save_table(pipeline.port(fitted, index), os.path.join(folder, f"{name}.csv"))
    names, rows = pipeline.table(pipeline.port(fitted, 2))
    if rows:
        figures = dict(zip(names, rows[0]))
        command.say(f"fitted on {figures['samples']} samples: rms {figures['residual_rms']:.4g}, "
                    f"on samples left out {figures['held_out_rms']:.4g}")
        command.say(figures["status"])
    return fitted


def save(camera, path):
    pipeline.save_camera(camera, path)


def simulate(scene, camera, **properties):
    simulated = pipeline.create("CameraSimulator", Input=scene, Camera=camera, **properties)
    pipeline.update(simulated)
    return simulated


def compare(real, simulated, name, folder):
    """Keeps and prints the difference of each channel; returns the difference's proxy."""
    difference = pipeline.create("ResponseDifference", Input=real, Simulated=simulated)
    pipeline.update(difference)
    pipeline.save_table(pipeline.port(difference, 0), os.path.join(folder, f"{name}.csv"))
    pipeline.save_table(pipeline.port(difference, 1), os.path.join(folder, f"{name}-channels.csv"))
    names, rows = pipeline.table(pipeline.port(difference, 1))
    if rows:
        titles = ("mean", "rms", "gain", "offset", "rms_around_line")
        command.say(f"{name}:")
        command.say(f"  {'channel':<9}" + "".join(f"{title:>17}" for title in titles))
        for row in rows:
            figures = "".join(f"{row[names.index(title)]:17.5f}" for title in titles)
            command.say(f"  {row[names.index('channel')]:<9}{figures}")
    return difference


def color(index, count):
    """One color a channel, from blue to red."""
    return colorsys.hsv_to_rgb(0.7 * (1.0 - index / max(1, count - 1)), 0.85, 0.8)


def responses(samples):
    """The columns of the real camera's responses."""
    return [name for name in pipeline.column_names(samples)
            if name[:1] == "C" and name[1:].replace(".", "", 1).isdigit()]


def channels(camera):
    return [name for name in pipeline.column_names(camera) if name != "wavelength"]


def draw_responsivities(camera, path, uncertainty=None):
    chart = pictures.Chart("Responsivity of each channel" +
                           (", dotted: its 95 % interval" if uncertainty is not None else ""),
                           "Wavelength (nm)", "Response to a band of perfect white")
    names = channels(camera)
    words = report.channels(names)
    shades = {name: color(i, len(names)) for i, name in enumerate(names)}
    chart.add(camera, "wavelength",
              {name: (words[name], shades[name], pictures.LineStyle.SOLID, 2.5) for name in names})
    if uncertainty is not None:
        known = pipeline.column_names(uncertainty)
        chart.add(uncertainty, "wavelength",
                  {f"{side} {name}": ("", shades[name], pictures.LineStyle.DOT, 1.2)
                   for name in names for side in ("low", "high") if f"{side} {name}" in known})
    chart.save(path)


def draw_samples(difference, title, path):
    """The difference of every sample, channel by channel."""
    prefix = "difference "
    names = [name.removeprefix(prefix) for name in pipeline.column_names(pipeline.port(difference, 0))
             if name.startswith(prefix)]
    words = report.channels(names)
    chart = pictures.Chart(f"Every sample: {title}", "Sample", "Difference (response, 1 = white)")
    chart.add(pipeline.port(difference, 0), None,
              {prefix + name: (words[name], color(i, len(names))) for i, name in enumerate(names)},
              line=pictures.LineStyle.NONE, marker=pictures.Marker.CIRCLE, marker_size=4.0)
    chart.save(path)


def draw_figures(difference, title, path):
    """Mean and rms of the difference in each channel, and the rms that no line takes away."""
    names, rows = pipeline.table(pipeline.port(difference, 1))
    known = list(report.channels([row[names.index("channel")] for row in rows]).values())
    in_nm = all(name.endswith(" nm") for name in known)
    chart = pictures.Chart(f"Each channel: {title}", "Channel (nm)" if in_nm else "Channel", "Difference (response, 1 = white)")
    chart.add(pipeline.port(difference, 1), [float(name[:-3]) for name in known] if in_nm else list(range(1, len(rows) + 1)),
              {"mean": ("mean", pictures.COLORS["direct"]),
               "rms": ("rms", pictures.COLORS["transfer"]),
               "rms_around_line": ("rms around the best line", pictures.COLORS["banded"])},
              marker=pictures.Marker.CIRCLE)
    chart.save(path)


def draw_channels(simulated, real, difference, folder, titles=("simulated", "real", "difference")):
    """Per channel three images in a row: simulated, real, difference. Returns the pictures' names."""
    names = channel_names(simulated)
    seen, answered, apart = (pictures.values(simulated, "Responses"), pictures.values(real),
                             pictures.values(difference, "Difference"))
    saved = {}
    for k, label in enumerate(names[:MOST_CHANNEL_PICTURES]):
        low, high = float(numpy.nanmin(seen[:, :, k])), float(numpy.nanmax(seen[:, :, k]))
        reach = 0.25 * (high - low)
        top = high + reach
        name = f"channel-{k + 1}.png"
        pictures.channel_row(((seen[:, :, k], titles[0], (0.0, top)), (answered[:, :, k], titles[1], (0.0, top)),
                              (apart[:, :, k], titles[2], (-reach, reach))), os.path.join(folder, name))
        saved[name] = f"{label}: {titles[0]}, {titles[1]}, {titles[1]} minus {titles[0]}"
    return saved


def channel_names(simulated):
    """The channels of an image of responses."""
    array = pipeline.whole(simulated).GetPointData().GetArray("Responses")
    return [array.GetComponentName(k) for k in range(array.GetNumberOfComponents())]


def chart_image(labels, patches):
    """The chart as its patches were measured: an image of reflectance."""
    reference = pipeline.create("PatchReferenceImage", Input=labels, PatchTable=patches)
    pipeline.update(reference)
    return reference
