#!/usr/bin/env python3
"""The work of CameraSimulatorBenchmark.cpp in NumPy, as one would write it by hand.

Prints Google Benchmark's JSON, so that both can be laid side by side:  CameraSimulatorPeer.py [image side]
"""
import json
import sys
import time

import numpy as np

SIDE = int(sys.argv[1]) if len(sys.argv) > 1 else 2048
BANDS, CHANNELS = 31, 16
WAVELENGTH = np.linspace(400, 700, BANDS, dtype=np.float32)
RANDOM = np.random.default_rng(1)


def camera():
    center = 400 + 20 * np.arange(CHANNELS)[:, None]
    m = np.exp2(-((2 * (WAVELENGTH - center) / 20) ** 2)).astype(np.float32)
    return m / m.sum(1, keepdims=True)


def ideal(reflectance, m):
    return reflectance @ m.T


def add_noise(u):
    u = u * (1 + 0.002 * RANDOM.standard_normal(u.shape, np.float32))
    u += 0.0005 * RANDOM.standard_normal(u.shape, np.float32)
    u += np.sqrt(0.001**2 + 0.004**2 * np.maximum(u, 0)) * RANDOM.standard_normal(u.shape, np.float32)
    return np.rint(u * 4095) / np.float32(4095)


def reflect(reflectance, fabric):
    r = reflectance.copy()
    paper = r[~fabric]
    paper += 0.05 * np.exp(-0.5 * ((WAVELENGTH - 440) / 18) ** 2) * paper[:, :3].mean(1, keepdims=True)
    r[~fabric] = paper + np.float32(0.02)
    cotton = r[fabric]
    cotton = cotton / (1 + 0.1 * (WAVELENGTH / 550) ** 2 * cotton)
    cotton = 0.8 * cotton / (1 - 0.2 * cotton)
    r[fabric] = 0.9 * cotton
    return r


def field():
    axis = np.linspace(-1, 1, SIDE, dtype=np.float32)
    x, y = axis[None, :, None], axis[:, None, None]
    return (1 + 0.05 * x - 0.02 * y) * (1 - 0.1 * (x * x + y * y))


def detect(u):
    u = u * np.linspace(0.98, 1.01, CHANNELS, dtype=np.float32) * np.float32(1.02)
    u[..., 1:] += 0.02 * u[..., :-1]
    rows = np.arange(SIDE)[:, None, None]
    u *= (1 + 0.01 * np.sin(2 * np.pi * (rows / 64 + 0.25 * np.arange(CHANNELS)))).astype(np.float32)
    coupled = u.copy()
    coupled[..., 1:] += 0.01 * (u[..., :-1] - u[..., 1:])
    coupled[..., :-1] += 0.01 * (u[..., 1:] - u[..., :-1])
    u = coupled - 0.05 * coupled * coupled + np.float32(0.003)
    return 0.5 * (u + 0.95 - np.sqrt((u - 0.95) ** 2 + 1e-4))


def along(u, axis, offset):
    index = np.clip(np.arange(SIDE) + offset, 0, SIDE - 1)
    return np.take(u, index, axis)


def separable(u, taps):
    for axis in (0, 1):
        u = sum(weight * along(u, axis, offset) for offset, weight in taps)
    return u


def stray_light(u):
    smooth, tail, total = u, np.zeros_like(u), 0.0
    for scale in range(6):
        step = 2**scale
        spline = [(-2, 1), (-1, 4), (0, 6), (1, 4), (2, 1)]
        smooth = separable(smooth, [(i * step, np.float32(w / 16)) for i, w in spline])
        weight = 2.0 ** -(scale + 1) * np.exp(-np.sqrt((4.0 ** (scale + 1) - 1) / 3) / 16)
        tail += np.float32(weight) * smooth
        total += weight
    return u + np.float32(0.05) * (tail / np.float32(total) - u)


def defocus(u):
    deviation = 0.3 + 0.05 * np.arange(CHANNELS)
    offsets = range(-5, 6)
    weights = np.stack([np.exp(-0.5 * (i / deviation) ** 2) for i in offsets]).astype(np.float32)
    weights /= weights.sum(0)
    return separable(u, list(zip(offsets, weights)))


def register(u):
    out = np.empty_like(u)
    for k in range(CHANNELS):
        moved = u[..., k]
        for axis, displacement in ((1, -0.8 + 0.1 * k), (0, 0.001)):
            below = int(np.floor(-displacement))
            t = -displacement - below
            taps = (-0.5 * t + t**2 - 0.5 * t**3, 1 - 2.5 * t**2 + 1.5 * t**3,
                    0.5 * t + 2 * t**2 - 1.5 * t**3, -0.5 * t**2 + 0.5 * t**3)
            moved = sum(np.float32(w) * along(moved, axis, below - 1 + i) for i, w in enumerate(taps))
        out[..., k] = moved
    return out


def everything(reflectance, fabric, m):
    u = ideal(reflect(reflectance, fabric), m) * field()
    mean = u.mean((0, 1))
    u = stray_light(defocus(register(u))) + np.float32(0.02) * mean
    return add_noise(detect(u))


def main():
    reflectance = RANDOM.random((SIDE, SIDE, BANDS), np.float32)
    fabric = (np.arange(SIDE * SIDE) // 1024 % 2 == 1).reshape(SIDE, SIDE)
    m = camera()
    response = ideal(reflectance, m)
    jobs = {
        "camera/ideal": lambda: ideal(reflectance, m),
        "camera/noise": lambda: add_noise(ideal(reflectance, m)),
        "camera/pixel_effects": lambda: detect(ideal(reflect(reflectance, fabric), m) * field()),
        "camera/all_effects_and_noise": lambda: everything(reflectance, fabric, m),
        "camera/memcpy": lambda: (reflectance.copy(), response.copy()),
    }
    results = []
    for name, job in jobs.items():
        job() if name == "camera/ideal" else None
        start = time.perf_counter(), time.process_time()
        job()
        real, cpu = time.perf_counter() - start[0], time.process_time() - start[1]
        results.append({"name": name, "real_time": 1e3 * real, "cpu_time": 1e3 * cpu,
                        "time_unit": "ms", "items_per_second": SIDE * SIDE / cpu})
    json.dump({"context": {"peer": "NumPy " + np.__version__, "image_side": SIDE}, "benchmarks": results},
              sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
