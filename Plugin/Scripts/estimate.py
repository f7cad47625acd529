"""Reflectance image, RGB view and error maps from a multispectral image."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import command, methods  # noqa: E402

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
                        help="wavelengths of the image's channels, over what the files say")
    options = parser.parse_args()
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
    singles = [options.calibration, options.tuning, options.labels, options.patches]
    command.require_files(*[path for paths in lists for path in paths], *singles)


def read_tables(options):
    def table(path):
        return pipeline.create("SampleTableReader", FileName=path) if path else None
    tables = table(options.calibration), table(options.tuning), table(options.patches)
    pipeline.update(*[t for t in tables if t])
    return tables


def responses(options, stride=1):
    """The image with its frames, which nothing has read yet."""
    def read(files):
        return estimation.read_image(files, options.wavelengths, stride) if files else None
    return estimation.flat_field(read(options.image), read(options.white), read(options.dark))


# All that it writes into the output folder.
WRITES = (
    "reflectance-transform.csv", "metamerism-transform.csv", "reflectance.exr", "rgb.png", "error-rms.png",
    "error-dE00-*.png", "error-maps.img", "error-maps.hdr", "errors-of-pixels.csv", "errors-of-patches.csv",
    "patches.csv", "state.pvsm", "report.html")


def main():
    options = OPTIONS
    require_inputs(options)
    folder = command.make_folder(options.output, WRITES)
    pipeline.load_plugin()

    image = responses(options)
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
    estimation.require_plausible(responses(options, estimation.stride_of_judgement(image)), transforms)
    reflectance = estimation.estimate(image, transforms, folder)
    estimation.save_reflectance(reflectance, folder)
    view = reflectance, labels
    if stride > 1:
        command.say(f"the pictures show every {stride}th pixel of the image")
        view = (pipeline.create("ReflectanceEstimation", Input=responses(options, stride),
                                **transforms),
                labels and estimation.read_labels(options.labels, stride))
    estimation.save_view(view[0], folder)
    pages = [report.pictures("Reflectance", folder, {"rgb.png": "sRGB view under D65"}),
             report.table("The fit", *pipeline.table(summary))]
    judged = None
    if labels is not None:
        judged = estimation.judge(reflectance, labels, held_out, folder, view=view)
        estimation.print_summary("Held-out patches, mean spectrum of each",
                                 pipeline.port(judged.patches, 1))
        estimation.print_summary("Held-out pixels", judged.summary)
        pages += estimation.report_errors(judged, folder)
    estimation.save_state(os.path.join(folder, "state.pvsm"), view[0], judged)
    report.write(folder, "Spectral reflectance of an image", pages)
    state.finish()
    command.say(f"report, pictures and tables: {os.path.join(folder, 'report.html')}")


command.run(main)
