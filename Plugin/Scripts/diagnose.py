"""The sim-to-real gap of a capture: where it lies, which effects cause it, how far it shrinks once they are simulated."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import command  # noqa: E402


def arguments():
    parser = command.parser(
        "diagnose", __doc__,
        "capture/",
        "capture/ --without filter_shift --causes 3 --output gap",
        "capture/ --also gray-scale/")
    parser.add_argument("capture", metavar="CAPTURE_DIR",
                        help="folder with capture.json, camera.csv, samples.csv and responses.csv; or with "
                             "images/ (real* and simulated*; or real*, labels* and patches* of a chart, "
                             "which camera.csv then simulates), or with both")
    parser.add_argument("--also", metavar="CAPTURE_DIR", action="append", default=[],
                        help="a further capture of the same camera, such as the one that the report asked for; may be given "
                             "several times")
    parser.add_argument("--without", metavar="EFFECT", action="append", default=[],
                        help="an effect that may not be blamed; may be given several times")
    parser.add_argument("--causes", metavar="N", type=command.whole_number(1), default=5,
                        help="largest number of causes, up to 8 (default: %(default)s)")
    parser.add_argument("--add-rest", action="store_true",
                        help="add a smooth function that models what no cause explains to the corrected simulator")
    parser.add_argument("--samples", metavar="N", type=command.whole_number(0), default=2000,
                        help="largest number of samples that are used, spread over media, scenes and levels; 0: all "
                             "(default: %(default)s)")
    parser.add_argument("--folds", metavar="N", type=command.whole_number(2), default=5,
                        help="folds of the samples, up to 20 (default: %(default)s)")
    parser.add_argument("--seed", metavar="N", type=command.whole_number(0), default=1,
                        help="seed of folds and resampling (default: %(default)s)")
    options = parser.parse_args()
    for name, most in (("causes", 8), ("folds", 20)):
        if getattr(options, name) > most:
            parser.error(f"--{name}: {getattr(options, name)} is more than {most}")
    return options


OPTIONS = arguments()  # before ParaView is loaded

from support import diagnosis, gap_pictures, image_gap, outputs, pipeline, report  # noqa: E402

_INPUTS = ("capture.json", "camera.csv", "camera.json", "samples.csv", "responses.csv")
_RESULTS = tuple(f"{name}.csv" for name in diagnosis.TABLES) + gap_pictures.NAMES + (
    "report.json", "camera-corrected.json", "camera-corrected.csv", "effects.json")
# All that it writes into the output folder.
WRITES = _RESULTS + tuple(f"images/{name}" for name in _RESULTS) + ("report.html",)


def main():
    options = OPTIONS
    pipeline.load_plugin()
    place = diagnosis.folder_of(options.capture)
    images = image_gap.pair(place)
    places = [place, *map(diagnosis.folder_of, options.also)]
    outputs.reads(*(os.path.join(folder, name) for name in _INPUTS for folder in places),
                  *(path for paths in (images or {}).values() for path in paths))
    outputs.require_apart(options.output, WRITES)
    choices = {"Without": options.without, "MaximumCauses": options.causes, "Seed": options.seed,
               "AddRest": options.add_rest}
    outcomes = []
    has_tables = images is None or os.path.exists(os.path.join(place, "samples.csv"))
    if options.also and not has_tables:
        raise command.Failure(f"--also: {options.capture} has images alone; expected samples.csv and responses.csv beside them; "
                              "diagnose the images without --also")
    if has_tables:
        outcomes.append((diagnosis, diagnosis.diagnose(diagnosis.read_capture(options.capture, options.also),
                                                       Folds=options.folds, MaximumSamples=options.samples,
                                                       **choices)))
    if images is not None:
        outcomes.append((image_gap, image_gap.diagnose(images, **choices)))

    folder = outputs.claim(options.output, WRITES)
    sections = []
    for number, (kind, gap) in enumerate(outcomes):
        # The images beside tables have a folder of their own.
        target = outputs.make_folder(os.path.join(folder, "images")) if number > 0 else folder
        kind.write(gap, target)
        sections += kind.sections(gap, target)
        diagnosis.print_summary(gap)
    names = " and ".join(os.path.basename(os.path.abspath(folder)) for folder in places)
    report.write(folder, f"Sim-to-real gap: {names}", sections, diagnosis.lead(outcomes[0][1]), pipeline.warnings)
    command.say(f"report, pictures and tables: {os.path.join(folder, 'report.html')}")


command.run(main)
