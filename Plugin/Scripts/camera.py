"""A camera simulated beside the real one: fitted to measured samples or read, with any set of effects."""

import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import command  # noqa: E402


def arguments():
    parser = command.parser(
        "camera", __doc__,
        "--samples chart.csv --fit",
        "--samples chart.csv --camera camera.json --effects effects.json",
        "--image channel_*.tif --labels labels.png --patches patches.csv --camera camera.csv --fit")
    parser.add_argument("--samples", metavar="FILE",
                        help="sample table: reflectance, and the real camera's responses where known")
    parser.add_argument("--image", metavar="FILE", nargs="+",
                        help="image of the real camera: one file, or one a channel")
    parser.add_argument("--scene", metavar="FILE",
                        help="reflectance image that the camera looks at, as `scene` writes it; instead of "
                             "--samples and --image")
    parser.add_argument("--medium", metavar="NAME", default="paper",
                        help="the scene's medium, for effects on one medium (default: %(default)s)")
    parser.add_argument("--seed", metavar="N", type=command.whole_number(0), default=1,
                        help="of the scene's noise (default: %(default)s)")
    parser.add_argument("--labels", metavar="FILE", help="label image of the patches in the image")
    parser.add_argument("--patches", metavar="FILE",
                        help="measured reflectance of the patches, with the column 'label'")
    parser.add_argument("--camera", metavar="FILE",
                        help="the camera as known or designed: description (.json) or curves (.csv)")
    parser.add_argument("--fit", action="store_true",
                        help="fit the camera to the samples; with --camera starting from it")
    parser.add_argument("--draws", metavar="N", type=command.whole_number(0), default=100,
                        help="bootstrap draws of the fit's uncertainty (default: %(default)s)")
    parser.add_argument("--detector-curve", action="store_true",
                        help="fit the camera behind the curve of its detector, where the samples show one")
    parser.add_argument("--effects", metavar="FILE",
                        help="list of effects (JSON) that the simulated camera has")
    options = parser.parse_args()
    if [options.samples, options.image, options.scene].count(None) != 2:
        parser.error("give one of --samples, --scene, and --image with --labels and --patches")
    if options.scene and (options.fit or not options.camera):
        parser.error("--scene needs --camera and cannot be fitted to")
    if options.image and not (options.labels and options.patches):
        parser.error("--image needs --labels and --patches")
    if not (options.fit or options.camera):
        parser.error("give --camera, --fit or both")
    if options.detector_curve and not options.fit:
        parser.error("--detector-curve needs --fit")
    return options


OPTIONS = arguments()  # before ParaView is loaded

import numpy  # noqa: E402

from support import cameras, estimation, outputs, pictures, pipeline, report  # noqa: E402


def look_at_scene(options, effects, folder):
    """Responses to a reflectance image, of the ideal camera and of the one with effects and noise, and their difference."""
    camera = cameras.read(options.camera)
    cameras.save(camera, os.path.join(folder, "camera.json"))
    scene = pipeline.create("SpectralImageReader", FileNames=[options.scene], ArrayKind="Reflectance", Preview=0)
    ideal = pipeline.create("CameraSimulator", Input=scene, Camera=camera, Effects="None (ideal camera)", Noise="None")
    seen = pipeline.create("CameraSimulator", Input=scene, Camera=camera, Media=options.medium, Seed=options.seed,
                           **effects)
    written = {name: os.path.join(folder, f"{name}.img") for name in ("ideal", "responses")}
    pipeline.save_image(ideal, written["ideal"], SpectralArray="Responses")
    pipeline.save_image(seen, written["responses"], SpectralArray="Responses")
    stride = estimation.stride_of_pictures(scene)
    if stride > 1:
        command.say(f"the pictures show every {stride}th pixel of the image")
    shown = {name: estimation.read_image([path], stride=stride) for name, path in written.items()}
    difference = pipeline.create("ResponseDifference", Input=shown["responses"], Simulated=shown["ideal"])
    pipeline.update(difference, *shown.values())
    apart = pictures.values(difference, "Difference").astype(float)
    cameras.draw_responsivities(camera, os.path.join(folder, "responsivities.png"))
    report.write(folder, "The camera looks at a scene", [
        report.pictures("The camera", folder, {"responsivities.png": "Responsivity of each channel"}),
        report.pictures("The scene, channel by channel", folder, cameras.draw_channels(
            shown["ideal"], shown["responses"], difference, folder,
            titles=("ideal", "with effects and noise", "difference")))],
                 changed(float(numpy.sqrt(numpy.nanmean(apart ** 2))), apart.shape[2]), pipeline.warnings)
    command.say(f"responses.img, ideal.img, pictures and report.html: {folder}")


