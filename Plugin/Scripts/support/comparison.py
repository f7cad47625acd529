"""Comparing the methods: the results table and its three pictures."""

import math
import os

from . import command, pictures, pipeline
from .colors import Colors
from .command import Failure
from .methods import MEANINGS, NAMES

# Numbers of tuning samples of the picture rms against tuning.
TUNING_STEPS = (4, 6, 10, 16, 24, 36, 48)
MOST_DRAWS_OF_PICTURE = 10


def response_columns(table):
    return [name for name in pipeline.column_names(table)
            if name[:1] == "C" and name[1:].replace(".", "", 1).isdigit()]


def select_channels(table, count):
    """All channels, or every second one and the last, as the user asked by their number."""
    available = len(response_columns(table))
    if count is None or count == available:
        return table
    chosen = list(range(1, available, 2))
    chosen += [available] if chosen[-1:] != [available] else []
    if len(chosen) != count:
        raise Failure(f"--channels {count}: the table has {available} channels; expected "
                      f"{available} (all) or {len(chosen)} (every second and the last)")
    selection = pipeline.create("ChannelSelection", Input=table, Channels=list(map(str, chosen)))
    pipeline.update(selection)
    return selection


def compare(calibration, target, folder, methods, tuning, draws, seed, colors=None):
    """Writes the tables and pictures; prints the results. Returns their names and rows, and those of the pairs."""
    colors = colors or Colors()
    most = pipeline.number_of_rows(target) // 2
    steps = [count for count in TUNING_STEPS if count <= most]
    comparison = pipeline.create("MethodComparison", Calibration=calibration, Target=target, Methods=methods,
                                 TuningSamples=str(tuning), Draws=draws, Seed=seed,
                                 CurveSamples=", ".join(map(str, steps)), CurveDraws=MOST_DRAWS_OF_PICTURE,
                                 **colors.of_comparison())
    pipeline.update(comparison)
    pipeline.save_table(pipeline.port(comparison, 0), os.path.join(folder, "results.csv"))
    pipeline.save_table(pipeline.port(comparison, 1), os.path.join(folder, "draws.csv"))
    names, rows = pipeline.table(pipeline.port(comparison, 0))
    print_results(names, rows)

    pipeline.save_table(pipeline.port(comparison, 3), os.path.join(folder, "rms-against-tuning.csv"))
    pipeline.save_table(pipeline.port(comparison, 4), os.path.join(folder, "samples.csv"))
    pipeline.save_table(pipeline.port(comparison, 5), os.path.join(folder, "pairs.csv"))
    _draw_spectra(comparison, _methods_in(comparison, 2), os.path.join(folder, "spectra.png"))
    _draw_curves(comparison, _methods_in(comparison, 3), os.path.join(folder, "rms-against-tuning.png"))
    _draw_colors(calibration, target, tuning, seed, colors, os.path.join(folder, "ab-distribution.png"))
    return names, rows, pipeline.table(pipeline.port(comparison, 5))


def _methods_in(comparison, index):
    """The methods that have a column in this output; those that could not be fitted have none."""
    columns = pipeline.column_names(pipeline.port(comparison, index))
    return [name for name in NAMES if name in columns]


def condensed(names, rows):
    """One row a method: mean / median / max of each metric, as text."""
    column = {name: i for i, name in enumerate(names)}
    by_method = {}
    for row in rows:
        metric, illuminant = row[column["metric"]], row[column["illuminant"]]
        figures = [row[column[name]] for name in ("mean", "median", "max")]
        interval = metric[8:] if metric.startswith("coverage") else ""
        if interval:
            cell = f"{100 * figures[0]:.0f} %"
        else:
            digits = 4 if metric == "rms" else 2
            cell = " / ".join(f"{figure:.{digits}f}" for figure in figures)
        title = f"within {interval} % interval" if interval else f"{metric} {illuminant}"
        by_method.setdefault(row[column["method"]], {})[title.strip()] = cell
    titles = list(dict.fromkeys(title for cells in by_method.values() for title in cells))
    return (["method"] + titles,
            [[method] + [cells.get(title, "") for title in titles]
             for method, cells in by_method.items()])


def explained(names, rows):
    """The methods of a condensed table and its intervals, in words."""
    titles, lines = condensed(names, rows)
    text = "; ".join(f"{line[0]}: {MEANINGS[line[0]]}" for line in lines) + "."
    if any(title.startswith("within") for title in titles):
        text += " Within 90 % interval: how many of the held-out reflectances lie in the interval that the method predicts."
    return text


