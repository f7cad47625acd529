#!/usr/bin/env python3
"""The work of CameraSimulatorBenchmark.cpp in NumPy and SciPy, single precision, a plane a channel, in place where it can.

Each image filter is the fastest of the ways tried: sums of shifted planes for the broad tail (an FFT with padded edges
takes longer), scipy.ndimage for the blur. First both programs' results are compared, without noise, on a small image;
then prints Google Benchmark's JSON, so that both can be laid side by side:  CameraSimulatorPeer.py [image side]
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy import ndimage

BANDS, CHANNELS = 31, 16
WAVELENGTH = np.linspace(400, 700, BANDS, dtype=np.float32)
RANDOM = np.random.default_rng(1)
F = np.float32
PROGRAM = pathlib.Path(os.environ.get(
    "MULTISPECTRAL_BENCHMARKS",
    pathlib.Path(__file__).resolve().parents[2] / "build/bench/Testing/Benchmarks")) / "BenchmarkCameraSimulator"
CHECK_SIDE = 320
TOLERANCE = 3e-6


def scene(side):
    index = np.arange(side * side * BANDS, dtype=np.uint64)
    step = (index * np.uint64(2654435761)) % np.uint64(1024)
    reflectance = F(0.05) + F(0.9) * step.astype(F) / F(1024)
    fabric = np.arange(side * side) // 1024 % 2 == 1
    return reflectance.reshape(-1, BANDS), fabric


def ideal(reflectance, m):
    """One row a channel."""
    return np.ascontiguousarray((reflectance @ m.T).T)


def add_noise(u):
    gain = RANDOM.standard_normal(u.shape, F)
    gain *= F(0.002)
    gain += F(1)
    u *= gain
    for plane in u:
        offset = RANDOM.standard_normal(plane.shape, F)
        offset *= F(0.0005)
        plane += offset
        deviation = np.maximum(plane, 0)
        deviation *= F(0.004**2)
        deviation += F(0.001**2)
        np.sqrt(deviation, out=deviation)
        deviation *= F(1.2)
        deviation *= RANDOM.standard_normal(plane.shape, F)
        plane += deviation
        plane *= F(4095)
        np.rint(plane, out=plane)
        plane *= F(1 / 4095)
    return u


def reflect(reflectance, fabric):
    r = np.empty_like(reflectance)
    paper = reflectance[~fabric]
    paper += F(0.02)
    emission = (0.05 * np.exp(-0.5 * ((WAVELENGTH - 440) / 18) ** 2)).astype(F)
    paper += paper[:, :3].mean(1, keepdims=True) * emission
    r[~fabric] = paper
    cotton = reflectance[fabric]
    lossy = cotton * (0.1 * (WAVELENGTH / 550) ** 2).astype(F)
    lossy += F(1)
    cotton /= lossy
    cavity = cotton * F(-0.2)
    cavity += F(1)
    cotton *= F(0.8 * 0.9)
    cotton /= cavity
    r[fabric] = cotton
    return r


def illuminate(u, side):
    half = 0.5 * (side - 1)
    axis = (np.arange(side) - half) / half
    x, y = axis[None, :], axis[:, None]
    field = ((1 + 0.05 * x - 0.02 * y) * (1 - 0.1 * (x * x + y * y))).astype(F).ravel()
    for plane in u:
        plane *= field
    return u


def detect(u, side):
    for k in range(CHANNELS - 1, 0, -1):
        u[k] += F(0.02) * u[k - 1]
    rows = np.arange(side) / 64.0
    for k, plane in enumerate(u):
        band = 1 + 0.01 * np.sin(2 * np.pi * (rows + 0.25 * k))
        plane.reshape(side, side)[...] *= (1.02 * (0.98 + 0.002 * k) * band).astype(F)[:, None]
    coupled = u.copy()
    difference = u[1:] - u[:-1]
    difference *= F(0.01)
    coupled[1:] -= difference
    coupled[:-1] += difference
    for plane in coupled:
        plane *= F(1) - F(0.05) * plane
        plane += F(0.003)
        beyond = plane - F(0.95)
        beyond *= beyond
        beyond += F(0.01**2)
        np.sqrt(beyond, out=beyond)
        plane += F(0.95)
        plane -= beyond
        plane *= F(0.5)
    return coupled


def spline(plane, step, axis, scratch):
    """The B3 spline with holes along an axis; the edge repeats."""
    width = [(0, 0), (0, 0)]
    width[axis] = (2 * step, 2 * step)
    padded = np.pad(plane, width, mode="edge")
    size = plane.shape[axis]
    part = [padded[i * step:i * step + size] if axis == 0 else padded[:, i * step:i * step + size]
            for i in range(5)]
    np.add(part[1], part[3], out=plane)
    plane *= F(4 / 16)
    np.multiply(part[2], F(6 / 16), out=scratch)
    plane += scratch
    np.add(part[0], part[4], out=scratch)
    scratch *= F(1 / 16)
    plane += scratch


def stray_light(plane):
    smooth, tail, scratch = plane.copy(), np.zeros_like(plane), np.empty_like(plane)
    weights = []
    for scale in range(1, 10):
        weight = 2.0**-scale * np.exp(-np.sqrt((4.0**scale - 1) / 3) / 16)
        if scale > 2 and weight < 1e-4 * sum(weights):
            break
        weights.append(weight)
    for scale, weight in enumerate(weights):
        for axis in (1, 0):
            spline(smooth, 2**scale, axis, scratch)
        np.multiply(smooth, F(0.05 * weight / sum(weights)), out=scratch)
        tail += scratch
    plane *= F(0.95)
    plane += tail


def defocus(plane, k):
    deviation = 0.3 + 0.05 * k
    reach = int(4 * deviation)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / deviation) ** 2)
    weights /= weights.sum()
    for axis in (1, 0):
        plane = ndimage.correlate1d(plane, weights, axis, mode="nearest")
    return plane


def register(plane, k, side):
    middle = 0.5 * (side - 1)
    for axis, displacement in ((1, -0.8 + 0.1 * k), (0, 0.001)):
        place = middle + (np.arange(side) - middle - displacement) / 1.001
        below = np.floor(place)
        t = place - below
        taps = (-0.5 * t + t**2 - 0.5 * t**3, 1 - 2.5 * t**2 + 1.5 * t**3,
                0.5 * t + 2 * t**2 - 1.5 * t**3, -0.5 * t**2 + 0.5 * t**3)
        moved = 0
        for i, weight in enumerate(taps):
            index = np.clip(below.astype(int) - 1 + i, 0, side - 1)
            part = np.take(plane, index, axis)
            part *= weight.astype(F)[:, None] if axis == 0 else weight.astype(F)
            moved = part if i == 0 else np.add(moved, part, out=moved)
        plane = moved
    return plane


def pixel_effects(reflectance, fabric, m, side):
    return detect(illuminate(ideal(reflect(reflectance, fabric), m), side), side)


def all_effects(reflectance, fabric, m, side):
    u = illuminate(ideal(reflect(reflectance, fabric), m), side)
    mean = u.mean(1, dtype=np.float64)
    for k in range(CHANNELS):
        plane = defocus(register(u[k].reshape(side, side), k, side), k)
        stray_light(plane)
        plane += F(0.02 * mean[k])
        u[k] = plane.ravel()
    return detect(u, side)


def responsivity(folder, name):
    return np.fromfile(folder / (name + ".responsivity"), F).reshape(CHANNELS, BANDS)


def compare(folder):
    """The responsivities of the two cameras; ends the program where the results differ."""
    subprocess.run([PROGRAM, "--results", folder, str(CHECK_SIDE)], check=True, stdout=subprocess.DEVNULL)
    reflectance, fabric = scene(CHECK_SIDE)
    plain, changed = responsivity(folder, "ideal"), responsivity(folder, "all_effects")
    for name, ours in (("ideal", ideal(reflectance, plain)),
                       ("pixel_effects", pixel_effects(reflectance, fabric, changed, CHECK_SIDE)),
                       ("all_effects", all_effects(reflectance, fabric, changed, CHECK_SIDE))):
        theirs = np.fromfile(folder / (name + ".response"), F).reshape(-1, CHANNELS).T
        difference = np.abs(ours - theirs).max()
        if not difference < TOLERANCE:
            sys.exit(f"{name}: the results differ by {difference:.2g}, more than {TOLERANCE:.2g}")
        print(f"{name}: the results agree to {difference:.2g}", file=sys.stderr)
    return plain, changed


def main():
    side = int(sys.argv[1]) if len(sys.argv) > 1 else 2048
    with tempfile.TemporaryDirectory() as folder:
        plain, changed = compare(pathlib.Path(folder))
    reflectance, fabric = scene(side)
    response = ideal(reflectance, plain)
    jobs = {
        "camera/ideal": lambda: reflectance @ plain.T,
        "camera/noise": lambda: add_noise(ideal(reflectance, plain)),
        "camera/pixel_effects": lambda: pixel_effects(reflectance, fabric, changed, side),
        "camera/all_effects_and_noise": lambda: add_noise(all_effects(reflectance, fabric, changed, side)),
        "camera/memcpy": lambda: (reflectance.copy(), response.copy()),
    }
    results = []
    for name, job in jobs.items():
        job() if name == "camera/ideal" else None
        start = time.perf_counter(), time.process_time()
        job()
        real, cpu = time.perf_counter() - start[0], time.process_time() - start[1]
        results.append({"name": name, "real_time": 1e3 * real, "cpu_time": 1e3 * cpu,
                        "time_unit": "ms", "items_per_second": side * side / cpu})
    json.dump({"context": {"peer": "NumPy " + np.__version__, "image_side": side}, "benchmarks": results},
              sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
