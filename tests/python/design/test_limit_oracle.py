"""The definitions of the limits in numpy: one for every limit, and distances of segments by SciPy.

That they agree with the core is in test_design_point.py and optimize/test_check.py; tests/cpp/support/hand.hpp has the
definitions once more.
"""

import math

import numpy as np
import pytest
from limit_oracle import EVERY_LIMIT, RULES, between_segments
from scipy.optimize import minimize
from sizes import size

from ninedof.design.limits import ROWS


def test_every_limit_has_a_definition_and_is_stated():
    assert set(EVERY_LIMIT) == set(RULES) == set(ROWS)


@pytest.mark.parametrize("seed", range(size(9, 30)))
def test_distance_of_segments_agrees_with_a_search(seed):
    rng = np.random.default_rng(seed)
    a, b, c, d = rng.normal(size=(4, 3))
    if seed % 3 == 0:
        d = c + (b - a) * rng.uniform(0.2, 2.0)  # parallel

    def apart(x):
        return float(np.sum((a + x[0] * (b - a) - c - x[1] * (d - c)) ** 2))

    best = min(
        minimize(apart, start, bounds=[(0, 1), (0, 1)], options={"ftol": 1e-15, "gtol": 1e-12}).fun
        for start in ([0, 0], [1, 0], [0, 1], [1, 1], [0.5, 0.5])
    )
    found = float(between_segments(a, b, c, d))
    assert found == pytest.approx(math.sqrt(best), abs=2e-6)
