"""Chooses which samples of a medium to measure next, from their camera responses alone."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import command, frames  # noqa: E402


def arguments():
    parser = command.parser("choose", __doc__, "--calibration chart.csv --candidates swatches.csv --count 8",
                            "--calibration chart.csv --image book_*.tif --labels labels.png --white white_*.tif --dark dark_*.tif")
    parser.add_argument("--calibration", metavar="FILE", required=True,
                        help="sample table of the chart: camera responses")
    parser.add_argument("--candidates", metavar="FILE",
                        help="sample table of the medium: camera responses, no reflectance needed")
    parser.add_argument("--count", metavar="N", type=command.whole_number(1), default=8,
                        help="samples to choose (default: %(default)s)")
    parser.add_argument("--labels", metavar="FILE", help="label image of the swatches in --image, which replaces "
                        "--candidates; 'chart' makes one of a regular grid")
    frames.add_options(parser, required=False)
    options = parser.parse_args()
    if (options.candidates is None) == (options.image is None):
        parser.error("give --candidates, or --image with --labels")
    if (options.image is None) != (options.labels is None):
        parser.error("--image and --labels go together")
    frames.check(parser, options)
    return options


OPTIONS = arguments()  # before ParaView is loaded

from support import estimation, outputs, pipeline, report  # noqa: E402


def candidates_of(options):
    """A table with the responses of what may be measured."""
    if options.candidates:
        return pipeline.create("SampleTableReader", FileName=options.candidates)
    return pipeline.create("PatchSampler", Input=frames.responses(options), Labels=estimation.read_labels(options.labels))


def main():
    options = OPTIONS
    outputs.require_files(options.calibration, options.candidates, options.labels, *frames.files(options))
    folder = outputs.claim(options.output, ("choice.csv", "report.html"))
    pipeline.load_plugin()
    chart, candidates = pipeline.create("SampleTableReader", FileName=options.calibration), candidates_of(options)
    pipeline.update(chart, candidates)
    choice = pipeline.create("SampleChoice", Calibration=chart, Candidates=candidates, Count=options.count)
    pipeline.update(choice)
    path = os.path.join(folder, "choice.csv")
    pipeline.save_table(choice, path)
    names, rows = pipeline.table(choice)
    called = next((name for name in ("sample", "label") if name in names), None)
    command.say("rank  explained" + (f"  {called}" if called else ""))
    for row in rows:
        cell = row[names.index(called)] if called else ""
        label = f"  {cell:.0f}" if isinstance(cell, float) else f"  {cell}".rstrip()
        command.say(f"{row[names.index('rank')]:4.0f}  {100 * row[names.index('explained')]:7.1f} %{label}")
    command.say("(explained: share of the expected error over all candidates that measuring this sample and "
                "those before it takes away)")
    shown = [[row[names.index("rank")], str(row[names.index(called)]) if called else "", f"{100 * row[names.index('explained')]:.1f} %"]
             for row in rows]
    report.write(folder, "Which samples to measure", [
        report.table("In this order", ["rank", "sample", "explained together with those above"], shown, fold=False,
                     note="Explained: share of the expected error over all candidates that measuring the samples takes away. "
                          "It comes from the camera responses alone.")],
        f"Measure {'this 1 sample: it explains' if len(rows) == 1 else f'these {len(rows)} samples: together they explain'} {shown[-1][2]} "
        "of the expected error over all candidates." if rows else "", pipeline.warnings)
    command.say(f"choice and report.html: {folder}")


command.run(main)
