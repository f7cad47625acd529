"""The pictures of a diagnosis, drawn from its tables: where, which, how far."""

import os

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from . import outputs, painter

# Okabe and Ito's palette: told apart with any color vision.
_BEFORE, _AFTER, _FLOOR, _PLAIN = "#D55E00", "#0072B2", "#009E73", "#B0B0B0"
_DOUBTED = "#A6CDE3"  # the blue of what is likely, pale
_STYLE = {"font.size": 11, "axes.spines.top": False, "axes.spines.right": False,
          "axes.axisbelow": True, "figure.dpi": 110, "savefig.bbox": "tight"}
NAMES = ("gap-map.png", "axes.png", "where.png", "map.png", "trend.png", "which.png", "how-far.png")
LIKELY = 0.5  # probability from which a cause is not only a possible one
_MOST_LABELS = 40
_MOST_SCENES = 4
_MOST_CHANNELS = 18
_MOST_CHANNEL_NAMES = 30
_CHANNELS_IN_A_LINE = 6
_MOST_PIXELS_OF_A_SIDE = 512


def draw_all(tables, summary, folder, held):
    """Those pictures for which there are data; one that an earlier run left behind is taken away."""
    gap = summary["verdict"] != "no gap"
    pictures = {"axes.png": (_axes, tables["where"]) if gap else (),
                "where.png": (_heat_maps, tables["heat-map"], summary),
                "map.png": (_field, tables["samples"]), "trend.png": (_trend, tables["trend"]),
                "which.png": (_which, tables["causes"], tables["candidates"], summary) if gap else (),
                "how-far.png": (_far, summary, held)}
    for name, order in pictures.items():
        painter.draw(os.path.join(folder, name), _draw, *order)


