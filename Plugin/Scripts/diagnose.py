"""The sim-to-real gap of a capture: where it lies, which effects cause it, how far it shrinks once they are simulated."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import command, diagnosis, pipeline, report  # noqa: E402


def arguments():
    parser = command.parser("diagnose", __doc__)
    parser.add_argument("capture", metavar="CAPTURE_DIR",
                        help="folder with capture.json, camera.csv, samples.csv and responses.csv")
    parser.add_argument("--without", metavar="EFFECT", action="append", default=[],
                        help="an effect that may not be blamed; may be given several times")
    parser.add_argument("--causes", metavar="N", type=command.whole_number(1), default=5,
                        help="largest number of causes, up to 8 (default: %(default)s)")
    parser.add_argument("--folds", metavar="N", type=command.whole_number(2), default=5,
                        help="folds of the samples, up to 20 (default: %(default)s)")
    parser.add_argument("--seed", metavar="N", type=command.whole_number(0), default=1,
                        help="seed of folds and resampling (default: %(default)s)")
    options = parser.parse_args()
    for name, most in (("causes", 8), ("folds", 20)):
        if getattr(options, name) > most:
            parser.error(f"--{name}: {getattr(options, name)} is more than {most}")
    return options


def main():
    options = arguments()
    pipeline.load_plugin()
    capture = diagnosis.read_capture(options.capture)
    gap = diagnosis.diagnose(capture, Without=options.without, MaximumCauses=options.causes,
                             Folds=options.folds, Seed=options.seed)
    folder = command.make_folder(options.output)
    diagnosis.write(gap, folder)
    report.write(folder, f"Sim-to-real gap: {diagnosis.name_of(options.capture)}",
                 diagnosis.sections(gap, folder))
    diagnosis.print_summary(gap)
    command.say(f"report, pictures, tables and the corrected camera: {os.path.join(folder, 'report.html')}")


command.run(main)
