"""Chooses which samples of a medium to measure next, from their camera responses alone."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import command  # noqa: E402


def arguments():
    parser = command.parser("choose", __doc__, "--calibration chart.csv --candidates swatches.csv --count 8")
    parser.add_argument("--calibration", metavar="FILE", required=True,
                        help="sample table of the chart: camera responses")
    parser.add_argument("--candidates", metavar="FILE", required=True,
                        help="sample table of the medium: camera responses, no reflectance needed")
    parser.add_argument("--count", metavar="N", type=command.whole_number(1), default=8,
                        help="samples to choose (default: %(default)s)")
    return parser.parse_args()


OPTIONS = arguments()  # before ParaView is loaded

from support import pipeline  # noqa: E402


def main():
    options = OPTIONS
    command.require_files(options.calibration, options.candidates)
    folder = command.make_folder(options.output, ("choice.csv",))
    pipeline.load_plugin()
    chart, candidates = [pipeline.create("SampleTableReader", FileName=path)
                         for path in (options.calibration, options.candidates)]
    pipeline.update(chart, candidates)
    choice = pipeline.create("SampleChoice", Calibration=chart, Candidates=candidates, Count=options.count)
    pipeline.update(choice)
    path = os.path.join(folder, "choice.csv")
    pipeline.save_table(choice, path)
    names, rows = pipeline.table(choice)
    name = names.index("sample") if "sample" in names else None
    command.say("rank  explained  sample" if name is not None else "rank  explained")
    for row in rows:
        label = f"  {row[name]}" if name is not None else ""
        command.say(f"{row[names.index('rank')]:4.0f}  {100 * row[names.index('explained')]:7.1f} %{label}")
    command.say("(explained: share of the expected squared error over all candidates that measuring this sample and "
                "those before it takes away)")
    command.say(f"choice: {path}")


command.run(main)