# All that it writes into the output folder.
WRITES = (
    "camera.json", "camera.csv", "uncertainty.csv", "fit.csv", "channels.csv", "simulated.csv", "difference.csv",
    "difference-*.csv", "difference-channels.png", "responsivities.png", "designed.png", "samples.png", "channel-?.png",
    "channel-??.png", "ideal.img", "ideal.hdr", "responses.img", "responses.hdr", "report.html")


def changed(rms, channels):
    return f"Noise and effects change the responses of the ideal camera by rms {rms:.4f} (1 = white) over {channels} channels."


def lead_of(difference, fit, measured):
    """The result in one sentence."""
    names, rows = pipeline.table(pipeline.port(difference, 1))
    if not rows:
        return ""
    rms = math.sqrt(sum(row[names.index("rms")] ** 2 for row in rows) / len(rows))
    if not measured:
        return changed(rms, len(rows))
    text = f"The simulated camera differs from the real one by rms {rms:.4f} (response, 1 = white) over {len(rows)} channels"
    if fit is not None:
        titles, figures = pipeline.table(pipeline.port(fit, 2))
        text += f"; on samples that took no part in the fit, by {figures[0][titles.index('held_out_rms')]:.4f}"
    return text + "."


def main():
    options = OPTIONS
    outputs.require_files(*(options.image or []), options.samples, options.scene, options.labels, options.patches,
                          options.camera, options.effects)
    folder = outputs.claim(options.output, WRITES)
    pipeline.load_plugin()
    effects = {"Effects": "Effect File", "EffectFile": options.effects} if options.effects else {}
    if options.scene:
        look_at_scene(options, effects, folder)
        return

    image = labels = patches = None
    if options.image:
        image = estimation.read_image(options.image)
        labels = pipeline.create("LabelImageReader", FileName=options.labels)
        patches = pipeline.create("SampleTableReader", FileName=options.patches)
        samples = pipeline.create("PatchSampler", Input=image, Labels=labels, PatchTable=patches)
    else:
        samples = pipeline.create("SampleTableReader", FileName=options.samples)
    pipeline.update(samples)

    designed = cameras.read(options.camera) if options.camera else None
    camera, uncertainty, fit = designed, None, None
    pages = []
    if options.fit:
        fit = cameras.fit(samples, designed, options.draws, folder, options.detector_curve)
        camera, uncertainty = pipeline.port(fit, 0), pipeline.port(fit, 1)
        pages += [report.figures("The fit", *pipeline.table(pipeline.port(fit, 2))),
                  report.table("Channels", *pipeline.table(pipeline.port(fit, 3)))]
    else:
        cameras.save(camera, os.path.join(folder, "camera.json"))
    simulated = cameras.simulate(samples, camera, **effects)
    cameras.draw_responsivities(camera, os.path.join(folder, "responsivities.png"), uncertainty)
    shown = {"responsivities.png": "Responsivity of each channel"}
    if options.fit and designed is not None:
        cameras.draw_responsivities(designed, os.path.join(folder, "designed.png"))
        shown["designed.png"] = "Responsivity as designed"
    pipeline.save_table(simulated, os.path.join(folder, "simulated.csv"))
    measured = bool(cameras.responses(samples))
    real, title = samples, "real minus simulated"
    if not measured:
        real = cameras.simulate(samples, camera, Effects="None (ideal camera)", Noise="None")
        title = "ideal minus simulated"
    if measured and options.fit and designed is not None:
        as_designed = cameras.compare(real, cameras.simulate(samples, designed),
                                      "difference-designed", folder)
        pages.append(report.table("Real minus simulated as designed",
                                  *pipeline.table(pipeline.port(as_designed, 1))))
    difference = cameras.compare(real, simulated, "difference", folder)
    cameras.draw_samples(difference, title, os.path.join(folder, "samples.png"))
    cameras.draw_figures(difference, title, os.path.join(folder, "difference-channels.png"))
    pages.append(report.table(title.capitalize(), *pipeline.table(pipeline.port(difference, 1))))
    first = [report.pictures("The camera", folder, shown),
             report.pictures("The difference", folder, {"difference-channels.png": "Each channel: " + title,
                                                        "samples.png": "Every sample: " + title})]
    if image is not None:
        chart = cameras.simulate(cameras.chart_image(labels, patches), camera, **effects)
        maps = pipeline.create("ResponseDifference", Input=image, Simulated=chart)
        pipeline.update(maps)
        first.append(report.pictures("The chart, channel by channel", folder,
                                     cameras.draw_channels(chart, image, maps, folder)))
    report.write(folder, "The camera, simulated and real", first + pages, lead_of(difference, fit, measured), pipeline.warnings)
    command.say(f"camera, tables, pictures and report.html: {folder}")


command.run(main)
