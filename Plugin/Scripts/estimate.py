"""Reflectance image, RGB view and error maps from a multispectral image."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import colors, command, frames, methods  # noqa: E402


def arguments():
    parser = command.parser(
        "estimate", __doc__,
        "--image channel_*.tif --calibration chart.csv --tuning swatches.csv",
        "--image cube.hdr --labels labels.png --patches patches.csv --ranks 4",
        "--image raw.hdr --white white.hdr --dark dark.hdr --calibration chart.csv")
    group = frames.add_options(parser)
    parser.add_argument("--calibration", metavar="FILE",
                        help="sample table of the chart: reflectance and camera responses")
    parser.add_argument("--tuning", metavar="FILE",
                        help="sample table of a few samples of the imaged medium")
    parser.add_argument("--labels", metavar="FILE", help="label image of the patches in the image")
    parser.add_argument("--patches", metavar="FILE",
                        help="measured reflectance of the patches, with the column 'label'")
    parser.add_argument("--method", choices=methods.NAMES, default="transfer",
                        help="how tuning samples are used (default: %(default)s)")
    group.add_argument("--register", metavar="FILE", nargs="?", const="",
                       help="the channels are shifted against each other: find by how much, and move them; "
                            "FILE: displacements.csv of an earlier run, best of a chart")
    group.add_argument("--trust-responses", action="store_true",
                       help="estimate also an image whose responses look like raw counts beside the calibration's; "
                            "else that is an error")
    results = parser.add_argument_group("results")
    colors.add_options(results, lights_pictures=True)
    results.add_argument("--cube", choices=("exr", "envi"), default="exr",
                         help="format of the reflectance image (default: %(default)s)")
    options = parser.parse_args()
    frames.check(parser, options)
    if (options.labels is None) != (options.patches is None):
        parser.error("--labels and --patches go together")
    if options.calibration is None and options.labels is None:
        parser.error("give --calibration, or --labels and --patches to calibrate on the image")
    if options.tuning is not None and options.calibration is None:
        parser.error("--tuning goes with --calibration")
    return options


OPTIONS = arguments()  # before ParaView is loaded

from support import estimation, outputs, pictures, pipeline, report, state  # noqa: E402


def require_inputs(options):
    singles = [options.calibration, options.tuning, options.labels, options.patches, options.register or None]
    outputs.require_files(*frames.files(options), *singles, *colors.files(options))


def read_tables(options):
    def table(path):
        return pipeline.create("SampleTableReader", FileName=path) if path else None
    tables = table(options.calibration), table(options.tuning), table(options.patches)
    pipeline.update(*[t for t in tables if t])
    return tables


def responses(options, stride=1, displacements=None):
    """The image with its frames, registered where there are displacements, which nothing has read yet."""
    return estimation.registered(frames.responses(options, stride), displacements)


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


def show_chart_alone(options, calibration, view, judged_by, displacements, viewed, folder):
    """What the correction is compared with: pictures of the image with the chart's calibration alone. view: every how many pixels are
    shown, and their labels; judged_by: labels and patches. Returns its errors at the patches; None without them."""
    transforms, _ = estimation.correction(calibration, None, "Direct")

    def estimate(stride):
        return pipeline.create("ReflectanceEstimation", Input=responses(options, stride, displacements), TrustResponses=1, **transforms)
    stride, labels = view
    shown = estimate(stride)
    estimation.save_view(shown, folder, colors=viewed, name="chart-alone.png")
    if labels is None:
        return None
    errors = estimation.error_maps(shown, labels, judged_by[1], viewed.of_errors())
    pipeline.update(errors)
    pictures.image(errors, viewed.error_arrays()[1], os.path.join(folder, "error-chart-alone.png"),
                   value_range=(0.0, pictures.DIFFERENCES[-1]))
    return estimation.patch_errors(estimate(1), *judged_by, viewed.of_errors())


def summarize(options, viewed, judged, alone, outside, missing):
    """The result in one sentence, and what is known of the pixels' responses. alone: the errors without the correction, or None."""
    range_text = "It is not known which responses the transform was fitted on." if outside is None else \
        f"{100.0 * outside:.1f} % of the pixels have responses outside of the range of the fitted samples."
    if missing > 0.0:
        range_text += f" {100.0 * missing:.1f} % of the pixels have no result (dead, saturated or missing values)."
    color = viewed.metric, viewed.illuminants[0]
    means = judged and [estimation.mean_of(judged.patches, *what) for what in (color, ("rms",))]
    before = alone and estimation.mean_of(alone, *color)
    if means is None or command.rank() != 0:
        how = f"corrected by the method {options.method}" if options.tuning else "estimated with the chart's calibration alone"
        return (f"The reflectance of the image was {how}; its error is not known, because no measured patches were given (--labels and "
                f"--patches). {range_text}"), range_text
    (mean, largest, count), (rms, _, _) = means
    against = f", against {before[0]:.2f} with the chart's calibration alone" if before else ""
    return (f"The {count} held-out patches differ from their measurement by {viewed.label} {mean:.2f} on average{against} "
            f"({viewed.text}; largest {largest:.2f}); spectral rms {rms:.4f}. {range_text}"), range_text


