"""Withheld cases of cameras of many kinds, in numpy: cameras.py FOLDER KEYFILE [small|full] [SEED] [RESULTFILE|curved]

Cameras of 3, 6, 8, 16 and 30 channels, known but for small errors (where an effect is there) or fitted to half of the samples, look at measured
reflectances (with MULTISPECTRAL_DATA) under lamps of the CIE; one effect, two or none are added. Shares no code with the
other generators and none with the simulator.

With "curved" all cameras are fitted, as linear ones, and two of three have a curved detector.

With the results of a diagnosis of these cases (same size and seed) lists those for which it recommends a next capture, with that capture
beside the first. Where it measures a part of the camera or of a sample, effects on that part are not tried again; cases where such an
effect is planted are left out, as that measurement shows it by itself.
"""

import csv
import json
import os
import sys

import numpy
from scipy.interpolate import CubicSpline

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Cases"))
from cases import lists, rms, strength_of, table  # noqa: E402

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..")
FINE = numpy.arange(400, 701, 2.0)
COARSE = numpy.arange(400, 701, 10.0)
READ, SHOT, SPECTROPHOTOMETER = 0.0006, 0.0009, 0.0008
LAMPS = ["A", "D50", "D65", "FL2", "FL7", "FL11", "LED-B1", "LED-B3", "LED-B5"]
CHARTS = ["colorchecker-sg", "clothes", "paint-chips", "ces99"]
KINDS = {"3": "three broad channels", "6": "three channels through two filters", "8": "eight passbands",
         "16": "a filter wheel of sixteen", "30": "a tunable filter"}
AXES = {"illuminant_drift": "channel spectral_shape", "exposure_gain": "level channel", "channel_gain": "channel",
        "dark_offset": "level channel", "detector_nonlinearity": "level", "channel_crosstalk": "channel spectral_shape",
        "filter_shift": "spectral_shape channel", "filter_bandwidth": "spectral_shape channel", "saturation": "level sample",
        "veiling_glare": "level channel", "medium_gain": "medium level", "specular_component": "medium level",
        "interreflection": "medium level", "session_drift": "order", "vignetting": "position", "illumination_gradient": "position"}
ON_A_MEDIUM = {"medium_gain", "specular_component", "interreflection"}
# Next captures that measure a part of the camera or of a sample, and the effects on it.
MEASURES = {"lamp spectrum; white tile": ["illuminant_drift"],
            "monochromator": ["filter_shift", "filter_bandwidth", "filter_leak"],
            "specular included and excluded measurement; black glossy tile": ["specular_component"],
            "layers over black and white backing": ["translucency"], "UV-cut filter": ["fluorescence"],
            "flat and folded sample": ["interreflection"], "rotated sample": ["medium_gain"]}
# What the camera sees at the same time.
BESIDE = {"lamp spectrum; white tile": "repeated white"}


def numbers(path):
    with open(path, encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row and row[0].replace(".", "").isdigit()]
    return numpy.array(rows, float)


def lamp(name):
    table = numbers(os.path.join(ROOT, "Data", "Tables", f"illuminant_{name}.csv"))
    power = numpy.interp(FINE, table[:, 0], table[:, 1])
    return power / power.mean()


def chart(name):
    with open(os.path.join(os.environ["MULTISPECTRAL_DATA"], "reflectances", name + ".csv"), encoding="utf-8") as file:
        rows = list(csv.reader(file))
    columns = [i for i, head in enumerate(rows[0]) if head[0] == "R" and head[1:].isdigit()]
    wavelengths = [float(rows[0][i][1:]) for i in columns]
    values = numpy.array([[float(row[i]) for i in columns] for row in rows[1:]])
    return numpy.clip(CubicSpline(wavelengths, values.T)(FINE).T, 0.002, 1.2)


def band(center, width):
    return numpy.exp(-4.0 * numpy.log(2.0) * ((FINE - center) / width) ** 2)


