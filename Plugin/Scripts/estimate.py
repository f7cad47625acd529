"""Reflectance image, RGB view and error maps from a multispectral image."""

import argparse
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import colors, command, methods  # noqa: E402


def number(least, most=math.inf):
    """Above 'least' (or 'least' itself where there is an upper bound), at most 'most'."""
    def parse(text):
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not (least < value <= most or (value == least and most < math.inf)) or math.isinf(value):
            bounds = f"a number from {least:g} to {most:g}" if most < math.inf else f"a number above {least:g}"
            raise argparse.ArgumentTypeError(f"'{text}' is not {bounds}")
        return value
    return parse


def arguments():
    parser = command.parser(
        "estimate", __doc__,
        "--image channel_*.tif --calibration chart.csv --tuning swatches.csv",
        "--image cube.hdr --labels labels.png --patches patches.csv --ranks 4",
        "--image raw.hdr --white white.hdr --dark dark.hdr --calibration chart.csv")
    parser.add_argument("--image", metavar="FILE", nargs="+", required=True,
                        help="the image: one file, or one file per channel")
    parser.add_argument("--calibration", metavar="FILE",
                        help="sample table of the chart: reflectance and camera responses")
    parser.add_argument("--tuning", metavar="FILE",
                        help="sample table of a few samples of the imaged medium")
    parser.add_argument("--white", metavar="FILE", nargs="+", help="white reference, like --image")
    parser.add_argument("--dark", metavar="FILE", nargs="+", help="dark frame, like --image")
    parser.add_argument("--labels", metavar="FILE", help="label image of the patches in the image")
    parser.add_argument("--patches", metavar="FILE",
                        help="measured reflectance of the patches, with the column 'label'")
    parser.add_argument("--method", choices=methods.NAMES, default="transfer",
                        help="how tuning samples are used (default: %(default)s)")
    parser.add_argument("--wavelengths", metavar="NM", nargs="+", type=float,
                        help="wavelengths of the image's channels in nm; overrides those in the files")
    frames = parser.add_argument_group("how the image was taken")
    frames.add_argument("--white-reflectance", metavar="FACTOR", type=number(0.001, 2.0),
                        help="reflectance factor of the white reference (default: 1)")
    frames.add_argument("--white-level", metavar="COUNTS", type=number(0.0),
                        help="level of white where there is no --white (default: 1)")
    frames.add_argument("--saturation", metavar="COUNTS", type=number(0.0),
                        help="raw and white values from this level on are saturated: their pixels become NaN")
    frames.add_argument("--exposure", metavar="T", nargs="+", type=number(0.0),
                        help="exposure times of the image: one, or one per channel; with --white-exposure")
    frames.add_argument("--white-exposure", metavar="T", nargs="+", type=number(0.0),
                        help="exposure times of the white reference, in the same unit")
    frames.add_argument("--register", metavar="FILE", nargs="?", const="",
                        help="the channels are shifted against each other: find by how much, and move them; "
                             "FILE: displacements.csv of an earlier run, best of a chart")
    frames.add_argument("--trust-responses", action="store_true",
                        help="estimate also an image whose responses look like raw counts beside the calibration's; "
                             "else that is an error")
    results = parser.add_argument_group("results")
    colors.add_options(results, lights_pictures=True)
    results.add_argument("--cube", choices=("exr", "envi"), default="exr",
                         help="format of the reflectance image (default: %(default)s)")
    options = parser.parse_args()
    if (options.exposure is None) != (options.white_exposure is None):
        parser.error("--exposure and --white-exposure go together")
    if options.white_level is not None and options.white is not None:
        parser.error("--white-level is for images without --white")
    if (options.labels is None) != (options.patches is None):
        parser.error("--labels and --patches go together")
    if options.calibration is None and options.labels is None:
        parser.error("give --calibration, or --labels and --patches to calibrate on the image")
    if options.tuning is not None and options.calibration is None:
        parser.error("--tuning goes with --calibration")
    return options


OPTIONS = arguments()  # before ParaView is loaded

from support import estimation, pipeline, report, state  # noqa: E402


def require_inputs(options):
    lists = [options.image, options.white or [], options.dark or []]
    singles = [options.calibration, options.tuning, options.labels, options.patches, options.register or None]
    command.require_files(*[path for paths in lists for path in paths], *singles, *colors.files(options))


def read_tables(options):
    def table(path):
        return pipeline.create("SampleTableReader", FileName=path) if path else None
    tables = table(options.calibration), table(options.tuning), table(options.patches)
    pipeline.update(*[t for t in tables if t])
    return tables


def responses(options, stride=1, displacements=None):
    """The image with its frames, registered where there are displacements, which nothing has read yet."""
    def read(files):
        return estimation.read_image(files, options.wavelengths, stride) if files else None
    given = {"WhiteReflectance": options.white_reflectance, "WhiteLevel": options.white_level,
             "SaturationLevel": options.saturation, "ExposureTimes": options.exposure,
             "WhiteExposureTimes": options.white_exposure}
    image = estimation.flat_field(read(options.image), read(options.white), read(options.dark),
                                  **{name: value for name, value in given.items() if value is not None})
    return estimation.registered(image, displacements)


