"""The linear estimation methods a second time, in NumPy, as the reference for the C++ kernels.

    reference_estimation.py check PROBE      fresh random problems, solved by PROBE and here
    reference_estimation.py write FILE       a few problems with their solutions, for the unit tests

Matrices travel as text: a line "name rows columns", then one line per row.
"""
import subprocess
import sys

import numpy as np

TOLERANCE = 1e-9


def with_constant(x):
    return np.vstack([x, np.ones(x.shape[1])])


def banded_rows(x, target, neighbours):
    n = x.shape[0]
    rows = np.zeros((n, n + 1))
    for i in range(n):
        free = [j for j in range(i - neighbours, i + neighbours + 1) if 0 <= j < n] + [n]
        rows[i, free] = np.linalg.lstsq(with_constant(x)[free].T, target[i], rcond=None)[0]
    return rows


def solve(R, U, S, V, neighbours, rounds=2):
    direct = R @ np.linalg.pinv(with_constant(U), rcond=1e-15)
    r_model = banded_rows(direct @ with_constant(V), S, 1)
    affine_direct = np.vstack([direct, np.eye(1, direct.shape[1], direct.shape[1] - 1)])
    eta = np.sqrt(R.shape[1] / S.shape[1])
    w = direct
    for _ in range(rounds):
        d = banded_rows(V, np.linalg.pinv(w[:, :-1]) @ (S - w[:, -1:]), neighbours)
        corrected = with_constant(d @ with_constant(V))
        w = np.hstack([R, eta * S]) @ np.linalg.pinv(
            np.hstack([with_constant(U), eta * corrected]), rcond=1e-15)
    affine_d = np.vstack([d, np.eye(1, d.shape[1], d.shape[1] - 1)])
    return {
        "direct": direct,
        "pinv": S @ np.linalg.pinv(with_constant(V), rcond=1e-15),
        "pooled": np.hstack([R, S]) @ np.linalg.pinv(with_constant(np.hstack([U, V])), rcond=1e-15),
        "r_model": r_model @ affine_direct,
        "banded_w": w,
        "banded_d": d,
        "banded": w @ affine_d,
    }


def problem(generator, bands, channels, calibration, tuning, neighbours):
    """Smooth reflectances, overlapping filters, a target medium with its own gain and offset."""
    wavelength = np.linspace(0.0, 1.0, bands)

    def reflectances(count):
        centers = generator.uniform(-0.2, 1.2, (3, count))
        widths = generator.uniform(0.05, 0.4, (3, count))
        heights = generator.uniform(0.05, 0.35, (3, count))
        bumps = heights * np.exp(-((wavelength[:, None, None] - centers) / widths) ** 2)
        return bumps.sum(axis=1) + generator.uniform(0.02, 0.05, count)

    position = np.linspace(0.0, 1.0, channels)
    M = np.exp(-((wavelength - position[:, None]) * channels / 1.5) ** 2)
    M /= M.sum(axis=1, keepdims=True)
    R, S = reflectances(calibration), reflectances(tuning)
    gain = 1.0 + 0.1 * generator.standard_normal((channels, 1))
    U = M @ R + 0.01 + 0.002 * generator.standard_normal((channels, calibration))
    V = gain * (M @ S) + 0.02 + 0.002 * generator.standard_normal((channels, tuning))
    return {"R": R, "U": U, "S": S, "V": V, "neighbours": np.array([[float(neighbours)]])}


def to_text(matrices):
    lines = []
    for name, matrix in matrices.items():
        lines.append(f"{name} {matrix.shape[0]} {matrix.shape[1]}")
        lines += [" ".join(repr(float(value)) for value in row) for row in matrix]
    return "\n".join(lines) + "\n"


def from_text(text):
    lines = iter(text.splitlines())
    matrices = {}
    for line in lines:
        name, rows, columns = line.split()
        matrices[name] = np.array([[float(value) for value in next(lines).split()]
                                   for _ in range(int(rows))]).reshape(int(rows), int(columns))
    return matrices


SHAPES = [  # bands, channels, calibration, tuning, neighbours
    (31, 16, 96, 24, 1), (31, 9, 96, 16, 0), (31, 7, 24, 10, 1), (16, 6, 40, 12, 1),
    (31, 12, 200, 5, 0), (10, 3, 20, 8, 1),
]


def check(probe):
    generator = np.random.default_rng(20110401)
    worst = 0.0
    for shape in SHAPES:
        given = problem(generator, *shape)
        answer = subprocess.run([probe], input=to_text(given), text=True, check=True,
                                stdout=subprocess.PIPE).stdout
        found = from_text(answer)
        expected = solve(given["R"], given["U"], given["S"], given["V"], shape[4])
        assert set(found) == set(expected), sorted(set(found) ^ set(expected))
        for name, matrix in expected.items():
            error = np.abs(found[name] - matrix).max() / max(1.0, np.abs(matrix).max())
            worst = max(worst, error)
            assert error < TOLERANCE, f"{name} of {shape}: differs by {error:.2e}"
    print(f"{len(SHAPES)} problems agree with NumPy, largest difference {worst:.2e}")


def write(path):
    generator = np.random.default_rng(5)
    text = ""
    for index, shape in enumerate([(8, 5, 14, 9, 1), (7, 4, 12, 6, 0)]):
        given = problem(generator, *shape)
        solved = solve(given["R"], given["U"], given["S"], given["V"], shape[4])
        text += to_text({f"{name}{index}": m for name, m in {**given, **solved}.items()})
    with open(path, "w", encoding="ascii") as file:
        file.write(text)


if __name__ == "__main__":
    {"check": check, "write": write}[sys.argv[1]](sys.argv[2])