# All that it writes into the output folder.
WRITES = (
    "reflectance-transform.csv", "metamerism-transform.csv", "reflectance.exr", "reflectance.img", "reflectance.hdr",
    "rgb.png", "srgb.png", "chart-alone.png", "error-chart-alone.png", "out-of-range.png", "uncertainty.png", "error-rms.png",
    "error-dE*.png", "error-maps.img", "error-maps.hdr", "errors-of-pixels.csv", "errors-of-patches.csv",
    "patches.csv", "displacements.csv", "state.pvsm", "report.html")


def main():
    options = OPTIONS
    require_inputs(options)
    folder = outputs.claim(options.output, WRITES)
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
        estimation.check_samples(sampled, "the patches in the image", calibration)
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
    is_corrected = tuning is not None and options.method != "direct"
    alone = show_chart_alone(options, calibration, (stride, view[1]), (labels, held_out), displacements, viewed, folder) \
        if is_corrected else None
    before = {"chart-alone.png": "With the chart's calibration alone"} if is_corrected else {}
    first = {**before, "rgb.png": f"{'Corrected' if is_corrected else 'Estimated'}: the colors under {viewed.text}; srgb.png has them at "
                                  "the image's own size"}
    judged, pages = None, []
    if labels is not None:
        judged = estimation.judge(reflectance, labels, held_out, folder, view=view, colors=viewed)
        estimation.print_summary("Held-out patches, mean spectrum of each",
                                 pipeline.port(judged.patches, 1))
        estimation.print_summary("Held-out pixels", judged.summary)
        map_of_colors = judged.arrays[1]
        if is_corrected:
            first.update({"error-chart-alone.png": f"Its errors at the held-out patches ({report.in_words(map_of_colors)})",
                          os.path.basename(estimation.error_picture(folder, map_of_colors)): "Its errors, on the same scale"})
        pages = estimation.report_errors(judged, folder, [map_of_colors] if is_corrected else [])
    pages = [report.pictures("Before and after" if is_corrected else "Reflectance", folder, first), *pages,
             estimation.save_quality(judged_image, folder), report.table("The fit", *pipeline.table(summary))]
    if displacements is not None:
        pages.append(report.table("How the channels lay beside one another, in pixels and degrees",
                                  *pipeline.table(displacements)))
    estimation.save_state(os.path.join(folder, "state.pvsm"), view[0], judged, viewed)
    lead, range_text = summarize(options, viewed, judged, alone, outside, missing)
    command.say(range_text)
    report.write(folder, "Spectral reflectance of an image", pages, lead, pipeline.warnings)
    state.finish()
    command.say(f"report, pictures and tables: {os.path.join(folder, 'report.html')}")


command.run(main)