def draw_map(image, folder):
    """image: the gap map, with the arrays Gap and GapAfter."""
    width, height, _ = image.GetDimensions()
    arrays = [image.GetPointData().GetArray(name) for name in ("Gap", "GapAfter")]
    step = -(-max(width, height) // _MOST_PIXELS_OF_A_SIDE)
    before, after = (vtk_to_numpy(array).reshape(height, width, -1)[::step, ::step] for array in arrays)
    names = [_channel_name(image, arrays[0], channel) for channel in range(before.shape[2])]
    painter.draw(os.path.join(folder, "gap-map.png"), _draw, _gap_map, before, after, names, height / width)


def _draw(path, function=None, *arguments):
    """function gives the figure, or None where there is nothing to show."""
    global matplotlib, pyplot, Normalize
    # Only who draws loads it: it takes longer than a short diagnosis.
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    from matplotlib.colors import Normalize
    with pyplot.rc_context(_STYLE):
        _save(function(*arguments) if function else None, path)


def _save(figure, path):
    if figure is not None:
        with outputs.written(path, outputs.END_OF_PNG) as part:
            figure.savefig(part, format="png", metadata={"Software": None})
        pyplot.close(figure)
    else:
        outputs.remove(path)


def drawn(folder):
    painter.finish()
    return [name for name in NAMES if os.path.exists(os.path.join(folder, name))]


def _axes(where):
    axes = [row for row in where if not row["cell"]]
    if not axes:
        return None
    figure, plot = pyplot.subplots(figsize=(8, 0.5 + 0.42 * len(axes)))
    plot.barh([row["axis"].replace("_", " ") for row in axes], [row["share"] for row in axes],
              color=_BEFORE)
    plot.invert_yaxis()
    plot.set_xlim(0, 1)
    plot.xaxis.set_major_formatter(matplotlib.ticker.PercentFormatter(1.0))
    plot.set_xlabel("Share of the gap's energy")
    plot.grid(axis="x", color="#E0E0E0")
    return figure


def _pivot(rows, value):
    """Groups x channels."""
    matrix = {}
    for row in rows:
        matrix.setdefault(row["column"], {})[row["row"]] = row[value]
    return [[cells[k] for k in sorted(cells)] for _, cells in sorted(matrix.items())]


def _heat_maps(rows, summary):
    if not rows:
        return None
    groups = [next(row for row in rows if row["column"] == column)
              for column in sorted({row["column"] for row in rows})]
    channels = [next(row for row in rows if row["row"] == number)["channel"]
                for number in sorted({row["row"] for row in rows})]
    apart = -(-len(channels) // _MOST_CHANNEL_NAMES)
    limit = max(abs(row["mean_before"]) for row in rows if row["mean_before"] == row["mean_before"])
    top = max(row["rms_before"] for row in rows if row["rms_before"] == row["rms_before"])
    panels = (("mean_before", "Mean gap (real - simulated)", "PuOr", Normalize(-limit, limit)),
              ("rms_before", "rms before", "viridis", Normalize(0, top)),
              ("rms_after", "rms after the correction", "viridis", Normalize(0, top)))
    figure, plots = pyplot.subplots(1, 3, sharey=True, layout="constrained",
                                    figsize=(13.5, 1.9 + 0.27 * len(groups)))
    for plot, (value, title, colors, norm) in zip(plots, panels):
        image = plot.imshow(_pivot(rows, value), aspect="auto", cmap=colors, norm=norm,
                            interpolation="nearest")
        plot.set_title(title, fontsize=12)
        plot.set_xticks(range(0, len(channels), apart), channels[::apart], rotation=90, fontsize=8)
        for number in range(1, len(groups)):
            if groups[number]["kind"] != groups[number - 1]["kind"]:
                plot.axhline(number - 0.5, color="white", linewidth=4)
        bar = figure.colorbar(image, ax=plot, orientation="horizontal", shrink=0.9)
        bar.ax.tick_params(labelsize=8)
        if value != "mean_before":
            bar.ax.axvline(summary["noise_floor"], color="white", linewidth=2)
            bar.set_label("response, 1 = white; white line: noise alone", fontsize=9)
        else:
            bar.set_label("response, 1 = white", fontsize=9)
    plots[0].set_yticks(range(len(groups)), [_group_name(group) for group in groups], fontsize=9)
    return figure


def _group_name(group):
    name = group["group"]
    return f"{group['kind']} {name}" if group["kind"] in ("medium", "scene") else name


def _field(samples):
    placed = [row for row in samples if _number(row.get("x")) and _number(row.get("y"))
              and _number(row["gap_before"])]
    if len({(row["x"], row["y"]) for row in placed}) < 4:
        return None
    scenes = list(dict.fromkeys(row.get("scene", "") for row in placed))
    if len(scenes) > _MOST_SCENES:
        scenes = [None]  # one over the other
    limit = max(abs(row["gap_before"]) for row in placed)
    figure, plots = pyplot.subplots(len(scenes), 2, sharex=True, sharey=True, squeeze=False,
                                    layout="compressed", figsize=(11, 4.2 * len(scenes)))
    for scene, line in zip(scenes, plots):
        shown = [row for row in placed if scene is None or row.get("scene", "") == scene]
        for plot, value, title in zip(line, ("gap_before", "gap_after"), ("before", "after")):
            points = plot.scatter([row["x"] for row in shown], [row["y"] for row in shown],
                                  c=[row[value] for row in shown], cmap="PuOr",
                                  norm=Normalize(-limit, limit), s=55, edgecolors="#606060",
                                  linewidths=0.4)
            plot.set_title(f"{scene}, {title}" if scene else title.capitalize(), fontsize=12)
            plot.set_aspect("equal")
    plots[0][0].invert_yaxis()
    for plot in plots[-1]:
        plot.set_xlabel("x")
    for line in plots:
        line[0].set_ylabel("y (downwards, as in an image)", fontsize=9)
    bar = figure.colorbar(points, ax=plots, format=matplotlib.ticker.PercentFormatter(1.0))
    bar.set_label("Gap relative to the simulated response")
    return figure


def _gap_map(before, after, names, shape):
    """Line by line six channels, the gap before above the gap after. shape: the image's height over its width."""
    channels = before.shape[2]
    shown = sorted(set(numpy.linspace(0, channels - 1, _MOST_CHANNELS).astype(int)))
    limit = float(numpy.nanpercentile(numpy.abs(before), 99)) or 1e-6
    lines = -(-len(shown) // _CHANNELS_IN_A_LINE)
    across = -(-len(shown) // lines)
    tall = min(max(shape, 0.4), 1.6)
    figure, plots = pyplot.subplots(2 * lines, across, squeeze=False, layout="compressed", sharex=True,
                                    sharey=True, figsize=(2.2 * across + 1, 2 * lines * (2.2 * tall + 0.35)))
    for plot in plots.flat:
        plot.set_axis_off()
    for number, channel in enumerate(shown):
        line, place = divmod(number, across)
        for row, values, when in ((2 * line, before, "before"), (2 * line + 1, after, "after")):
            plot = plots[row][place]
            plot.set_axis_on()
            drawn = plot.imshow(values[:, :, channel], origin="lower", cmap="PuOr",
                                norm=Normalize(-limit, limit), interpolation="antialiased")
            plot.set_title(f"{names[channel]}, {when}", fontsize=11)
            plot.set_xticks([])
            plot.set_yticks([])
            plot.set_facecolor("#D8D8D8")  # no value
            for side in plot.spines.values():
                side.set_visible(False)
    bar = figure.colorbar(drawn, ax=plots, shrink=0.9 if lines == 1 else 0.4)
    bar.set_label("real - simulated (1 = white)\ncolors end at the 99th percentile; grey: no value", fontsize=9)
    return figure


def _channel_name(image, array, channel):
    wavelengths = image.GetFieldData().GetArray("Wavelength")
    if wavelengths and wavelengths.GetNumberOfTuples() == array.GetNumberOfComponents():
        return f"{wavelengths.GetValue(channel):g} nm"
    return array.GetComponentName(channel) or f"channel {channel + 1}"


def _trend(rows):
    if len(rows) < 3:
        return None
    figure, plot = pyplot.subplots(figsize=(11, 4))
    order = [row["order"] for row in rows]
    plot.axhline(0, color="#808080", linewidth=0.8)
    plot.plot(order, [row["gap_before"] for row in rows], ".", color=_BEFORE, label="before")
    plot.plot(order, [row["gap_after"] for row in rows], ".", color=_AFTER, label="after")
    plot.plot(order, [row["level"] for row in rows], color="black",
              label="line through before, between change points")
    plot.yaxis.set_major_formatter(matplotlib.ticker.PercentFormatter(1.0))
    plot.set_xlabel("Capture order")
    plot.set_ylabel("Gap relative to the simulated response")
    plot.grid(color="#E8E8E8")
    plot.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, 1.14), ncols=3)
    return figure


def _which(causes, candidates, summary):
    """Above: the causes, each with what the data cannot tell from it. Below: each effect alone."""
    causes = list({row["rank"]: row for row in causes}.values())
    found = [entry for row in causes
             for entry in [(row, "")] + [(None, title) for title in row["equivalent_title"].split(", ") if title]]
    candidates = candidates[:_MOST_LABELS]
    if not found and not candidates:
        return None
    heights = [0.4 * (len(found) + 1) + 0.4, 0.36 * max(len(candidates), 1) + 0.4]
    figure, (above, below) = pyplot.subplots(2, 1, layout="constrained", height_ratios=heights,
                                             figsize=(10, sum(heights) + 1.2))
    _causes(above, found, summary["unexplained_share"])
    _candidates(below, candidates)
    for plot in (above, below):
        plot.invert_yaxis()
        plot.xaxis.set_major_formatter(matplotlib.ticker.PercentFormatter(1.0))
        plot.grid(axis="x", color="#E8E8E8")
    return figure


def _label(row):
    return row["title"] + (f" ({row['medium']})" if row["medium"] else "")


def _causes(plot, found, left):
    plot.set_title("The causes together" if found else "No cause was found", fontsize=12, loc="left")
    share, first = 0.0, 0
    for place, (cause, _) in enumerate(found):
        if cause:
            share, first = cause["share"], place
            likely = cause["probability"] >= LIKELY
            plot.barh(place, share, color=_AFTER if likely else _DOUBTED)
            inside = share > 0.7
            plot.text(share, place, f" {100 * share:.0f} %, probability {100 * cause['probability']:.0f} % ", va="center",
                      ha="right" if inside else "left",
                      color="white" if inside and likely else "black")
        else:
            plot.barh(place, share, facecolor="white", edgecolor=_PLAIN, hatch="//")
        if place + 1 == len(found) or found[place + 1][0]:
            if place > first:
                _bracket(plot, first, place)
    plot.barh(len(found), left, color=_PLAIN)
    plot.text(left, len(found), f" {100 * left:.0f} %", va="center", clip_on=False)
    plot.set_yticks(range(len(found) + 1), [*(_label(cause) if cause else f"or {name}"
                                              for cause, name in found), "not explained"])
    plot.set_xlim(0, 1)
    plot.set_xlabel("Share of the gap; pale: less likely than not; hatched: does as well in the cause's place")


def _candidates(plot, rows):
    plot.set_title("Each effect alone", fontsize=12, loc="left")
    for place, row in enumerate(rows):
        color = _AFTER if row["cause"] else _PLAIN
        plot.hlines(place, row["shrink_low"], row["shrink_high"], color=color, linewidth=3)
        plot.plot(row["shrink"], place, "o", markersize=9, color=color,
                  markerfacecolor=color if row["cause"] else "white", markeredgewidth=2)
    plot.set_yticks(range(len(rows)), [_label(row) for row in rows])
    plot.set_ylim(-0.6, len(rows) - 0.4)
    plot.set_xlim(min([-0.05] + [row["shrink_low"] for row in rows]), 1.02)
    plot.axvline(0, color="#808080", linewidth=0.8)
    plot.set_xlabel("How far it shrinks the gap, with the 95 % interval; filled: one of the causes")


def _bracket(plot, first, last):
    """To the right of the chart, from one row to another."""
    across = plot.get_yaxis_transform()
    plot.plot([1.01, 1.025, 1.025, 1.01], [first, first, last, last], color="black", clip_on=False,
              transform=across, linewidth=1.5)
    plot.text(1.035, first, "cannot be\ntold apart", transform=across, va="top", fontsize=9)


def _far(summary, held):
    bars = (("before", "rms_before", _BEFORE), ("after", "rms_after", _AFTER),
            ("noise alone", "noise_floor", _FLOOR))
    figure, plot = pyplot.subplots(figsize=(9, 2.4))
    for name, key, color in bars:
        plot.barh(name, summary[key], color=color)
        plot.text(summary[key], name, f" {summary[key]:.4f}", va="center")
    plot.invert_yaxis()
    plot.set_xlabel(f"rms of the gap on {held} held out (response, 1 = white)")
    if summary["verdict"] != "no gap":
        plot.set_title(f"Shrink {100 * summary['shrink']:.0f} % (95 % interval "
                       f"{100 * summary['shrink_low']:.0f} to {100 * summary['shrink_high']:.0f} %)",
                       fontsize=12, loc="left")
    return figure


def _number(value):
    return isinstance(value, (int, float)) and value == value