def against_best(names, rows, pairs):
    """The paired comparison of the method with the least rms with all others, as titles and lines of a table."""
    column = {name: i for i, name in enumerate(names)}
    means = {row[column["method"]]: row[column["mean"]] for row in rows if row[column["metric"]] == "rms"}
    if not means:
        return [], []
    first = min(means, key=means.get)
    titles, pair_rows = pairs
    at = {name: i for i, name in enumerate(titles)}
    metrics = list(dict.fromkeys((row[at["metric"]], row[at["illuminant"]]) for row in pair_rows))
    lines = {}
    for row in pair_rows:
        if row[at["method"]] == first:
            verdict = {first: "better", "": "open"}.get(row[at["better"]], "worse")
            values = [row[at[name]] for name in ("ratio", "low", "high", "wins")]
            interval = "no interval from one draw" if math.isnan(values[1]) else "{:.2f} .. {:.2f}".format(*values[1:3])
            lines.setdefault(row[at["against"]], {})[row[at["metric"]], row[at["illuminant"]]] = (
                f"{values[0]:.2f} ({interval}), smaller in {100.0 * values[3]:.0f} %: {verdict}")
    return ([f"{first} against"] + [" ".join(filter(None, metric)) for metric in metrics],
            [[other] + [cells.get(metric, "") for metric in metrics] for other, cells in lines.items()])


def best(names, rows, judged=None):
    """The method with the least mean spectral rms, in one sentence; empty on ranks without the table."""
    column = {name: i for i, name in enumerate(names)}

    def means(metric, illuminant=""):
        return {row[column["method"]]: row[column["mean"]] for row in rows
                if (row[column["metric"]], row[column["illuminant"]]) == (metric, illuminant)}
    rms = means("rms") if rows else {}
    if not rms:
        return ""
    method = min(rms, key=rms.get)
    text = f"The method {method} has the least spectral rms on the held-out samples: {rms[method]:.4f}"
    if "direct" in rms and method != "direct":
        text += f", against {rms['direct']:.4f} with the chart's calibration alone"
    judged = judged or Colors()
    colors = means(judged.metric, judged.illuminants[0])
    if method in colors:
        text += f"; mean {judged.label} {colors[method]:.2f} ({judged.text})"
        if "direct" in colors and method != "direct":
            text += f" against {colors['direct']:.2f}"
    return text + "."


def print_results(names, rows):
    titles, lines = condensed(names, rows)
    for line in [titles] + lines:
        command.say(f"{line[0]:<16}" + "".join(f"{cell:>27}" for cell in line[1:]).rstrip())
    command.say("(mean / median / max over held-out samples, mean over draws)")


def _draw_spectra(comparison, methods, path):
    chart = pictures.Chart("A typical held-out sample", "Wavelength (nm)", "Reflectance factor")
    chart.legend_at("TopLeft")
    spectra = pipeline.port(comparison, 2)
    series = {"measured": ("measured", pictures.COLORS["measured"], pictures.LineStyle.SOLID, 4.0)}
    for method in methods:
        series[method] = (method, pictures.COLORS[method], pictures.LineStyle.SOLID, 2.0)
    if "transfer" in methods:
        color = pictures.COLORS["transfer"]
        for sign, label in (("-2s", "transfer, 2 standard deviations"), ("+2s", "")):
            series[f"transfer {sign}"] = (label, color, pictures.LineStyle.DOT, 1.5)
    chart.add(spectra, "wavelength", series)
    chart.limits(left=(0.0, _top_of_spectra(spectra, methods)))
    chart.save(path)


def _top_of_spectra(spectra, methods):
    """Room for the measured spectrum and the last method; a wild one may leave the chart."""
    names, rows = pipeline.table(spectra)
    shown = [name for name in ("measured", *methods[-1:]) if name in names]
    largest = max((row[names.index(name)] for row in rows for name in shown), default=1.0)
    return 1.3 * pipeline.share([largest], 1)[0]


def _draw_curves(curves, methods, path):
    chart = pictures.Chart("Error against the number of tuning samples, with 95 % intervals", "Tuning samples",
                           "Spectral rms, mean over held-out samples", log_y=True)
    source = pipeline.port(curves, 3)
    chart.add(source, "tuning", {method: (method, pictures.COLORS[method]) for method in methods},
              marker=pictures.Marker.CIRCLE)
    for method in methods:
        chart.band(source, "tuning", f"{method} low", f"{method} high", pictures.COLORS[method])
    if "own-medium" in pipeline.column_names(source):
        chart.add(source, "tuning", {"own-medium": ("own medium, least squares",
                                                    pictures.COLORS["measured"], pictures.LineStyle.DOT, 1.5)})
    chart.save(path)


def _draw_colors(calibration, target, tuning, seed, colors, path):
    """The a*b* distribution of the three sets of the first draw."""
    split = pipeline.create("SampleSplit", Input=target, Mode="Random", Count=tuning, Seed=seed)
    chart = pictures.Chart(f"Colors of the three sets ({colors.text})", "a*", "b*",
                           size=(800, 800))
    sets = (("calibration", calibration), ("held out", pipeline.port(split, 1)),
            ("tuning", pipeline.port(split, 0)))
    for name, source in sets:
        color = pipeline.create("SpectralToColor", Input=source, **colors.of_view())
        pipeline.update(color)
        chart.add(color, "R_a", {"R_b": (name, pictures.COLORS[name])},
                  line=pictures.LineStyle.NONE, marker=pictures.Marker.CIRCLE,
                  marker_size=9.0 if name == "tuning" else 6.0)
    chart.save(path)
