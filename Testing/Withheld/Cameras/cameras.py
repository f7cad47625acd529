"""Withheld cases of cameras of many kinds, in numpy: cameras.py FOLDER KEYFILE [small|full] [SEED]

Cameras of 3, 6, 8, 16 and 30 channels, known but for small errors (where an effect is there) or fitted to half of the samples, look at measured
reflectances (with MULTISPECTRAL_DATA) under lamps of the CIE; one effect, two or none are added. Shares no code with the
other generators and none with the simulator.
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


class Case:
    """A camera before samples, and what it answers once effects of some strength are added."""

    def __init__(self, random, effects, kind, fitted):
        charts = random.choice(CHARTS, 2 if ON_A_MEDIUM & set(effects) or random.random() < 0.3 else 1, replace=False)
        self.reflectance = numpy.vstack([chart(name) for name in charts])
        self.medium = numpy.concatenate([[name] * len(chart(name)) for name in charts])
        base = random.choice(LAMPS[:3])
        self.light = lamp(base)
        self.curves = sensitivities(kind, random)
        self.white = (self.curves * self.light).sum(1)
        self.matrix = self.curves * self.light / self.white[:, None]
        order = random.permutation(len(self.medium))
        if fitted:
            half = order[:len(order) // 2]
            self.fit(random, half)
            order = order[len(order) // 2:]
        else:
            error = 1.0 if effects else 0.0
            moved = numpy.array([numpy.interp(FINE - error * random.normal(0, 0.3), FINE, curve) for curve in self.matrix])
            moved *= 1.0 + error * random.normal(0, 0.004, len(moved))[:, None]
            self.camera = moved @ numpy.array([numpy.interp(FINE, COARSE, one) for one in numpy.eye(len(COARSE))]).T
            self.dark = error * random.normal(0, 0.0004, len(moved))
            if len(order) > 60 and random.random() < 0.5:
                order = order[:random.integers(24, 60)]
        self.reflectance = self.reflectance[order]
        self.medium = self.medium[order]
        count = len(order)
        columns = int(numpy.ceil(numpy.sqrt(1.4 * count)))
        place = random.permutation(columns * int(numpy.ceil(count / columns)))[:count]
        self.x = 2.0 * (place % columns) / (columns - 1) - 1.0
        self.y = 2.0 * (place // columns) / max(int(numpy.ceil(count / columns)) - 1, 1) - 1.0
        self.turn = random.permutation(count)
        self.faults = [(name, self.draw(random, base)) for name in effects]

    def fit(self, random, samples):
        """Ridge regression with a penalty on the second differences of each channel's responsivity, and an offset."""
        seen = noisy(random, self.matrix @ self.reflectance[samples].T)
        spectra = CubicSpline(FINE, self.reflectance[samples].T)(COARSE).T
        design = numpy.hstack([spectra, numpy.ones((len(samples), 1))])
        rough = numpy.diff(numpy.eye(len(COARSE)), 2, axis=0)
        penalty = numpy.zeros((len(COARSE) + 1,) * 2)
        penalty[:-1, :-1] = 3e-4 * len(samples) * rough.T @ rough
        solution = numpy.linalg.solve(design.T @ design + penalty + 1e-9 * numpy.eye(len(penalty)), design.T @ seen.T)
        self.camera, self.dark = solution[:-1].T, solution[-1]

    def draw(self, random, base):
        channels = len(self.matrix)
        sign = random.choice([-1.0, 1.0])
        return {"size": random.uniform(0.7, 1.4), "sign": sign, "balanced": random.random() < 0.5,
                "medium": self.medium == random.choice(sorted(set(self.medium))), "slope": random.normal(size=2),
                "at": random.uniform(0.25, 0.75), "drift": random.choice(["step", "slope", "warm"]),
                "curve": random.choice(["gamma", "square"]), "hard": random.random() < 0.5, "gains": random.normal(size=channels),
                "offsets": sign * (random.uniform(0.3, 1.0, channels) if random.random() < 0.5 else numpy.ones(channels)),
                "lamp": random.choice([name for name in LAMPS if name != base])}

    def answer(self, strength):
        reflectance, matrix, light = self.reflectance.copy(), self.matrix.copy(), numpy.ones(len(self.medium))
        for name, fault in self.faults:
            size = strength * fault["size"]
            mine = fault["medium"]
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
                light *= numpy.cos(numpy.arctan(1.2 * size * numpy.hypot(self.x, self.y))) ** 4
            elif name == "illumination_gradient":
                light *= 1.0 + size * (fault["slope"] @ [self.x, self.y])
            if name in ("illuminant_drift", "filter_shift", "filter_bandwidth") and fault["balanced"]:
                matrix = matrix / matrix.sum(1)[:, None]
        return self.detected((matrix @ reflectance.T) * light, strength)

    def detected(self, seen, strength):
        for name, fault in self.faults:
            size = strength * fault["size"]
            sign = fault["sign"]
            if name == "veiling_glare":
                seen = seen + size * seen.mean(1)[:, None]
            elif name == "session_drift":
                time = self.turn / (len(self.turn) - 1)
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
                top = numpy.quantile(self.matrix @ self.reflectance.T, 1.0 - 0.45 * min(size, 1.0))
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
    return strength_of(random.uniform(0.006, 0.03), lambda strength: case.answer(strength) - truth, high=1.0, rounds=30)


