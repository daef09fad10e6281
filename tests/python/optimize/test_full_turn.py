"""An angle with bounds a full turn apart has no bounds: a run may cross them, and what it returns lies within them."""

import math

import numpy as np
import pytest
from sizes import size

import ninedof as nd

ANGLES = ("base_internal_angle", "platform_external_angle", "platform_internal_angle")


def study(centre, poses, limit):
    """All angles at most half a turn from `centre`; without bounds where that is infinite."""
    return nd.Study(
        family="symmetric",
        variables=dict.fromkeys(ANGLES, (centre - math.pi, centre + math.pi)) if math.isfinite(centre) else {},
        constraints={"radius_ratio": (None, 2.0)},
        objective={"index": "speed", "condition_limit": limit, "poses": poses, "unit": "zp"},
    )


def test_no_optimum_lies_on_a_bound_that_is_none():
    rng = np.random.default_rng(34)
    for _ in range(size(2, 80)):
        poses = [
            {"position": rng.uniform(-0.2, 0.2, 3).tolist(), "rotation_deg": rng.uniform(-15.0, 15.0, 3).tolist()}
            for _ in range(rng.integers(1, 3))
        ]
        centre = float(rng.uniform(-5.0, 5.0))
        result = nd.optimize(study(centre, poses, float(rng.uniform(3.0, 10.0))), starts=8)
        for candidate in result.candidates:
            assert not set(candidate.active) & set(ANGLES)
            assert all(abs(candidate.variables[name] - centre) <= math.pi for name in ANGLES)


@pytest.mark.parametrize("centre", [1.0, -3.1])
def test_where_the_turn_begins_does_not_matter(centre):
    poses = [{"position": (0.1, 0.05, 0.0)}]
    anywhere, turned = (nd.optimize(study(c, poses, 4.0), starts=16) for c in (math.inf, centre))
    assert turned.objective == pytest.approx(anywhere.objective, rel=1e-9)
    assert nd.check(turned, perturbations=200).passed
