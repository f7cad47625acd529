"""A photograph of a color chart as a sample table: the chart is searched for, or given by its four corners."""

import argparse
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import command, frames  # noqa: E402

# Columns and rows.
CHARTS = {"colorchecker": (6, 4), "colorchecker-sg": (14, 10), "colorchecker-passport": (6, 4)}


def chart(text):
    if text in CHARTS:
        return CHARTS[text]
    match = re.fullmatch(r"([1-9]\d{0,2})[xX]([1-9]\d{0,2})", text)
    if not match:
        raise argparse.ArgumentTypeError(
            f"'{text}' is no chart; expected {', '.join(CHARTS)} or ROWSxCOLUMNS, such as 4x6")
    return int(match.group(2)), int(match.group(1))


def corner(text):
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is no corner; expected X,Y in pixels from the top left") from None
    return x, y


def arguments():
    parser = command.parser(
        "chart", __doc__,
        "--image channel_*.tif --white white/*.tif --dark dark/*.tif --chart colorchecker --reference chart.cie",
        "--image cube.hdr --chart 10x14 --reference sg.csv --corners 120,80 900,95 890,640 110,610")
    frames.add_options(parser)
    parser.add_argument("--chart", metavar="NAME|ROWSxCOLUMNS", type=chart, required=True,
                        help=f"the chart: {', '.join(CHARTS)}, or rows x columns such as 4x6")
    parser.add_argument("--reference", metavar="FILE", required=True,
                        help="measured reflectance of the chart, one row per patch (CSV, CGATS, CxF)")
    parser.add_argument("--corners", metavar="X,Y", nargs=4, type=corner,
                        help="outer corners of the patches in pixels from the top left: first patch, end of the first "
                             "row, last patch, start of the last row (default: the chart is searched for)")
    parser.add_argument("--fraction", metavar="F", type=float, default=0.5,
                        help="part of a patch's cell that is sampled, around its middle (default: %(default)s)")
    options = parser.parse_args()
    frames.check(parser, options)
    if not 0.01 <= options.fraction <= 1.0:
        parser.error(f"--fraction {options.fraction}: expected 0.01 to 1")
    return options


OPTIONS = arguments()  # before ParaView is loaded

from support import estimation, outputs, pictures, pipeline, report  # noqa: E402


def find(options, image, reference):
    columns, rows = options.chart
    placement = {}
    if options.corners:
        height = pictures.size(image)[1]
        placement = {"Placement": "Corners"}
        for i, (x, y) in enumerate(options.corners):  # ParaView counts rows from the bottom
            placement[f"Corner{i + 1}"] = [x, height - 1 - y, 0.0]
    found = pipeline.create("ChartFinder", Input=image, Reference=reference, GridColumns=columns, GridRows=rows,
                            PatchFraction=options.fraction, **placement)
    pipeline.update(found)
    return found


def say_what_was_found(options, found, samples):
    """One line about the placement, one about patches that cannot be trusted; the text of the report."""
    names, (values,) = pipeline.table(pipeline.port(found, 2)) if command.rank() == 0 else ((), ((),))
    placement = dict(zip(names, values))
    lines = []
    if options.corners:
        lines.append("The chart was placed by its corners.")
    elif placement:
        columns, rows = options.chart
        lines.append(f"The chart was found: {placement['patches seen']:.0f} of {columns * rows} patches seen, correlation "
                     f"with the reference {placement['agreement']:.3f} (next best placement "
                     f"{placement['second agreement']:.3f}).")
    names, rows = pipeline.table(samples)
    if rows:
        marked = [(row[names.index("label")], row[names.index("note")]) for row in rows if row[names.index("note")]]
        lines.append("Patches to check: " + ", ".join(f"{label} ({note})" for label, note in marked) + "." if marked
                     else "No patch is clipped or uneven.")
    for line in lines:
        command.say(line)
    return lines


def main():
    options = OPTIONS
    outputs.require_files(*frames.files(options), options.reference)
    folder = outputs.claim(options.output, ("chart.csv", "labels.png", "overlay.png", "report.html"))
    pipeline.load_plugin()
    image = frames.responses(options)
    reference = pipeline.create("SampleTableReader", FileName=options.reference)
    pipeline.update(image, reference)
    found = find(options, image, reference)
    samples = pipeline.create("PatchSampler", Input=image, Labels=pipeline.port(found, 0),
                              PatchTable=pipeline.port(found, 1))
    pipeline.update(samples)
    estimation.check_samples(samples, "the chart")
    pipeline.save_table(samples, os.path.join(folder, "chart.csv"))
    pipeline.save_png(found, "Label", os.path.join(folder, "labels.png"))
    pipeline.save_png(found, "Overlay", os.path.join(folder, "overlay.png"))
    lines = say_what_was_found(options, found, samples)
    caption = "Outlines: green; red: clipped; orange: spots or uneven light. The first patch has a yellow middle."
    if not options.white:
        caption += " No white frame was given: the colors are those of the lamp and the filters, too."
    report.write(folder, "A chart in an image", [
        report.pictures("The patches", folder, {"overlay.png": caption}),
        report.table("Patches", *pipeline.table(pipeline.port(found, 1)),
                     columns=patch_columns(pipeline.table(pipeline.port(found, 1))[0]))], " ".join(lines), pipeline.warnings)
    command.say(f"chart.csv, labels.png, overlay.png and report.html: {folder}")


def patch_columns(names):
    return [name for name in ("label", "sample", "clipped", "outliers", "slope", "note") if name in names]


command.run(main)