def write(folder, random, effects, kind, fitted):
    """One case; returns what the key says of it."""
    case = Case(random, effects, kind, fitted)
    truth = case.matrix @ case.reflectance.T
    seen = case.answer(strength_for(random, case, truth)) if effects else truth
    known, repeats = [(True, 3), (False, 3), (False, 1)][random.integers(3)]
    channels = [f"C{k + 1}" for k in range(len(seen))]
    names = [f"s{i + 1}" for i in range(seen.shape[1])]
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "capture.json"), "w", encoding="utf-8") as file:
        json.dump({"name": os.path.basename(folder), "white_level": 65535, "dark": case.dark.tolist(),
                   "noise": {"read": READ if known else None, "shot": SHOT if known else None}}, file)
    table(os.path.join(folder, "camera.csv"), ["wavelength", *channels],
          [[f"{w:g}", *map("{:.9g}".format, case.camera[:, j])] for j, w in enumerate(COARSE)])
    measured = CubicSpline(FINE, case.reflectance.T)(COARSE).T
    measured = measured + random.normal(0, SPECTROPHOTOMETER, measured.shape)
    table(os.path.join(folder, "samples.csv"), ["sample", "medium", "scene", "x", "y", "order", *(f"R{w:g}" for w in COARSE)],
          [[name, case.medium[i], "one", f"{case.x[i]:.5f}", f"{case.y[i]:.5f}", case.turn[i] + 1,
            *map("{:.5f}".format, measured[i])] for i, name in enumerate(names)])
    readings = [noisy(random, seen) for _ in range(repeats)]
    table(os.path.join(folder, "responses.csv"), ["sample", "repeat", *channels],
          [[name, r + 1, *map("{:.7f}".format, readings[r][:, i])] for i, name in enumerate(names) for r in range(repeats)])
    modelled = case.camera @ CubicSpline(FINE, case.reflectance.T)(COARSE) + case.dark[:, None]
    gap = rms(seen - modelled)
    described = f"{KINDS[kind]}; {'fitted' if fitted else 'known'}".replace(";", " and")
    return [";".join(effects), ";".join([described] * len(effects)),
            ";".join(axis for name in effects for axis in AXES[name].split()), gap,
            max(0.0, 1.0 - rms(truth - modelled) / gap) if effects else 1.0]


def main():
    folder, key = sys.argv[1:3]
    full = sys.argv[3:4] == ["full"]
    random = numpy.random.default_rng(int(sys.argv[4]) if len(sys.argv) > 4 else 2024)
    names = list(AXES)
    cases = []
    os.makedirs(folder, exist_ok=True)
    for kind in KINDS if "MULTISPECTRAL_DATA" in os.environ else ():
        for fitted in (False, True):
            singles = [[name] for name in names] if full else [["illuminant_drift"], [str(random.choice(names))]]
            pairs = [[str(name) for name in random.choice(names, 2, replace=False)] for _ in range(4 if full else 1)]
            for effects in singles + pairs + [[]]:
                name = f"case-{1001 + len(cases)}"
                told = write(os.path.join(folder, name), random, effects, kind, fitted)
                cases.append([name, ("clean", "single", "several")[len(effects)], *told])
    lists(folder, key, cases)


if __name__ == "__main__":
    main()
