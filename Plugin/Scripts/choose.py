"""Chooses which samples of a medium to measure next, from their camera responses alone."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import command  # noqa: E402


def arguments():
    parser = command.parser("choose", __doc__, "--calibration chart.csv --candidates swatches.csv --count 8",
                            "--calibration chart.csv --image book_*.tif --labels labels.png --white white_*.tif --dark dark_*.tif")
    parser.add_argument("--calibration", metavar="FILE", required=True,
                        help="sample table of the chart: camera responses")
    parser.add_argument("--candidates", metavar="FILE",
                        help="sample table of the medium: camera responses, no reflectance needed")
    parser.add_argument("--count", metavar="N", type=command.whole_number(1), default=8,
                        help="samples to choose (default: %(default)s)")
    book = parser.add_argument_group("an image of the swatches in place of --candidates")
    book.add_argument("--image", metavar="FILE", nargs="+", help="one file, or one file per channel")
    book.add_argument("--labels", metavar="FILE", help="label image of the swatches; 'chart' makes one of a regular grid")
    book.add_argument("--white", metavar="FILE", nargs="+", help="white reference, like --image")
    book.add_argument("--dark", metavar="FILE", nargs="+", help="dark frame, like --image")
    book.add_argument("--wavelengths", metavar="NM", nargs="+", type=float,
                      help="wavelengths of the image's channels in nm; overrides those in the files")
    options = parser.parse_args()
    if (options.candidates is None) == (options.image is None):
        parser.error("give --candidates, or --image with --labels")
    if (options.image is None) != (options.labels is None):
        parser.error("--image and --labels go together")
    if options.image is None and (options.white or options.dark or options.wavelengths):
        parser.error("--white, --dark and --wavelengths go with --image")
    return options


OPTIONS = arguments()  # before ParaView is loaded

from support import estimation, pipeline  # noqa: E402


def candidates_of(options):
    """A table with the responses of what may be measured."""
    if options.candidates:
        return pipeline.create("SampleTableReader", FileName=options.candidates)

    def read(files):
        return estimation.read_image(files, options.wavelengths) if files else None
    image = estimation.flat_field(read(options.image), read(options.white), read(options.dark))
    return pipeline.create("PatchSampler", Input=image, Labels=estimation.read_labels(options.labels))


def main():
    options = OPTIONS
    command.require_files(options.calibration, options.candidates, options.labels, *(options.image or []),
                          *(options.white or []), *(options.dark or []))
    folder = command.make_folder(options.output, ("choice.csv",))
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
    command.say("(explained: share of the expected squared error over all candidates that measuring this sample and "
                "those before it takes away)")
    command.say(f"choice: {path}")


command.run(main)
