"""The nearest singularity: planes whose distance is known, dense directions, stacks."""

import numpy as np
import pytest
from sizes import size

import ninedof as nd
from ninedof.singularity.singularity_distance import nearest_singularity


def robot(rng):
    """A robot of no symmetry, its plates tilted."""
    base = rng.normal(size=(6, 3)) * [2.0, 2.0, 0.4]
    platform = rng.normal(size=(6, 3)) * [1.0, 1.0, 0.2]
    return nd.Geometry(base[:3], base[3:], platform[:3], platform[3:])


def refined(g, c, tangents, most, rng):
    """The least distance over 4000 random directions, the best 400 of them each turned to where it is least."""

    def distance(ways):
        return most * nd.distance_to_singularity(g, c, most * ways @ tangents.T).distance

    def unit(ways):
        return ways / np.linalg.norm(ways, axis=-1, keepdims=True)

    ways = unit(rng.normal(size=(4000, 3)))
    least = distance(ways)
    order = np.argsort(least)[:400]
    ways, least, angle = ways[order], least[order], np.full(400, 0.05)
    for _ in range(60):
        around = unit(ways[:, None] + angle[:, None, None] * unit(rng.normal(size=(400, 4, 3))))
        result = distance(around.reshape(-1, 3)).reshape(400, 4)
        k = np.argmin(result, axis=1)
        better = result[np.arange(400), k] < least
        ways[better], least[better] = around[better, k[better]], result[better, k[better]]
        angle[~better] *= 0.7
    return least.min()


@pytest.mark.slow
def test_refined_directions_are_no_nearer_and_the_sheet_says_the_same():
    """The valleys of some robots are narrow, and a search about one direction alone ends in the wrong one."""
    rng = np.random.default_rng(2027)
    for _ in range(size(15, 300)):
        g = robot(rng)
        c = nd.Configuration(rng.normal([0, 0, 4.0], 0.3), internal_point=rng.normal([0, 0, 2.0], 0.3))
        longest = 4.0 * nd.leg_lengths(g, c).max()
        stack = nd.Configuration(*(x[None] for x in (c.position, c.rotation, c.internal_point)))
        of_sheet = nd.sheet(g, stack, internal="shifted").singularities
        for motion, rows, most in (("shift", (3, 6), longest), ("turn", (0,), np.pi), ("internal", (6,), longest)):
            tangents = np.zeros((9, 3))
            for row in rows:
                tangents[row : row + 3] = np.eye(3)
            reference = refined(g, c, tangents, most, rng)
            assert of_sheet[motion].distance <= reference * (1.0 + 1e-9)
            if motion != "shift":
                part = {"turn": "rotation", "internal": "internal_point"}[motion]
                assert nearest_singularity(g, c, part, most).distance == of_sheet[motion].distance


def test_the_nearest_of_a_stack(published, stack):
    result = nearest_singularity(published, stack)
    each = [nearest_singularity(published, stack[k]) for k in range(len(stack))]
    k = int(np.argmin([one.distance for one in each]))
    assert (result.pose, result.distance) == (k, each[k].distance)
    assert result.configuration == each[k].configuration
    one = nearest_singularity(published, stack, threads=1)
    assert (one.distance, one.direction.tolist()) == (result.distance, result.direction.tolist())


def test_singular_and_free(published, neutral):
    flat = nearest_singularity(published, nd.Configuration.neutral(3.9828, 0.0), "internal_point")
    assert (flat.distance, flat.mechanism) == (0.0, nd.Mechanism.B)
    free = nearest_singularity(published, neutral, most=0.1)
    assert (free.distance, free.mechanism, free.configuration) == (np.inf, nd.Mechanism.NONE, neutral)
