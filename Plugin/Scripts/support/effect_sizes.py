"""How large an effect of the camera is, in words: of the parameters of Filters/Kernels/Camera/Effects, at places where a reader can
picture it. An effect without words is told by its numbers alone."""

import math

_MIDDLE = 0.5  # of the range up to white
_NO_END = 2.0  # times white: a level that no sample reaches


def _plain(value, sign=""):
    """Two digits, without an exponent."""
    return f"{float(f'{value:.2g}'):{sign}g}"


def _percent(value):
    return f"{_plain(100 * abs(value))} %"


def _more(value, than=""):
    return f"{_percent(value)} {'more' if value >= 0 else 'less'} light{than}"


def _brighter(value):
    return f"{_percent(value)} {'brighter' if value >= 0 else 'darker'}"


def _channels(values, unit):
    """Of one number for each channel."""
    low, high = min(values), max(values)
    return f"by {_plain(low, '+')} to {_plain(high, '+')} {unit} (by channel)"


def _relative(values, words):
    """A change of all channels in words, or the range of those of each."""
    return words(values[0]) if len(values) == 1 else f"{words(min(values))} to {words(max(values))} (by channel)"


def _of(values, words):
    """A part of the light, of all channels or of each."""
    low, high = _plain(100 * min(values)), _plain(100 * max(values))
    return words.format(f"{low} %" if low == high else f"{low} to {high} % (by channel)")


def _falloff(form, p):
    if form == "cos4":
        losses = [1.0 - (1.0 + p["tangent"][0] ** 2) ** -2]
    elif form == "polynomial":
        losses = [sum(p[name][0] for name in ("falloff", "fourth", "sixth"))]
    else:
        losses = p["falloff"]
    return _relative([-loss for loss in losses], _more) + " at the edge of the longer side than on the axis"


def _gradient(form, p):
    if form == "any_shape":
        orders = {tuple(map(int, name.split("_")[1:])): value[0] for name, value in p.items()}
        # Mean squares of Legendre polynomials from -1 to 1.
        square = sum(value * value / ((2 * x + 1) * (2 * y + 1)) for (x, y), value in orders.items())
        return f"light that differs by {_percent(math.sqrt(square))} from place to place (standard deviation over a square field), in no simple shape"
    # The samples' y and an image's y may run in different directions.
    right, down = (p.get(name, [0.0]) for name in ("along_x", "along_y"))
    both = f"; {_more(p['square'][0])} at both ends of a line at {_plain(p['turn'][0])} degrees" if form == "bent" else ""
    return f"{_relative(right, _more)} at the right edge than in the middle, {_relative(down, _more)} where y is largest{both}"


def _nonlinearity(form, p):
    if form == "gamma":
        return f"exponent {p['exponent'][0]:.3g}"
    if form == "compressive":
        return f"{_brighter(1.0 / (1.0 + p['compression'][0]) - 1.0)} at white"
    if form in ("anchored", "per_channel"):
        return _relative([(_MIDDLE - 1.0) * square for square in p["square"]], _brighter) + " at half of white"
    if form == "fitted":
        return f"the response bends by {_percent(p['square'][0])} of white up to white, which the linear fit of the simulated camera leaves out"
    return f"{_brighter(sum(p[name][0] for name in ('square', 'cube') if name in p))} at white"


def _drift(form, p):
    when = ("at the start" if form.startswith("settling") else
            f"from {_percent(p['place'][0])} of the session on" if "place" in p else "in the course of the session")
    if form.startswith("offset"):
        return f"{_percent(p['change'][0])} of white {'brighter' if p['change'][0] >= 0 else 'darker'} {when}"
    return _relative(p["change"], _brighter) + " " + when


