"""The estimation methods a second time, in NumPy, as the reference for the C++ kernels.

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


def weights_of(R, S, weight):
    return np.r_[np.ones(R.shape[1]), np.full(S.shape[1], weight)]


def tuning_weights(R, S):
    ratio = R.shape[1] / S.shape[1]
    return [1.0, np.sqrt(ratio), ratio]


def weighted_center(x, w):
    return (x @ w / w.sum())[:, None]


def by_folds(R, U, S, V, candidates, estimate):
    """The candidate with the least error over folds of the tuning samples, fitted to all of them."""
    folds = min(8, S.shape[1])
    fold = np.arange(S.shape[1]) % folds
    errors = [sum(((estimate(c, R, U, S[:, fold != f], V[:, fold != f], V[:, fold == f])
                    - S[:, fold == f]) ** 2).sum() for f in range(folds)) for c in candidates]
    return candidates[int(np.argmin(errors))]


def responsivity(R, U, w, ridge):
    r, u = R - weighted_center(R, w), U - weighted_center(U, w)
    covariance = (r * w) @ r.T / w.sum()
    covariance += ridge * np.trace(covariance) / len(R) * np.eye(len(R))
    M = np.linalg.solve(covariance, (r * w) @ u.T / w.sum()).T
    return M, weighted_center(U, w) - M @ weighted_center(R, w), ((u - M @ r) ** 2) @ w / w.sum()


def wiener(candidate, R, U, S, V, X):
    weight, ridge, correlation = candidate
    A, B, w = np.hstack([R, S]), np.hstack([U, V]), weights_of(R, S, weight)
    M, b, noise = responsivity(A, B, w, ridge)
    mean = weighted_center(A, w)
    variance = ((A - mean) ** 2 @ w / w.sum()).mean()
    i = np.arange(len(R))
    C = variance * correlation ** abs(i[:, None] - i)
    return mean + C @ M.T @ np.linalg.inv(M @ C @ M.T + np.diag(noise)) @ (X - M @ mean - b)


def pca(candidate, R, U, S, V, X):
    weight, components = candidate
    A, B, w = np.hstack([R, S]), np.hstack([U, V]), weights_of(R, S, weight)
    mean = weighted_center(A, w)
    basis = np.linalg.svd((A - mean) * np.sqrt(w))[0][:, :components]
    scores = np.linalg.lstsq((with_constant(B) * np.sqrt(w)).T,
                             (basis.T @ (A - mean) * np.sqrt(w)).T, rcond=None)[0].T
    return mean + basis @ scores @ with_constant(X)


def kernel_fit(gram, cross, Y, w, penalty):
    """Solves the bordered system and evaluates at the rows of cross."""
    n = len(gram)
    system = np.block([[gram + penalty * np.diag(1.0 / w), np.ones((n, 1))],
                       [np.ones((1, n)), np.zeros((1, 1))]])
    solution = np.linalg.solve(system, np.vstack([Y, np.zeros((1, Y.shape[1]))]))
    return cross @ solution[:-1] + solution[-1]


def by_leaving_out(R, S, grams, candidates):
    """grams: by the first parts of a candidate; the last two are penalty and tuning weight."""
    Y, first = np.hstack([R, S]).T, R.shape[1]
    best = (np.inf, None)
    for candidate in candidates:
        gram, w = grams[candidate[:-2]], weights_of(R, S, candidate[-1])
        error = 0.0
        for i in range(first, len(Y)):
            kept = np.arange(len(Y)) != i
            estimate = kernel_fit(gram[np.ix_(kept, kept)], gram[i, kept], Y[kept], w[kept], candidate[-2])
            error += ((estimate - Y[i]) ** 2).sum()
        best = min(best, (error, candidate), key=lambda pair: pair[0])
    return best[1]


def kernel_ridge(R, U, S, V, X):
    A, B = np.hstack([R, S]), np.hstack([U, V])
    scale = 1.0 / B.std(axis=1, keepdims=True) / np.sqrt(len(B))
    square = lambda a, b: ((a[:, :, None] - b[:, None, :]) ** 2).sum(axis=0)  # noqa: E731
    kernels = [lambda d: np.exp(-0.5 * d), lambda d: -np.log1p(d)]
    at, to = B * scale, X * scale
    grams = {(k, length): kernels[k](square(at, at) / length ** 2)
             for k in (0, 1) for length in (1.0, 2.0, 4.0, 8.0)}
    kernel, length, penalty, weight = by_leaving_out(R, S, grams, [
        (*key, penalty, weight) for key in grams for penalty in (1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
        for weight in tuning_weights(R, S)])
    return kernel_fit(grams[kernel, length], kernels[kernel](square(to, at) / length ** 2), A.T,
                      weights_of(R, S, weight), penalty).T


def polynomial(R, U, S, V, X, kinds):
    A, B = np.hstack([R, S]), np.hstack([U, V])
    scale = 1.0 / np.sqrt((B ** 2).mean(axis=1, keepdims=True))

    def terms(kind, u):
        u = u * scale
        i, j = np.triu_indices(len(u), 1 if kind == 3 else 0)
        more = {0: u[:0], 1: u ** 2, 2: u[i] * u[j] if kind == 2 else None,
                3: np.sqrt(np.maximum(u, 0.0)[i] * np.maximum(u, 0.0)[j])}[kind]
        return np.vstack([u, more])

    def scaled(kind, u):
        t = terms(kind, B)
        return (terms(kind, u) - t.mean(axis=1, keepdims=True)) / t.std(axis=1, keepdims=True)

    def gram(kind, u):
        return scaled(kind, u).T @ scaled(kind, B) / len(terms(kind, B))

    grams = {(kind,): gram(kind, B) for kind in kinds}
    kind, penalty, weight = by_leaving_out(R, S, grams, [
        (kind, penalty, weight) for kind in kinds for penalty in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
        for weight in tuning_weights(R, S)])
    return kernel_fit(grams[kind,], gram(kind, X), A.T, weights_of(R, S, weight), penalty).T


def local_estimate(A, B, regressors, noise, ridge, w, neighbours, x, without=None):
    distance = np.sqrt((((B - x[:, None]) / B.std(axis=1, keepdims=True)) ** 2).sum(axis=0))
    order = [j for j in np.argsort(distance, kind="stable") if j != without]
    near = order[:neighbours]
    beyond = distance[order[neighbours]] if len(order) > neighbours else 0.0
    share = w[near] * (1.0 - (distance[near] / max(beyond, 1.001 * distance[near[-1]])) ** 3) ** 3
    mean, center = weighted_center(A[:, near], share), weighted_center(regressors[:, near], share)
    c, r = regressors[:, near] - center, A[:, near] - mean
    covariance = (c * share) @ c.T / share.sum()
    covariance += np.diag(noise) + ridge * np.trace(covariance) / len(B) * np.eye(len(B))
    return (mean + (r * share) @ c.T / share.sum() @ np.linalg.solve(covariance, x[:, None] - center))[:, 0]


def local(R, U, S, V, X, regressors, noise, candidates):
    A, B, first = np.hstack([R, S]), np.hstack([U, V]), R.shape[1]

    def run(candidate, x, without=None):
        weight, part, ridge = candidate
        neighbours = min(max(int(np.floor(part * A.shape[1] + 0.5)), 5), A.shape[1])
        return local_estimate(A, B, regressors, noise, ridge, weights_of(R, S, weight), neighbours, x, without)

    errors = [sum(((run(c, V[:, i], first + i) - S[:, i]) ** 2).sum() for i in range(S.shape[1]))
              for c in candidates]
    best = candidates[int(np.argmin(errors))]
    return np.stack([run(best, x) for x in X.T], axis=1)


def choosing_methods(R, U, S, V, X):
    """Estimates of the responses X by the methods that choose hyperparameters on the tuning samples."""
    A, B = np.hstack([R, S]), np.hstack([U, V])
    weights = tuning_weights(R, S)
    candidates = [(w, ridge, c) for w in weights for ridge in (1e-4, 1e-3, 1e-5) for c in (0.99, 0.97, 0.995, 0.999)]
    chosen = by_folds(R, U, S, V, candidates, wiener)
    M, b, noise = responsivity(A, B, weights_of(R, S, chosen[0]), chosen[1])
    most = min(len(R), 12)
    components = [(w, p) for w in weights for p in range(min(3, most), most + 1)]
    return {
        "wiener": wiener(chosen, R, U, S, V, X),
        "adaptive-wiener": local(R, U, S, V, X, M @ A + b, noise,
                                 [(w, part, 0.0) for w in weights for part in (0.5, 0.25, 0.125, 1.0)]),
        "pca": pca(by_folds(R, U, S, V, components, pca), R, U, S, V, X),
        "kernel-ridge": kernel_ridge(R, U, S, V, X),
        "local-linear": local(R, U, S, V, X, B, np.zeros(len(B)),
                              [(w, part, ridge) for w in weights for part in (0.5, 0.25, 1.0)
                               for ridge in (1e-4, 1e-3, 1e-2, 1e-5, 1e-6)]),
        "polynomial": polynomial(R, U, S, V, X, (0, 1, 2)),
        "root-polynomial": polynomial(R, U, S, V, X, (0, 3)),
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

# Few samples: the reference leaves them out one by one.
CHOOSING_SHAPES = [(31, 7, 24, 10, 1), (10, 3, 20, 8, 1)]
CHOOSING_TOLERANCE = 1e-6  # penalties down to 1e-7 of the kernel: the systems' condition is up to 1e9


def check(probe):
    generator = np.random.default_rng(20110401)
    worst = 0.0
    for shape in SHAPES:
        given = problem(generator, *shape)
        if shape in CHOOSING_SHAPES:
            given["X"] = problem(generator, *shape[:2], 2, 10, 0)["V"]
        answer = subprocess.run([probe], input=to_text(given), text=True, check=True,
                                stdout=subprocess.PIPE).stdout
        found = from_text(answer)
        expected = solve(given["R"], given["U"], given["S"], given["V"], shape[4])
        if "X" in given:
            expected.update(choosing_methods(*(given[name] for name in "RUSVX")))
        assert set(found) == set(expected), sorted(set(found) ^ set(expected))
        for name, matrix in expected.items():
            error = np.abs(found[name] - matrix).max() / max(1.0, np.abs(matrix).max())
            chosen = name in ("wiener", "adaptive-wiener", "pca", "kernel-ridge", "local-linear", "polynomial",
                              "root-polynomial")
            worst = max(worst, error)
            assert error < (CHOOSING_TOLERANCE if chosen else TOLERANCE), f"{name} of {shape}: differs by {error:.2e}"
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