def sensitivities(kind, random):
    if kind in ("3", "6"):
        centers = numpy.array([605, 535, 460]) + random.normal(0, 6, 3)
        widths = numpy.array([75, 95, 80]) * random.uniform(0.85, 1.15, 3)
        curves = numpy.array([band(*one) for one in zip(centers, widths)])
        curves += random.uniform(0.02, 0.08, 3)[:, None] * curves.sum(0)
        curves[0] += 0.06 * band(450, 60)
        curves *= 0.02 + 1.0 / (1.0 + numpy.exp((FINE - 680) / 8))
        if kind == "6":
            edge = 1.0 / (1.0 + numpy.exp(-(FINE - random.uniform(520, 560)) / 15))
            curves = numpy.vstack([curves * edge, curves * (1.0 - 0.9 * edge)])
            curves = curves[numpy.argsort(curves @ FINE / curves.sum(1))]
        return curves
    if kind == "8":
        centers = numpy.array([415, 450, 475, 505, 535, 570, 615, 660]) + random.normal(0, 4, 8)
        return numpy.array([band(center, random.uniform(18, 40)) for center in centers])
    if kind == "16":
        return numpy.array([band(center, random.uniform(12, 20)) for center in numpy.linspace(405, 695, 16) + random.normal(0, 1, 16)])
    return numpy.array([band(center, 8 + 0.03 * (center - 400)) for center in numpy.linspace(405, 695, 30)])