def _lamp(form, p):
    if form == "band":
        return f"{_more(p['change'][0])} at {p['center'][0]:.0f} nm"
    if form == "another_lamp":
        weights = [value[0] for name, value in p.items() if name.startswith("shape_")]
        size = math.sqrt(sum(weight * weight for weight in weights) / len(weights))
        return f"another kind of lamp, {size:.2g} times as far from the model's as two standard lamps are from each other"
    ends = math.exp(2.0 * (p["tilt"][0] + p.get("twist", [0.0])[0]))  # the even polynomial is the same at both
    places = "in the last channel as in the first" if form == "over_channels" else "at the longest wavelength as at the shortest"
    return f"{ends:.3g} times as much light {places}, relative to the model"


def _dark(form, p):
    if len(p["offset"]) == 1:
        return f"{_percent(p['offset'][0])} of white too {'bright' if p['offset'][0] >= 0 else 'dark'}"
    offsets = _channels([100 * value for value in p["offset"]], "% of white")
    if form != "plane":
        return offsets
    most = max(p["along_x"] + p["along_y"], key=abs)
    return f"{offsets} in the middle, up to {_percent(most)} of white more on one side and less on the other"


def _crosstalk(form, p):
    # A negative part, against physics, says that something else is behind it.
    part = {name: f"{_plain(100 * value[0])} %" for name, value in p.items()}
    if form == "shared":
        return f"{part['coupling']} of the signal of each channel is what all channels have in common"
    if "coupling" in p:
        return f"{part['coupling']} of the signal exchanged with each neighbouring channel"
    sides = [f"{part[name]} of the signal from the channel {side}" for name, side in
             (("from_previous", "before"), ("from_next", "behind")) if abs(p[name][0]) >= 0.0005]
    return " and ".join(sides) or "less than 0.05 % of the signal"


def _wider(value):
    return "wider" if value >= 0 else "narrower"


def _bandwidth(_form, p):
    changes = [v - 1.0 for v in p.get("factor", [])]
    by_factor = _relative(changes, lambda v: f"{_percent(v)} {_wider(v)}") if changes else ""
    if "added_variance" not in p:
        return "passbands " + by_factor
    variance = p["added_variance"][0]
    if not changes:
        return f"passbands {_wider(variance)} by {_plain(abs(variance))} nm² of variance"
    return f"passbands {by_factor}, with {_plain(abs(variance))} nm² {'more' if variance >= 0 else 'less'} variance"


def _noise(form, p):
    if form == "added":
        return f"a standard deviation of {_percent(p['added'][0])} of white in addition"
    low, high = min(p["factor"]), max(p["factor"])
    return f"{low:.3g} times the scatter" if low == high else f"{low:.3g} to {high:.3g} times the scatter, by channel"


def _displacement(_form, p):
    moved = max(abs(v) for name in ("along_x", "along_y") for v in p.get(name, [0.0]))
    growth, turned = (p.get(name, [0.0]) for name in ("magnification", "rotation"))
    alike = len(growth) == 1
    larger, angle = max(growth, key=abs), max(map(abs, turned))
    parts = [f"up to {moved:.2g} pixels"] if moved >= 0.01 else []
    if abs(larger) >= 1e-5:
        more = "larger" if larger > 0 else "smaller"
        parts += [f"the image {_percent(larger)} {more}" if alike else f"images up to {_percent(larger)} larger or smaller"]
    parts += [f"turned by {'' if alike else 'up to '}{angle:.2g} degrees"] if angle >= 1e-4 else []
    return ", ".join(parts) or "less than 0.01 pixels"


def _distortion(_form, p):
    at_the_end = {name: p.get(name, [0.0])[0] for name in ("radial", "keystone_x", "keystone_y", "aspect", "shear")}
    radial, tilts = at_the_end.pop("radial"), list(at_the_end.values())
    parts = [f"{'pincushion' if radial > 0 else 'barrel'}, {_percent(radial)} at the end of the longer side"] if radial else []
    parts += [f"the view is tilted, up to {_percent(max(tilts, key=abs))} at the end of the longer side"] if any(tilts) else []
    return "; ".join(parts)


def _saturation(_form, p):
    ends = [level for level in p["level"] if level < _NO_END] or p["level"]
    some = f", in {len(ends)} of {len(p['level'])} channels" if len(ends) < len(p["level"]) else ""
    return _of(ends, "responses end at {} of white") + some


