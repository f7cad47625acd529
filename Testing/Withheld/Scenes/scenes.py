"""Withheld image pairs of many kinds of scenes, in numpy: scenes.py FOLDER KEYFILE [small|full] [SEED]

Overlapping leaves, a chart, or (with MULTISPECTRAL_DATA) a photograph through a filter wheel, seen through 3 to 12 channels, with the errors of a
model of the scene and with files of 8, 12 or 16 bits; one effect, two, one that the library does not have, or none is added. Shares no code with
the other generators and none with the simulator.
"""

import os
import sys

import numpy
from scipy import ndimage, signal

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Cases"))
from cases import lists, rms, strength_of  # noqa: E402

PARTS = 3  # of a pixel, along each axis
MARGIN = 12  # pixels around the image


def smooth(random, shape, reach):
    """A random surface of mean 0 and deviation 1."""
    surface = ndimage.gaussian_filter(random.normal(size=shape), reach, mode="wrap")
    return (surface - surface.mean()) / surface.std()


class Scene:
    """What lies before the camera, PARTS times as fine as its pixels: light(k), and the number of the object at each place."""

    def __init__(self, random, kind):
        self.width, self.height = int(random.integers(150, 330)), int(random.integers(120, 260))
        self.channels = int(random.choice([3, 4, 6, 8, 12]))
        shape = ((self.height + 2 * MARGIN) * PARTS, (self.width + 2 * MARGIN) * PARTS)
        centers = numpy.linspace(420, 680, self.channels)
        if kind == "photograph":
            self.photograph()
            return
        self.objects = numpy.zeros(shape, int)
        down, right = numpy.mgrid[:shape[0], :shape[1]] / PARTS
        if kind == "chart":
            columns, rows = random.integers(4, 11), random.integers(3, 8)
            pitch = numpy.array([shape[1] / PARTS / columns, shape[0] / PARTS / rows])
            part = numpy.stack([right / pitch[0] % 1.0, down / pitch[1] % 1.0])
            inside = (numpy.abs(part - 0.5) < random.uniform(0.3, 0.44)).all(0)
            self.objects = numpy.where(inside, 1 + (down // pitch[1]).astype(int) * columns + (right // pitch[0]).astype(int), 0)
        else:
            for n in range(1, 160):
                at = random.uniform(0, shape[1] / PARTS), random.uniform(0, shape[0] / PARTS)
                radius = 6.0 * random.pareto(1.5) + 4.0
                squeezed, turn = random.uniform(0.4, 1.0), random.uniform(0, numpy.pi)
                x, y = right - at[0], down - at[1]
                along, across = x * numpy.cos(turn) + y * numpy.sin(turn), y * numpy.cos(turn) - x * numpy.sin(turn)
                self.objects[along ** 2 + (across / squeezed) ** 2 < min(radius, 60) ** 2] = n
        count = self.objects.max() + 1
        level = random.beta(1.1, 1.6, count)
        bumps = [(random.uniform(380, 720, count), random.uniform(25, 90, count), random.normal(0, 1.3, count)) for _ in range(3)]
        logit = numpy.log((level + 0.02) / (1.02 - level))[:, None] + sum(
            size[:, None] * numpy.exp(-0.5 * ((centers - at[:, None]) / wide[:, None]) ** 2) for at, wide, size in bumps)
        self.colors = 0.015 + 0.92 / (1.0 + numpy.exp(-logit))
        self.texture = 1.0 + (0.0 if kind == "chart" else 0.05) * smooth(random, shape, random.uniform(1, 4) * PARTS)
        self.texture += (0.0 if kind == "chart" else 0.08) * smooth(random, shape, 30 * PARTS)

    def photograph(self):
        from PIL import Image
        folder = os.path.join(os.environ["MULTISPECTRAL_DATA"], "filterwheel-cc24")
        names = sorted(name for name in os.listdir(folder) if name.startswith("channel_"))
        planes = [numpy.asarray(Image.open(os.path.join(folder, name)), float) for name in names]
        planes = [plane / numpy.quantile(plane, 0.997) for plane in planes]
        self.channels = len(planes)
        self.height, self.width = planes[0].shape[0] - 2 * MARGIN, planes[0].shape[1] - 2 * MARGIN
        self.planes = [ndimage.zoom(ndimage.gaussian_filter(plane, 0.8), PARTS, order=1, grid_mode=True, mode="nearest") for plane in planes]
        self.objects = None

    def light(self, k, colors):
        return self.planes[k] * colors[k] if self.objects is None else colors[self.objects, k] * self.texture

    def wrong_colors(self, random, error):
        """Of the model of the scene."""
        if self.objects is None:
            return numpy.ones(self.channels)
        return self.colors * (1.0 + error * random.normal(size=self.colors.shape))


def disk(radius):
    reach = int(numpy.ceil(radius * PARTS)) + 1
    y, x = numpy.mgrid[-reach:reach + 1, -reach:reach + 1] / PARTS
    weights = numpy.clip((radius - numpy.hypot(x, y)) * PARTS + 0.5, 0.0, 1.0)
    return weights / weights.sum()


class Camera:
    """What it answers once faults of some strength are added."""

    def __init__(self, random, scene, effects):
        self.scene = scene
        self.blur = random.uniform(0.25, 0.7)
        self.small = {"gain": numpy.zeros(scene.channels), "dark": numpy.zeros(scene.channels), "move": numpy.zeros((scene.channels, 2))}
        self.faults = [(name, self.draw(random)) for name in effects]

    def imperfect(self, random):
        channels = self.scene.channels
        self.small = {"gain": random.normal(0, 0.003, channels), "dark": random.normal(0, 0.0003, channels), "move": random.normal(0, 0.02, (channels, 2))}

    def draw(self, random):
        channels = self.scene.channels
        each = random.random() < 0.5
        return {"sign": random.choice([-1.0, 1.0]), "gains": random.normal(size=channels), "each": each,
                "offsets": random.uniform(0.4, 1.0, channels) if each else numpy.ones(channels), "kind": int(random.integers(3)),
                "move": random.normal(size=(channels, 2)), "turn": random.normal(), "color": numpy.linspace(-1, 1, channels), "center": random.normal(0, 0.08, 2),
                "angle": random.uniform(0, 2 * numpy.pi), "rows": random.random() < 0.5, "lines": random.normal(size=(channels, 4000)),
                "period": random.uniform(8, 40), "phase": random.uniform(0, 1), "radius": random.uniform(5, 25), "at": random.uniform(-0.7, 0.7, 2),
                "spots": random.uniform(-1, 1, (14, 2)), "leak": random.uniform(0, 1, (channels, channels))}

    def geometry(self, k, strength):
        """Displacement of the image at x, y, both from the middle, in pixels, and its growth by the square of the distance and by the place."""
        matrix, move = numpy.eye(2), self.small["move"][k].copy()
        bend, slope = 0.0, numpy.zeros(2)
        for name, fault in self.faults:
            if name == "misregistration":
                size = 3.0 * strength
                if fault["kind"] == 0:
                    move += size * fault["move"][k]
                elif fault["kind"] == 1:
                    matrix = matrix * (1.0 + 0.01 * size * fault["color"][k])
                else:
                    move += size * fault["move"][k] * 0.5
                    angle = 0.01 * size * fault["turn"] * fault["color"][k]
                    matrix = matrix @ [[numpy.cos(angle), -numpy.sin(angle)], [numpy.sin(angle), numpy.cos(angle)]]
            elif name == "distortion" and fault["kind"] < 2:
                bend += 0.06 * strength * fault["sign"]
            elif name == "distortion":
                slope += 0.06 * strength * numpy.array([numpy.sin(fault["angle"]), numpy.cos(fault["angle"])])
        return numpy.linalg.inv(matrix), move, bend, slope

    def seen(self, k, strength):
        scene = self.scene
        plane = scene.light(k, self.colors)
        matrix, move, bend, slope = self.geometry(k, strength)
        middle = 0.5 * (numpy.array(plane.shape) - 1)
        if bend or slope.any():
            y, x = numpy.mgrid[:plane.shape[0], :plane.shape[1]]
            y, x = y - middle[0], x - middle[1]
            larger = 1.0 + bend * (x ** 2 + y ** 2) / middle[1] ** 2 + (slope[0] * y + slope[1] * x) / middle[1]
            plane = ndimage.map_coordinates(plane, [y * larger + middle[0], x * larger + middle[1]], order=1, mode="nearest")
        if (move != 0).any() or (matrix != numpy.eye(2)).any():
            plane = ndimage.affine_transform(plane, matrix, middle - matrix @ (middle + move[::-1] * PARTS), order=1, mode="nearest")
        plane = ndimage.gaussian_filter(plane, self.blur * PARTS)
        for name, fault in self.faults:
            if name == "? sharpened":
                plane = plane + 4.0 * strength * (plane - ndimage.gaussian_filter(plane, PARTS))
            if name == "defocus":
                part = abs(fault["color"][k] - fault["at"][0]) if fault["each"] else 1.0
                radius = 8.0 * strength * part
                if radius > 0.2:
                    plane = ndimage.convolve(plane, disk(min(radius, 4.0))) if fault["kind"] else ndimage.gaussian_filter(plane, 0.5 * radius * PARTS)
        edge = MARGIN * PARTS
        plane = plane[edge:-edge, edge:-edge]
        return plane.reshape(scene.height, PARTS, scene.width, PARTS).mean((1, 3))

    def answer(self, strength):
        scene, size = self.scene, strength
        u = numpy.stack([self.seen(k, strength) for k in range(scene.channels)])
        down, right = numpy.mgrid[:scene.height, :scene.width]
        half = 0.5 * (max(scene.width, scene.height) - 1)
        x, y = (right - 0.5 * (scene.width - 1)) / half, (down - 0.5 * (scene.height - 1)) / half
        for name, fault in self.faults:
            if name == "illuminant_drift":  # another voltage: a power of the wavelength, seen in narrow bands; or a phosphor with more blue
                place = fault["color"][:, None, None]
                u = u * ((1.0 + 0.25 * place) ** (8.0 * size * fault["sign"]) if fault["kind"] else
                         1.0 + 2.0 * size * fault["sign"] / (1.0 + numpy.exp(3.0 * place + 1.5)))
            cx, cy = fault["center"]
            r2 = (x - cx) ** 2 + (y - cy) ** 2
            along = x * numpy.cos(fault["angle"]) + y * numpy.sin(fault["angle"])
            if name == "vignetting":
                u = u * (numpy.cos(numpy.arctan(numpy.sqrt(2.0 * size * r2))) ** 4 if fault["kind"] else 1.0 - 1.2 * size * r2 ** 2)
            elif name == "illumination_gradient":
                u = u * (numpy.exp(1.2 * size * along) if fault["kind"] else (1.0 + 0.09 * size) / ((1.0 - 2.0 * size * along) ** 2 + 0.09 * size))
            elif name == "veiling_glare":
                mean = u.mean((1, 2), keepdims=True)
                u = u + size * (mean if fault["each"] else mean - u)
            elif name == "ghost_reflection":
                u = u + size * ndimage.gaussian_filter(u[:, ::-1, ::-1], (0, *[2.0 * fault["kind"]] * 2)) * (fault["offsets"][:, None, None])
            elif name == "local_stray_light":
                reach = fault["radius"]
                yy, xx = numpy.mgrid[-60:61, -60:61]
                distance = numpy.hypot(xx, yy)
                tail = numpy.exp(-distance / reach) if fault["kind"] else (1.0 + (distance / reach) ** 2) ** -1.5
                fraction = min(2.0 * size, 0.8)
                padded = numpy.pad(u, ((0, 0), (60, 60), (60, 60)), mode="edge")
                u = (1.0 - fraction) * u + fraction * signal.fftconvolve(padded, (tail / tail.sum())[None], mode="valid", axes=(1, 2))
            elif name == "? lamp mirrored":
                u = u + size * numpy.exp(-((x - fault["at"][0]) ** 2 + (y - fault["at"][1]) ** 2) / 0.03)
            elif name == "? dust":
                for at in fault["spots"]:
                    u = u * (1.0 - min(4.0 * size, 0.9) / (1.0 + numpy.exp((numpy.hypot(x - at[0], y - at[1]) - 0.07) / 0.01)))
        u = u * (1.0 + self.small["gain"])[:, None, None]
        for name, fault in self.faults:
            kind, sign = fault["kind"], fault["sign"]
            if name == "lag":
                u = numpy.concatenate([u[:1], u[1:] + 1.5 * size * (u[:-1] - (u[1:] if fault["each"] else 0.0))])
            elif name == "channel_crosstalk":
                weights = numpy.exp(-numpy.abs(numpy.subtract.outer(range(len(u)), range(len(u)))) / 0.7) * fault["leak"] if kind else (
                    numpy.eye(len(u), k=1) + numpy.eye(len(u), k=-1))
                numpy.fill_diagonal(weights, 0.0)
                weights *= size
                u = u + numpy.tensordot(weights, u, 1) - weights.sum(1)[:, None, None] * u
            elif name == "banding":
                lines = fault["lines"][:, :scene.height if fault["rows"] else scene.width]
                if kind == 0:
                    lines = numpy.sin(2 * numpy.pi * (numpy.arange(lines.shape[1]) / fault["period"] + fault["phase"]))[None]
                lines = lines[:1] if not fault["each"] else lines
                u = u * (1.0 + size * (lines[:, :, None] if fault["rows"] else lines[:, None, :]))
            elif name == "exposure_gain":
                u = u * (1.0 + size * sign)
            elif name == "channel_gain":
                u = u * (1.0 + size * fault["gains"])[:, None, None]
            elif name == "detector_nonlinearity":
                u = u ** (1.0 + size * sign) if kind == 0 else u + size * sign * u * (1.0 - u) if kind == 1 else u - size * u ** 3
            elif name == "saturation":
                top = numpy.quantile(u, 1.0 - 0.7 * min(size, 1.0))
                knee = 0.85 * top
                u = numpy.where(u < knee, u, knee + (top - knee) * numpy.tanh((u - knee) / (top - knee))) if kind == 0 else numpy.minimum(u, top)
            elif name == "dark_offset":
                u = u + size * sign * fault["offsets"][:, None, None]
            elif name == "? two taps":
                u = numpy.where(x > 0.3 * fault["at"][0], u * (1.0 + size), u)
            elif name == "? glow":
                u = u + size * numpy.exp(((x - 1.0) ** 2 + (y - 1.0) ** 2) / -0.15)
        return u + self.small["dark"][:, None, None]


EFFECTS = ["banding", "channel_crosstalk", "channel_gain", "dark_offset", "defocus", "detector_nonlinearity", "distortion", "exposure_gain",
           "ghost_reflection", "illuminant_drift", "illumination_gradient", "lag", "local_stray_light", "misregistration", "saturation", "veiling_glare", "vignetting"]
STRANGERS = ["? sharpened", "? lamp mirrored", "? dust", "? two taps", "? glow"]
AXES = {"banding": "rows columns", "channel_crosstalk": "channel sample region", "channel_gain": "channel level", "dark_offset": "channel level",
        "defocus": "edges", "detector_nonlinearity": "level", "distortion": "edges region", "exposure_gain": "level channel",
        "ghost_reflection": "region position sample edges channel level",
        "illuminant_drift": "channel level", "illumination_gradient": "position", "lag": "channel level sample region", "local_stray_light": "edges position level region channel",
        "misregistration": "edges region", "saturation": "level", "veiling_glare": "channel level", "vignetting": "position"}


def write(folder, random, effects, kind, exact):
    scene = Scene(random, kind)
    camera = Camera(random, scene, effects)
    camera.colors = numpy.ones(scene.channels) if scene.objects is None else scene.colors
    model = camera.answer(0.0)
    strength = 0.0
    if effects:
        strength = strength_of(random.uniform(0.006, 0.03), lambda tried: camera.answer(tried) - model, high=0.6, rounds=8)
    if not exact:
        camera.imperfect(random)
    real = camera.answer(strength)
    # The model of the scene has other colors than the scene.
    if not exact:
        camera.faults, camera.small = [], {name: 0.0 * value for name, value in camera.small.items()}
        camera.colors = scene.wrong_colors(random, 0.004)
        model = camera.answer(0.0)
    read, shot = numpy.exp(random.uniform(numpy.log(0.0005), numpy.log(0.003))), numpy.exp(random.uniform(numpy.log(0.001), numpy.log(0.008)))
    real = real + random.normal(size=real.shape) * numpy.sqrt(read ** 2 + shot ** 2 * numpy.maximum(real, 0.0))
    bits = int(random.choice([8, 12, 16]))
    real = numpy.clip(numpy.round(real * (2 ** bits - 1) * 0.8), -2 ** bits, 2 ** bits - 1) / (2 ** bits - 1) / 0.8
    labels = None
    if kind == "chart" and random.random() < 0.6:
        edge = MARGIN * PARTS
        whole = scene.objects[edge:-edge, edge:-edge]
        same = ndimage.minimum_filter(whole, 4 * PARTS) == ndimage.maximum_filter(whole, 4 * PARTS)
        labels = numpy.where(same, whole, 0)[PARTS // 2::PARTS, PARTS // 2::PARTS]
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, "pair.bin"), "wb") as file:
        numpy.array([scene.width, scene.height, scene.channels, int(labels is not None)], numpy.int32).tofile(file)
        for image in (real, model):
            numpy.moveaxis(image, 0, -1).astype(numpy.float32).tofile(file)
        if labels is not None:
            labels.astype(numpy.int32).tofile(file)
    described = f"{kind} of {scene.channels} channels and {bits} bits"
    known = [name for name in effects if name[0] != "?"]
    described += "".join(" " + name for name in effects if name not in known)
    return [";".join(known) if known or not effects else "?", ";".join([described] * len(effects)),
            ";".join(axis for name in known for axis in AXES[name].split()), rms(real - model), 1.0]


def main():
    folder, key = sys.argv[1:3]
    full = sys.argv[3:4] == ["full"]
    random = numpy.random.default_rng(int(sys.argv[4]) if len(sys.argv) > 4 else 2024)
    kinds = ["leaves", "chart"] + ["photograph"] * ("MULTISPECTRAL_DATA" in os.environ)
    cases = []
    os.makedirs(folder, exist_ok=True)
    for exact in (True, False):
        wanted = [("single", [name]) for name in EFFECTS for _ in kinds if full or random.random() < 0.2]
        wanted += [("several", [str(name) for name in random.choice(EFFECTS, 2, replace=False)]) for _ in range(12 if full else 2)]
        wanted += [("stranger", [name]) for name in STRANGERS for _ in range(2 if full else 1)]
        wanted += [("clean", [])] * ((6 if full else 1) if exact else 0)
        for n, (group, effects) in enumerate(wanted):
            name = f"case-{1001 + len(cases)}"
            told = write(os.path.join(folder, name), random, effects, kinds[n % len(kinds)], exact)
            nominal = {"single": "nominal", "several": "nominal several"}.get(group, group)
            cases.append([name, group if exact else nominal, *told, ""])
    lists(folder, key, cases)


if __name__ == "__main__":
    main()