def widened(curves, deviation):
    """Convolved with a Gaussian; what leaves the range of wavelengths is lost."""
    weights = numpy.exp(-0.5 * ((FINE[:, None] - FINE) / deviation) ** 2)
    return curves @ (weights / weights[len(FINE) // 2].sum())


class Scene:
    """Samples where they stand and when they are captured. Without places: in the middle, at the start, and nobody tells."""

    def __init__(self, reflectance, medium=None, x=None, y=None, turn=None):
        nought = numpy.zeros(len(reflectance))
        self.reflectance = reflectance
        self.medium = numpy.full(len(reflectance), "") if medium is None else medium
        self.placed, self.ordered = x is not None, turn is not None
        self.x, self.y, self.turn = nought if x is None else x, nought if y is None else y, nought if turn is None else turn

    def after(self, name):
        """What the next capture of that name looks at."""
        levels = {"lens cap": [0.0], "exposure series of one patch": [0.95, 0.7, 0.5, 0.35, 0.2, 0.1, 0.05],
                  "black trap; second scene": [0.0, 0.03, 0.03, 0.03], "repeated white": [0.9, 0.9]}
        if name in levels:
            return Scene(numpy.outer(levels[name], numpy.ones(len(FINE))))
        if name == "narrow-band source":
            return Scene(numpy.exp(-0.5 * ((FINE - COARSE[:, None]) / 5.0) ** 2))
        even = numpy.full((9, len(FINE)), 0.9)
        board = numpy.where(numpy.arange(9)[:, None] % 2, even, 0.03)
        place = numpy.arange(9)
        return {"flat field": Scene(even, None, place % 3 - 1.0, place // 3 - 1.0),
                "interleaved white": Scene(even, None, None, None, place * (len(self.turn) - 1) / 8),
                "patch with black and with white surround": Scene(board, None, place % 3 - 1.0, place // 3 - 1.0),
                "chart rotated by 180 degrees": Scene(self.reflectance, self.medium, -self.x, -self.y, self.turn)}[name]


class Case:
    """A camera before samples, and what it answers once effects of some strength are added."""

    def __init__(self, random, effects, kind, fitted, curved):
        charts = random.choice(CHARTS, 2 if ON_A_MEDIUM & set(effects) or random.random() < 0.3 else 1, replace=False)
        reflectance = numpy.vstack([chart(name) for name in charts])
        medium = numpy.concatenate([[name] * len(chart(name)) for name in charts])
        base = random.choice(LAMPS[:3])
        self.light = lamp(base)
        self.curves = sensitivities(kind, random)
        self.white = (self.curves * self.light).sum(1)
        self.matrix = self.curves * self.light / self.white[:, None]
        order = random.permutation(len(medium))
        self.detector = random.choice(["gamma", "square", "none"]) if curved else "none"
        self.curvature = random.choice([-1.0, 1.0]) * random.uniform(0.04, 0.14) if curved else 0.0
        if fitted:
            self.fit(random, reflectance[order[:len(order) // 2]])
            order = order[len(order) // 2:]
        else:
            error = 1.0 if effects else 0.0
            moved = numpy.array([numpy.interp(FINE - error * random.normal(0, 0.3), FINE, curve) for curve in self.matrix])
            moved *= 1.0 + error * random.normal(0, 0.004, len(moved))[:, None]
            self.camera = moved @ numpy.array([numpy.interp(FINE, COARSE, one) for one in numpy.eye(len(COARSE))]).T
            self.dark = error * random.normal(0, 0.0004, len(moved))
            if len(order) > 60 and random.random() < 0.5:
                order = order[:random.integers(24, 60)]
        count = len(order)
        columns = int(numpy.ceil(numpy.sqrt(1.4 * count)))
        place = random.permutation(columns * int(numpy.ceil(count / columns)))[:count]
        self.scene = Scene(reflectance[order], medium[order], 2.0 * (place % columns) / (columns - 1) - 1.0,
                           2.0 * (place // columns) / max(int(numpy.ceil(count / columns)) - 1, 1) - 1.0, random.permutation(count))
        self.faults = [(name, self.draw(random, base)) for name in effects]

    def fit(self, random, reflectance):
        """Ridge regression with a penalty on the second differences of each channel's responsivity, and an offset."""
        seen = noisy(random, self.without_faults(self.matrix @ reflectance.T))
        spectra = CubicSpline(FINE, reflectance.T)(COARSE).T
        design = numpy.hstack([spectra, numpy.ones((len(spectra), 1))])
        rough = numpy.diff(numpy.eye(len(COARSE)), 2, axis=0)
        penalty = numpy.zeros((len(COARSE) + 1,) * 2)
        penalty[:-1, :-1] = 3e-4 * len(spectra) * rough.T @ rough
        solution = numpy.linalg.solve(design.T @ design + penalty + 1e-9 * numpy.eye(len(penalty)), design.T @ seen.T)
        self.camera, self.dark = solution[:-1].T, solution[-1]

    def without_faults(self, light):
        """By the detector as it is, without any planted effect."""
        if self.detector == "gamma":
            return numpy.sign(light) * numpy.abs(light) ** (1.0 + self.curvature)
        return light + 2.0 * self.curvature * light * (1.0 - light) if self.detector == "square" else light

    def draw(self, random, base):
        channels = len(self.matrix)
        sign = random.choice([-1.0, 1.0])
        return {"size": random.uniform(0.7, 1.4), "sign": sign, "balanced": random.random() < 0.5,
                "medium": random.choice(sorted(set(self.scene.medium))), "slope": random.normal(size=2),
                "at": random.uniform(0.25, 0.75), "drift": random.choice(["step", "slope", "warm"]),
                "curve": random.choice(["gamma", "square"]), "hard": random.random() < 0.5, "gains": random.normal(size=channels),
                "offsets": sign * (random.uniform(0.3, 1.0, channels) if random.random() < 0.5 else numpy.ones(channels)),
                "lamp": random.choice([name for name in LAMPS if name != base])}

    def answer(self, strength, scene):
        reflectance, matrix, light = scene.reflectance.copy(), self.matrix.copy(), numpy.ones(len(scene.medium))
        for name, fault in self.faults:
            size = strength * fault["size"]
            mine = scene.medium == fault["medium"]
            if name == "illuminant_drift":
                part = min(size, 1.0)
                matrix *= (1.0 - part) + part * lamp(fault["lamp"]) / self.light
            elif name == "filter_shift":
                matrix = numpy.array([numpy.interp(FINE - 30 * size * fault["sign"], FINE, curve) for curve in self.curves])
                matrix *= self.light / self.white[:, None]
            elif name == "filter_bandwidth":
                matrix = widened(self.curves, max(10 * size, 0.3)) * self.light / self.white[:, None]
            elif name == "medium_gain":
                reflectance[mine] *= 1.0 - 0.3 * size
            elif name == "specular_component":
                reflectance[mine] += 0.2 * size * fault["sign"]
            elif name == "interreflection":
                cavity = min(0.9 * size, 0.95)
                reflectance[mine] *= (1.0 - cavity) / (1.0 - cavity * reflectance[mine])
            elif name == "vignetting":
                light *= numpy.cos(numpy.arctan(1.2 * size * numpy.hypot(scene.x, scene.y))) ** 4
            elif name == "illumination_gradient":
                light *= 1.0 + size * (fault["slope"] @ [scene.x, scene.y])
            if name in ("illuminant_drift", "filter_shift", "filter_bandwidth") and fault["balanced"]:
                matrix = matrix / matrix.sum(1)[:, None]
        return self.detected((matrix @ reflectance.T) * light, strength, scene)

    def detected(self, light, strength, scene):
        seen = self.without_faults(light)
        for name, fault in self.faults:
            size = strength * fault["size"]
            sign = fault["sign"]
            if name == "veiling_glare":
                seen = seen + size * seen.mean(1)[:, None]
            elif name == "session_drift":
                time = scene.turn / max(scene.turn.max(), 1)
                shape = {"step": (time > fault["at"]).astype(float), "slope": time, "warm": 1.0 - numpy.exp(-5.0 * time)}
                seen = seen * (1.0 + 0.3 * size * sign * shape[fault["drift"]])
            elif name == "exposure_gain":
                seen = seen * (1.0 + 0.3 * size * sign)
            elif name == "channel_gain":
                seen = seen * (1.0 + 0.3 * size * fault["gains"])[:, None]
            elif name == "channel_crosstalk":
                exchanged = 0.3 * size * numpy.diff(seen, axis=0)
                seen = seen.copy()
                seen[:-1] += exchanged
                seen[1:] -= exchanged
            elif name == "detector_nonlinearity":
                seen = (numpy.sign(seen) * numpy.abs(seen) ** (1.0 + 0.5 * size * sign) if fault["curve"] == "gamma"
                        else seen - 0.4 * size * sign * seen * (1.0 - seen))
            elif name == "saturation":
                top = numpy.quantile(self.matrix @ self.scene.reflectance.T, 1.0 - 0.45 * min(size, 1.0))
                knee = 0.85 * top
                soft = knee + (top - knee) * numpy.tanh((seen - knee) / (top - knee))
                seen = numpy.minimum(seen, top) if fault["hard"] else numpy.where(seen < knee, seen, soft)
            elif name == "dark_offset":
                seen = seen + 0.1 * size * fault["offsets"][:, None]
        return seen


def noisy(random, seen):
    return seen + random.normal(size=seen.shape) * numpy.sqrt(READ ** 2 + SHOT ** 2 * numpy.maximum(seen, 0.0))


def strength_for(random, case, truth):
    """That makes a gap of a size drawn; half of the single lamps are whole."""
    if [name for name, _ in case.faults] == ["illuminant_drift"] and random.random() < 0.5:
        return 1.0 / case.faults[0][1]["size"]
    return strength_of(random.uniform(0.006, 0.03), lambda strength: case.answer(strength, case.scene) - truth, high=1.0, rounds=30)


def capture(folder, random, case, scene):
    """Writes what the camera answers to a scene, and returns it without noise."""
    seen = case.answer(case.strength, scene)
    channels = [f"C{k + 1}" for k in range(len(seen))]
    names = [f"s{i + 1}" for i in range(seen.shape[1])]
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "capture.json"), "w", encoding="utf-8") as file:
        json.dump({"name": os.path.basename(folder), "white_level": 65535, "dark": case.dark.tolist(),
                   "noise": {"read": READ if case.known else None, "shot": SHOT if case.known else None}}, file)
    table(os.path.join(folder, "camera.csv"), ["wavelength", *channels],
          [[f"{w:g}", *map("{:.9g}".format, case.camera[:, j])] for j, w in enumerate(COARSE)])
    measured = CubicSpline(FINE, scene.reflectance.T)(COARSE).T
    measured = measured + random.normal(0, SPECTROPHOTOMETER, measured.shape)
    places = [[f"{scene.x[i]:.5f}", f"{scene.y[i]:.5f}"] if scene.placed else ["", ""] for i in range(len(names))]
    table(os.path.join(folder, "samples.csv"), ["sample", "medium", "scene", "x", "y", "order", *(f"R{w:g}" for w in COARSE)],
          [[name, scene.medium[i], "one" if scene is case.scene else "", *places[i], scene.turn[i] + 1 if scene.ordered else "",
            *map("{:.5f}".format, measured[i])] for i, name in enumerate(names)])
    readings = [noisy(random, seen) for _ in range(case.repeats)]
    table(os.path.join(folder, "responses.csv"), ["sample", "repeat", *channels],
          [[name, r + 1, *map("{:.7f}".format, readings[r][:, i])] for i, name in enumerate(names) for r in range(case.repeats)])
    return seen


def write(folder, random, effects, kind, fitted, curved):
    """One case, and what the key says of it."""
    case = Case(random, effects, kind, fitted, curved)
    scene = case.scene
    truth = case.without_faults(case.matrix @ scene.reflectance.T)
    case.strength = strength_for(random, case, truth) if effects else 0.0
    case.known, case.repeats = [(True, 3), (False, 3), (False, 1)][random.integers(3)]
    seen = capture(folder, random, case, scene)
    modelled = case.camera @ CubicSpline(FINE, scene.reflectance.T)(COARSE) + case.dark[:, None]
    gap = rms(seen - modelled)
    described = f"{KINDS[kind]}; {'fitted' if fitted else 'known'}".replace(";", " and")
    told = [";".join(effects), ";".join([described] * len(effects)),
            ";".join(axis for name in effects for axis in AXES[name].split()), gap,
            max(0.0, 1.0 - rms(truth - modelled) / gap) if effects else 1.0]
    return case, told


def recommended(path):
    """The next capture of each case that has one."""
    with open(path, encoding="utf-8") as file:
        return {row["case"]: row["next_capture"] for row in csv.DictReader(file) if row["next_capture"]}


def main():
    folder, key = sys.argv[1:3]
    full = sys.argv[3:4] == ["full"]
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else 2024
    curved = sys.argv[5:6] == ["curved"]
    after = recommended(sys.argv[5]) if len(sys.argv) > 5 and not curved else None
    random = numpy.random.default_rng(seed)
    names = list(AXES)
    cases = []
    number = 1000
    os.makedirs(folder, exist_ok=True)
    for kind in KINDS if "MULTISPECTRAL_DATA" in os.environ else ():
        for fitted in (curved, True):
            singles = [[name] for name in names] if full else [["illuminant_drift"], [str(random.choice(names))]]
            pairs = [[str(name) for name in random.choice(names, 2, replace=False)] for _ in range(4 if full else 1)]
            for effects in singles + pairs + [[]]:
                number += 1
                name = f"case-{number}"
                place = os.path.join(folder, name)
                case, told = write(place, random, effects, kind, fitted, curved)
                wanted = after.get(name) if after is not None else None
                without = MEASURES.get(wanted, [])
                seen = BESIDE.get(wanted) if without else wanted
                if seen:
                    capture(os.path.join(place, "next"), numpy.random.default_rng([seed, number]), case, case.scene.after(seen))
                if after is None or (wanted and not set(without) & set(effects)):
                    cases.append([name, ("clean", "single", "several")[len(effects)], *told, ";".join(without)])
    lists(folder, key, cases)


if __name__ == "__main__":
    main()