def _stray_light(form, p):
    shares = [value[0] for name, value in p.items() if name.startswith("share_")]
    fraction = sum(shares) if form == "any_shape" else p["fraction"][0]
    if fraction < 0:
        return f"{_percent(fraction)} less of the light falls on the surround than is simulated"
    return f"{_percent(fraction)} of the light falls on the surround"


def _banding(form, p):
    across = "column to column" if form.startswith("column") else "row to row"
    white = " of white" if form.endswith("offsets") else ""
    cycle = f"{p['period'][0]:.3g} pixels a cycle"
    if "rms" not in p:
        return f"up to {_percent(max(p['amplitude'], key=abs))}{white} from {across}, {cycle}"
    periodic = p["periodic_part"][0] > 0.5
    return f"{_percent(p['rms'][0])}{white} from {across} (standard deviation), {cycle if periodic else 'without a period'}"


# By effect: from the form and its parameters, each a list with one number or one for each channel.
WORDS = {
    "specular_component": lambda f, p: f"{_more(p['pedestal'][0])} from the surface, relative to white",
    "translucency": lambda f, p: _more(1.0 / (1.0 + p["loss"][0]) - 1.0, " from a white sample at 550 nm"),
    "fluorescence": lambda f, p: _of(p["yield"], f"emission of {{}} at {p['peak'][0]:.0f} nm for full excitation"),
    "interreflection": lambda f, p: (f"{_percent(p['probability'][0])} of the light strikes the surface once "
                                     f"{'more' if p['probability'][0] >= 0 else 'less'} than in the spectrophotometer"),
    "medium_gain": lambda f, p: _brighter(p["gain"][0] - 1.0),
    "filter_bandwidth": _bandwidth,
    "filter_shift": lambda f, p: (f"{abs(p['shift'][0]):.3g} nm towards {'longer' if p['shift'][0] >= 0 else 'shorter'} wavelengths"
                                  if len(p["shift"]) == 1 else _channels(p["shift"], "nm")),
    "filter_leak": lambda f, p: _of(p["fraction"], "{} of the light through the passband leaks beside it"),
    "illuminant_drift": _lamp,
    "illumination_gradient": _gradient,
    "vignetting": _falloff,
    "veiling_glare": lambda f, p: _of(p["fraction"], "{} of the scene's mean lies over the field"),
    "local_stray_light": _stray_light,
    "exposure_gain": lambda f, p: "all channels " + _brighter(p["gain"][0] - 1.0),
    "channel_gain": lambda f, p: _relative([v - 1.0 for v in p["gain"]], _brighter),
    "channel_crosstalk": _crosstalk,
    "session_drift": _drift,
    "detector_nonlinearity": _nonlinearity,
    "dark_offset": _dark,
    "saturation": _saturation,
    "excess_noise": _noise,
    "distortion": _distortion,
    "misregistration": _displacement,
    "defocus": lambda f, p: (f"a blur of {max(p['blur']):.2g} pixels (standard deviation)" if len(p["blur"]) == 1 else
                             f"a blur of {min(p['blur']):.2g} to {max(p['blur']):.2g} pixels (standard deviation), by channel"),
    "ghost_reflection": lambda f, p: _of(p["strength"], "{} of the light appears on the opposite side"),
    "lag": lambda f, p: _of(p["retained"], "{} of the channel before stays"),
    "banding": _banding,
}


def in_words(rows):
    """rows: those of one cause in the table of causes; empty where it has no parameters."""
    values = {}
    for row in rows:
        if row["parameter"]:
            values.setdefault(row["parameter"].partition("[")[0], []).append(row["value"])
    if "added_variance" in values and all(abs(row["value"] - 1.0) < max(row.get("standard_error", 0.0), 5e-4)
                                          for row in rows if row["parameter"].startswith("factor")):
        values.pop("factor", None)  # another width that may as well be none
    try:
        return WORDS[rows[0]["effect"]](rows[0]["form"], values) if values else ""
    except KeyError:  # a form whose parameters these words do not know: its table says more
        return ""