def find_displacements(options, folder):
    """The table of the channels' displacements, written where they are found; None where they are not asked for."""
    if options.register is None:
        return None
    if options.register:
        return pipeline.create("SampleTableReader", FileName=options.register)
    found = pipeline.create("ChannelDisplacement", Input=responses(options))
    pipeline.update(found)
    pipeline.save_table(found, os.path.join(folder, "displacements.csv"))
    return found


def summarize(options, viewed, judged, outside, missing):
    """The result in one sentence, and what is known of the pixels' responses."""
    range_text = "It is not known which responses the transform was fitted on." if outside is None else \
        f"{100.0 * outside:.1f} % of the pixels have responses outside of the range of the fitted samples."
    if missing > 0.0:
        range_text += f" {100.0 * missing:.1f} % of the pixels have no result (dead, saturated or missing values)."
    means = judged and [estimation.mean_of(judged, *what) for what in ((viewed.metric, viewed.illuminants[0]), ("rms",))]
    if means is None or command.rank() != 0:
        return f"Estimated with the method {options.method if options.tuning else 'calibration'}; {range_text}", range_text
    (mean, largest, count), (rms, _, _) = means
    return (f"{count} held-out patches: mean {viewed.label} {mean:.2f}, largest {largest:.2f} ({viewed.illuminants[0]}); "
            f"spectral rms {rms:.4f}. {range_text}"), range_text


# All that it writes into the output folder.
WRITES = (
    "reflectance-transform.csv", "metamerism-transform.csv", "reflectance.exr", "reflectance.img", "reflectance.hdr",
    "rgb.png", "srgb.png", "out-of-range.png", "uncertainty.png", "error-rms.png",
    "error-dE*.png", "error-maps.img", "error-maps.hdr", "errors-of-pixels.csv", "errors-of-patches.csv",
    "patches.csv", "displacements.csv", "state.pvsm", "report.html")


def main():
    options = OPTIONS
    require_inputs(options)
    folder = command.make_folder(options.output, WRITES)
    pipeline.load_plugin()
    viewed = colors.Colors(options)

    displacements = find_displacements(options, folder)
    image = responses(options, displacements=displacements)
    stride = estimation.stride_of_pictures(image)
    pipeline.fail_on_error()
    calibration, tuning, patches = read_tables(options)

    labels = held_out = None
    if options.labels:
        labels = estimation.read_labels(options.labels)
        sampled = pipeline.create("PatchSampler", Input=image, Labels=labels, PatchTable=patches)
        pipeline.update(sampled)
        held_out = sampled
        if calibration is None or tuning is None:
            # The patches in the image serve: every other one, the rest is held out.
            split = pipeline.create("SampleSplit", Input=sampled)
            pipeline.update(split)
            held_out = pipeline.port(split, 1)
            if calibration is None:
                calibration = pipeline.port(split, 0)
            else:
                tuning = pipeline.port(split, 0)

    transforms, summary = estimation.correction(calibration, tuning, methods.NAMES[options.method])
    judged_image, outside, missing = estimation.require_plausible(
        responses(options, estimation.stride_of_judgement(image), displacements), transforms, options.trust_responses)
    reflectance = estimation.estimate(image, transforms, folder, options.trust_responses)
    estimation.save_reflectance(reflectance, folder, options.cube)
    view = reflectance, labels
    if stride > 1:
        command.say(f"the pictures show every {stride}th pixel of the image")
        view = (pipeline.create("ReflectanceEstimation", Input=responses(options, stride, displacements),
                                TrustResponses=int(options.trust_responses), **transforms),
                labels and estimation.read_labels(options.labels, stride))
    estimation.save_view(view[0], folder, reflectance, viewed)
    pages = [report.pictures("Reflectance", folder, {
                 "rgb.png": f"The colors under {viewed.illuminants[0]}; srgb.png has them at the image's own size"}),
             estimation.save_quality(judged_image, folder),
             report.table("The fit", *pipeline.table(summary))]
    if displacements is not None:
        pages.append(report.table("How the channels lay beside one another, in pixels and degrees",
                                  *pipeline.table(displacements)))
    judged = None
    if labels is not None:
        judged = estimation.judge(reflectance, labels, held_out, folder, view=view, colors=viewed)
        estimation.print_summary("Held-out patches, mean spectrum of each",
                                 pipeline.port(judged.patches, 1))
        estimation.print_summary("Held-out pixels", judged.summary)
        pages += estimation.report_errors(judged, folder)
    estimation.save_state(os.path.join(folder, "state.pvsm"), view[0], judged, viewed)
    lead, range_text = summarize(options, viewed, judged, outside, missing)
    command.say(range_text)
    report.write(folder, "Spectral reflectance of an image", pages, lead, pipeline.warnings)
    state.finish()
    command.say(f"report, pictures and tables: {os.path.join(folder, 'report.html')}")


command.run(main)
