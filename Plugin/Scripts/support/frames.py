"""How an image was taken: the options of the commands that read one, and its responses."""

import argparse
import math

_FILTER = {"white_reflectance": "WhiteReflectance", "white_level": "WhiteLevel", "saturation": "SaturationLevel",
           "exposure": "ExposureTimes", "white_exposure": "WhiteExposureTimes"}  # as properties of Flat Field Correction


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


def add_options(parser, required=True):
    """Returns the group of those that say how the image was taken."""
    parser.add_argument("--image", metavar="FILE", nargs="+", required=required,
                        help="the image: one file, or one file per channel")
    parser.add_argument("--white", metavar="FILE", nargs="+", help="white reference, like --image")
    parser.add_argument("--dark", metavar="FILE", nargs="+", help="dark frame, like --image")
    parser.add_argument("--wavelengths", metavar="NM", nargs="+", type=float,
                        help="wavelengths of the image's channels in nm; overrides those in the files")
    group = parser.add_argument_group("how the image was taken")
    group.add_argument("--white-reflectance", metavar="FACTOR", type=number(0.001, 2.0),
                       help="reflectance factor of the white reference (default: 1)")
    group.add_argument("--white-level", metavar="COUNTS", type=number(0.0),
                       help="level of white where there is no --white (default: 1)")
    group.add_argument("--saturation", metavar="COUNTS", type=number(0.0),
                       help="raw and white values from this level on are saturated: their pixels become NaN")
    group.add_argument("--exposure", metavar="T", nargs="+", type=number(0.0),
                       help="exposure times of the image: one, or one per channel; with --white-exposure")
    group.add_argument("--white-exposure", metavar="T", nargs="+", type=number(0.0),
                       help="exposure times of the white reference, in the same unit")
    return group


def check(parser, options):
    if (options.exposure is None) != (options.white_exposure is None):
        parser.error("--exposure and --white-exposure go together")
    if options.white_level is not None and options.white is not None:
        parser.error("--white-level is for images without --white")
    given = [f"--{name.replace('_', '-')}" for name in ("white", "dark", "wavelengths", *_FILTER) if getattr(options, name) is not None]
    if options.image is None and given:
        parser.error(f"{given[0]} goes with --image")


def files(options):
    """For outputs.require_files."""
    return [*(options.image or []), *(options.white or []), *(options.dark or [])]


def responses(options, stride=1):
    """The image divided by its frames, which nothing has read yet."""
    from . import estimation

    def read(paths):
        return estimation.read_image(paths, options.wavelengths, stride) if paths else None
    given = {name: getattr(options, option) for option, name in _FILTER.items() if getattr(options, option) is not None}
    return estimation.flat_field(read(options.image), read(options.white), read(options.dark), **given)
