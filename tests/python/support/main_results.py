"""The main results of the core as hexadecimal floats, to compare bits of runs, threads, instruction sets and builds.

As a program it writes them as JSON: `python main_results.py THREADS`.
"""

import json
import sys

import numpy as np

import ninedof as nd

JOINTS = ("base_external", "base_internal", "platform_external", "platform_internal")


def robot(rng):
    base = nd.Geometry.hexagonal(a1=0.5, a2=5.0, b1=2.5, b2=0.5)
    return nd.Geometry(*(getattr(base, name) + 0.2 * rng.uniform(-1.0, 1.0, (3, 3)) for name in JOINTS))


def poses(rng, n):
    """Rotations by Cayley's formula, for which no function of the C library is needed."""
    w = 0.2 * rng.uniform(-1.0, 1.0, (n, 3))
    skew = np.zeros((n, 3, 3))
    skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0] = w.T
    skew = skew - skew.transpose(0, 2, 1)
    squared = (w[:, 0] * w[:, 0] + w[:, 1] * w[:, 1] + w[:, 2] * w[:, 2])[:, None, None]
    q = ((1.0 - squared) * np.eye(3) + 2.0 * (w[:, :, None] * w[:, None, :]) + 2.0 * skew) / (1.0 + squared)
    p = np.array([0.0, 0.0, 4.0]) + 0.3 * rng.uniform(-1.0, 1.0, (n, 3))
    s = np.array([0.0, 0.0, 2.4]) + 0.3 * rng.uniform(-1.0, 1.0, (n, 3))
    return nd.Configuration(p, q, s)


def batches(threads, n=2000):
    """Results of sums, products, quotients and square roots alone: IEEE 754 leaves them no choice of bits."""
    rng = np.random.default_rng(1609)
    g, many, few = robot(rng), poses(rng, n), slice(None, 50)
    lc = rng.uniform(0.5, 2.0, n)
    margins = nd.singularity_margins(g, many, threads=threads)
    return {
        "leg_lengths": nd.leg_lengths(g, many, threads=threads),
        "condition_number": nd.condition_number(g, many, lc, threads=threads),
        "condition_number_frobenius": nd.condition_number(g, many, lc, norm="frobenius", threads=threads),
        "singular_values": nd.singular_values(g, many, lc, threads=threads),
        "manipulability": nd.manipulability(g, many, lc, threads=threads),
        "isotropy_residual": nd.isotropy_residual(g, many, lc, threads=threads),
        "singularity_margins": np.stack([margins.det_n, margins.det_b, margins.det_c]),
        "hexagonal_condition_number": nd.hexagonal_condition_number(*rng.uniform(0.1, 4.0, (6, n)), threads=threads),
        "jacobian": nd.jacobian(g, many[few], 1.5),
        "natural_length": nd.characteristic_length(g, many[few], "natural"),
        "inverse_velocity": nd.inverse_velocity(g, many[few], *rng.uniform(-1.0, 1.0, (3, 50, 3))),
    }


def solvers(threads):
    """Results that also take logarithms, exponentials or angles: the C library decides about their last bits."""
    rng = np.random.default_rng(1610)
    g, some = robot(rng), poses(rng, 6)
    modes = nd.forward_position(g, nd.leg_lengths(g, some[0]))
    tracked = nd.track(g, nd.leg_lengths(g, some[1]), some[0])
    best = nd.best_internal_point(g, some.position, some.rotation, threads=threads)
    found = nd.optimize(nd.Study.paper(), starts=8, seed=3, threads=threads)
    box = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0])
    space = nd.workspace(g, box, criteria={"leg_limits": (2.0, 6.5)}, tolerance=0.01, threads=threads)
    return {
        "forward_position": np.concatenate([modes.position, modes.internal_point]),
        "track": np.concatenate([tracked.position, tracked.internal_point]),
        "best_internal_point": best.configuration.internal_point,
        "optimal_length": nd.characteristic_length(g, some, "optimal"),
        "optimize": [found.condition_number, *found.best.variables.values()],
        "workspace": [space.volume, space.error],
        "bounds": np.stack(nd.condition_number_bounds(g, some)),
    }


def hexadecimal(results):
    return {name: [float(x).hex() for x in np.ravel(values)] for name, values in results.items()}


def digests(results):
    """A SHA-256 of the bits of each result, which are too many to keep."""
    import hashlib

    return {name: hashlib.sha256(np.asarray(values, "<f8").tobytes()).hexdigest() for name, values in results.items()}


if __name__ == "__main__":
    count = int(sys.argv[1])
    json.dump({"batches": digests(batches(count)), "solvers": hexadecimal(solvers(count))}, sys.stdout)
