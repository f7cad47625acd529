"""Compares the estimation methods on two sample tables: random tuning samples, the rest held out."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import colors, command, methods  # noqa: E402


def arguments():
    parser = command.parser(
        "evaluate", __doc__,
        "--calibration chart.csv --target fabric.csv --tuning 16 --draws 20",
        "--calibration chart.csv --target fabric.csv --channels 9 --methods direct,transfer")
    parser.add_argument("--calibration", metavar="FILE", required=True,
                        help="sample table of the chart: reflectance and camera responses")
    parser.add_argument("--target", metavar="FILE", required=True,
                        help="sample table of the target medium")
    parser.add_argument("--channels", metavar="16|9", type=command.whole_number(1),
                        help="use all channels, or every second and the last (default: all)")
    parser.add_argument("--tuning", metavar="N", type=command.whole_number(2), default=16,
                        help="tuning samples a draw (default: %(default)s)")
    parser.add_argument("--draws", metavar="N", type=command.whole_number(1), default=10,
                        help="random choices of tuning samples (default: %(default)s)")
    parser.add_argument("--seed", metavar="N", type=command.whole_number(0), default=1,
                        help="seed of the choices (default: %(default)s)")
    parser.add_argument("--methods", metavar="LIST", default=",".join(methods.COMPARED),
                        help="methods, separated by commas, or all; known: " + ", ".join(methods.NAMES) +
                             " (default: %(default)s)")
    colors.add_options(parser)
    return parser.parse_args()


OPTIONS = arguments()  # before ParaView is loaded

from support import comparison, outputs, pipeline, report  # noqa: E402


# All that it writes into the output folder.
WRITES = (
    "results.csv", "draws.csv", "samples.csv", "pairs.csv", "rms-against-tuning.csv", "spectra.png", "rms-against-tuning.png",
    "ab-distribution.png", "report.html")


def main():
    options = OPTIONS
    outputs.require_files(options.calibration, options.target, *colors.files(options))
    folder = outputs.claim(options.output, WRITES)
    chosen = methods.chosen(options.methods)
    draws = f"{command.counted(options.draws, 'draw')} of {options.tuning} tuning samples"
    command.say(f"{command.counted(len(chosen), 'method')}, {draws}, the rest held out")
    pipeline.load_plugin()
    judged = colors.Colors(options)
    tables = [pipeline.create("SampleTableReader", FileName=path)
              for path in (options.calibration, options.target)]
    pipeline.update(*tables)
    tables = [comparison.select_channels(table, options.channels) for table in tables]
    names, rows, pairs = comparison.compare(*tables, folder=folder, methods=",".join(chosen), tuning=options.tuning,
                                            draws=options.draws, seed=options.seed, colors=judged)
    report.write(folder, "Methods compared", [
        report.pictures("In pictures", folder, {
            "spectra.png": "A typical held-out sample", "rms-against-tuning.png": "Error against the number of tuning samples; bands: 95 % intervals",
            "ab-distribution.png": "Where the three sets lie in a*b*"}),
        report.table("Errors of the held-out samples", *comparison.condensed(names, rows),
                     note=f"Mean / median / largest over the held-out samples, mean over {draws}; rms of reflectance factor, "
                          f"{judged.label}. "
                          + comparison.explained(names, rows)),
        report.table("Is the best method better?", *comparison.against_best(names, rows, pairs),
                     note="Ratio of the mean errors with its 95 % interval, and in how many held-out samples the error is "
                          "smaller. 'open': the interval holds 1. Intervals are about other draws of tuning samples and other "
                          "samples of the medium; all pairs of methods are in pairs.csv, the errors of every sample in "
                          "samples.csv.")],
        comparison.best(names, rows, judged), pipeline.warnings)
    command.say(f"report, results, draws and pictures: {os.path.join(folder, 'report.html')}")


command.run(main)
