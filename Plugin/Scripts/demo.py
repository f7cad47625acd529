"""The main job on the embedded, synthetic data: calibrate, correct, estimate an image, show where it is wrong."""

import glob
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import colors, command  # noqa: E402

PARSER = command.parser("demo", __doc__, "", "--output demo --ranks 2", "--illuminant A --observer 10")
colors.add_options(PARSER, lights_pictures=True)
OPTIONS = PARSER.parse_args()  # before ParaView is loaded

from support import comparison, diagnosis, estimation, outputs, pipeline, report, state  # noqa: E402
from support.methods import COMPARED  # noqa: E402

TUNING = 16
DRAWS = 10
SEED = 1


def stack(*parts):
    return sorted(glob.glob(os.path.join(command.root(), "Data", "Images", "demo-fabric", *parts,
                                         "channel_*.tif")))


def sample_table(name):
    return pipeline.create("SampleTableReader",
                           FileName=os.path.join(command.root(), "Data", "Samples", name))


def compare_methods(chart, fabric, folder, viewed):
    command.say(f"Methods compared: {TUNING} tuning swatches, {DRAWS} draws, the rest held out")
    return comparison.compare(chart, fabric, folder=folder, methods=",".join(COMPARED),
                              tuning=TUNING, draws=DRAWS, seed=SEED, colors=viewed)


def estimate_image(chart, fabric, folder, viewed):
    """The image with the chart's calibration alone, and corrected by the tuning swatches."""
    image = estimation.flat_field(*(estimation.read_image(stack(*parts))
                                    for parts in ((), ("white",), ("dark",))))
    labels = pipeline.create("LabelImageReader", FileName=os.path.join(
        command.root(), "Data", "Images", "demo-fabric", "labels.png"))
    patches = pipeline.create("SampleTableReader", FileName=os.path.join(
        command.root(), "Data", "Images", "demo-fabric", "patches.csv"))
    tuning = pipeline.create("SampleSplit", Input=fabric, Mode="Random", Count=TUNING, Seed=SEED)
    results = {}
    reflectances = {}
    tops = None
    for name, samples, method in (("direct", None, "Direct"),
                                  ("transfer", pipeline.port(tuning, 0), "Transfer")):
        place = outputs.make_folder(os.path.join(folder, name))
        transforms, _ = estimation.correction(chart, samples, method)
        reflectance = estimation.estimate(image, transforms, place)
        reflectances[name] = reflectance
        results[name] = estimation.judge(reflectance, labels, patches, place, tops, colors=viewed)
        tops = tops or estimation.top_errors(results[name].summary)
        estimation.save_view(reflectance, place, colors=viewed)
        estimation.print_summary(f"Swatches in the image, {name}",
                                 pipeline.port(results[name].patches, 1))
        if name == "transfer":
            estimation.save_reflectance(reflectance, place)
    estimation.save_state(os.path.join(folder, "state.pvsm"), reflectances["transfer"],
                          results["transfer"], viewed)
    return results


def diagnose_capture(folder):
    """A synthetic capture whose real camera differs from the simulated one."""
    command.say("Sim-to-real gap of a synthetic capture")
    gap = diagnosis.diagnose(diagnosis.read_capture(
        os.path.join(command.root(), "Data", "Captures", "demo-warm-camera")))
    diagnosis.write(gap, outputs.make_folder(folder))
    diagnosis.print_summary(gap)
    return gap


def before_and_after(results, viewed):
    """The result in one sentence."""
    means = [estimation.mean_of(results[name].patches, viewed.metric, viewed.illuminants[0]) for name in ("direct", "transfer")]
    if command.rank() != 0:
        return ""
    (before, _, count), (after, _, _) = means
    return (f"{TUNING} measured swatches reduce the mean color error of the {count} swatches in the image from "
            f"{viewed.label} {before:.1f} to {after:.1f} ({viewed.text}).")


# All that it writes into the output folder.
WRITES = ("*", "direct/*", "transfer/*", "gap/*")


def main():
    outputs.require_files(*colors.files(OPTIONS))
    folder = outputs.claim(OPTIONS.output, WRITES)
    pipeline.load_plugin()
    viewed = colors.Colors(OPTIONS)
    chart, fabric = sample_table("demo-chart.csv"), sample_table("demo-fabric.csv")
    pipeline.update(chart, fabric)

    names, rows, _ = compare_methods(chart, fabric, folder, viewed)
    results = estimate_image(chart, fabric, folder, viewed)
    gap_folder = os.path.join(folder, "gap")
    gap = diagnose_capture(gap_folder)

    sections = [
        report.text("What this is",
                    "A camera is calibrated on a printed chart and then looks at dyed fabric: another "
                    "material, another surface. The chart's calibration fails there because the material's spectra differ from "
                    "the chart's (cross-media instrument metamerism). A few measured swatches correct it. All data are synthetic; "
                    "Data/Samples/README.md and Data/Images/README.md say how they were made."),
        report.table("Methods on held-out swatches", *comparison.condensed(names, rows),
                     note=f"{TUNING} tuning swatches. Mean / median / max over the swatches held out, "
                          f"mean over {DRAWS} draws; rms of reflectance factor, {viewed.label}. "
                          + comparison.explained(names, rows)),
        report.pictures("The comparison in pictures", folder, {
            "spectra.png": "A typical held-out swatch",
            "rms-against-tuning.png": "Error against the number of tuning swatches",
            "ab-distribution.png": "Where the three sets lie in a*b*"})]
    errors = os.path.basename(estimation.error_picture("", results["direct"].arrays[1]))
    sections.insert(0, report.pictures("Before and after", folder, {
        "direct/rgb.png": "With the chart's calibration alone", "transfer/rgb.png": "Corrected by the tuning swatches",
        f"direct/{errors}": f"Its color errors ({viewed.label}, {viewed.text})",
        f"transfer/{errors}": "Its color errors, on the same scale"}))
    for name, title in (("direct", "The image with the chart's calibration alone"),
                        ("transfer", "The image corrected by the tuning swatches")):
        place = os.path.join(folder, name)
        sections.append(report.chapter(title, estimation.report_errors(results[name], place)))
    sections.append(report.chapter(
        "Why a simulated and a real camera disagree", diagnosis.sections(gap, gap_folder),
        "Another synthetic capture: printed patches and dyed swatches before a camera whose filters are "
        "warm, whose lamp warms up during the session, and which sees less light from fabric than the "
        "spectrophotometer (Data/Captures/README.md says by how much). The diagnosis below was told none "
        "of it."))
    report.write(folder, "Multispectral: demo", sections, before_and_after(results, viewed), pipeline.warnings)
    state.finish()
    command.say(f"report, pictures and tables: {os.path.join(folder, 'report.html')}")


command.run(main)
