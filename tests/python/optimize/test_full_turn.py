"""An angle with bounds a full turn apart has no bounds: a run may cross them, and what it returns lies within them."""

import math

import pytest

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


@pytest.mark.parametrize("centre", [1.0, -3.1])
def test_where_the_turn_begins_does_not_matter(centre):
    poses = [{"position": (0.1, 0.05, 0.0)}]
    anywhere, turned = (nd.optimize(study(c, poses, 4.0), starts=16) for c in (math.inf, centre))
    assert turned.objective == pytest.approx(anywhere.objective, rel=1e-9)
    assert nd.check(turned, perturbations=200).passed
