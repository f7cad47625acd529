"""A synthetic scene as a reflectance image of any size: a printed chart or dyed fabric, its labels and its patches."""

import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from support import command  # noqa: E402

SUBJECTS = {"chart24": "Chart of 24 Patches", "chart140": "Chart of 140 Patches", "fabric": "Fabric"}


def numbers(kind, separator, count, example):
    """Parses 640x480 or 400:700:10."""
    def parse(text):
        try:
            parts = [kind(part) for part in text.split(separator)]
        except ValueError:
            parts = []
        if len(parts) != count:
            raise argparse.ArgumentTypeError(f"'{text}' is not of the form {example}")
        return parts
    return parse


def arguments():
    parser = command.parser(
        "scene", __doc__,
        "chart24 --size 1024x768",
        "fabric --size 2048x2048 --wavelengths 380:730:5 --seed 2")
    parser.add_argument("subject", choices=SUBJECTS, help="what the image shows")
    parser.add_argument("--size", metavar="WxH", type=numbers(int, "x", 2, "768x512"), default=[768, 512],
                        help="columns and rows in pixels (default: 768x512)")
    parser.add_argument("--wavelengths", metavar="A:B:STEP", default=[400.0, 700.0, 10.0],
                        type=numbers(float, ":", 3, "400:700:10"),
                        help="first and last wavelength and the step in nm (default: 400:700:10)")
    parser.add_argument("--seed", metavar="N", type=command.whole_number(0), default=1,
                        help="another number, other dyes and another texture (default: %(default)s)")
    parser.add_argument("--texture", metavar="X", type=float, default=1.0,
                        help="relief, shading and scatter, 0 none .. 3 (default: %(default)s)")
    parser.add_argument("--interreflection", metavar="P", type=float, default=0.16,
                        help="fabric: probability of a further reflection, 0 .. 0.5 (default: %(default)s)")
    parser.add_argument("--yarn", metavar="PIXELS", type=float, default=4.4,
                        help="fabric: mean width of a yarn (default: %(default)s)")
    return parser.parse_args()


OPTIONS = arguments()  # before ParaView is loaded

from support import estimation, outputs, pictures, pipeline, report  # noqa: E402


# All that it writes into the output folder.
WRITES = ("reflectance.img", "reflectance.hdr", "labels.img", "labels.hdr", "patches.csv", "scene.png",
          "report.html")


def main():
    options = OPTIONS
    folder = outputs.claim(options.output, WRITES)
    pipeline.load_plugin()
    scene = pipeline.create("SyntheticScene", Subject=SUBJECTS[options.subject], Size=options.size,
                            Wavelengths=options.wavelengths, Seed=options.seed, Texture=options.texture,
                            Interreflection=options.interreflection, YarnWidth=options.yarn)
    scene.UpdatePipelineInformation()
    pipeline.fail_on_error()
    image = os.path.join(folder, "reflectance.img")
    pipeline.save_image(scene, image, SpectralArray="Reflectance")
    pipeline.save_image(scene, os.path.join(folder, "labels.img"), SpectralArray="Label", SampleType="uint8")
    pipeline.save_table(pipeline.port(scene, 1), os.path.join(folder, "patches.csv"))

    stride = estimation.stride_of_pictures(scene)
    written = pipeline.create("SpectralImageReader", FileNames=[image], ArrayKind="Reflectance", Preview=0,
                              Stride=[stride, stride])
    color = pipeline.create("SpectralToColor", Input=written)
    pipeline.update(color)
    pictures.image(color, "sRGB", os.path.join(folder, "scene.png"), rgb=True)
    if stride > 1:
        command.say(f"the picture shows every {stride}th pixel of the image")
    report.write(folder, "A synthetic scene", [
        report.pictures(SUBJECTS[options.subject], folder, {"scene.png": "sRGB view under D65"}),
        report.table("Patches", *pipeline.table(pipeline.port(scene, 1)),
                     columns=["sample", "medium", "label", "x", "y"])],
                 f"The scene has {' x '.join(map(str, pictures.size(scene)))} pixels and "
                 f"{command.counted(pipeline.number_of_rows(pipeline.port(scene, 1)), 'patch', 'patches')}.", pipeline.warnings)
    command.say(f"reflectance.img, labels.img, patches.csv, scene.png and report.html: {folder}")


command.run(main)
