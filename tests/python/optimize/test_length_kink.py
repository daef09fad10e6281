"""l_c = "platform_radius" is the largest of several distances: studies whose optimum lies where two are equal.

Oracle: `check`, whose gradients are differences of J'. It takes l_c as the distance of one joint after the other.
"""

import math

import numpy as np
import pytest
from sizes import size

import ninedof as nd

POSES = [{}, {"position": (0.1, 0.0, 0.0)}, {"rotation_deg": (10.0, 0.0, 0.0)}]
LEGS = {"leg_ratio": (None, 3.0)}


def study(family="symmetric", constraints=None, poses=POSES, **objective):
    return nd.Study(
        family=family,
        constraints=LEGS if constraints is None else constraints,
        characteristic_length="platform_radius",
        objective={"poses": poses, "unit": "zp", "internal_point": "held"} | objective,
    )


def radii(result):
    g = result.geometry
    return [np.linalg.norm(joints[0]) for joints in (g.platform_external, g.platform_internal)]


def test_optimum_where_both_radii_are_equal():
    result = nd.optimize(study())
    assert (result.status, result.active) == ("optimal", ("leg_ratio",))
    assert result.objective == pytest.approx(2.5532042294, rel=1e-9)
    assert radii(result)[0] == pytest.approx(radii(result)[1], rel=1e-9)
    assert nd.check(result, perturbations=500).passed


def test_price_at_the_kink_is_the_gain_of_a_looser_limit():
    """Of the pieces that meet at a kink, the better one says what relaxing a limit gains."""
    result = nd.optimize(study())
    h = 1e-4
    looser = nd.optimize(study(constraints={"leg_ratio": (None, 3.0 * math.exp(h))}))
    assert result.prices["leg_ratio"] == pytest.approx(math.log(result.objective / looser.objective) / h, rel=1e-2)


def random_study(rng):
    def pose():
        return {"position": rng.uniform(-0.2, 0.2, 3).tolist(), "rotation_deg": rng.uniform(-15.0, 15.0, 3).tolist()}

    flat = rng.random() < 0.6
    constraints = {"leg_ratio": (None, float(rng.uniform(2.0, 4.0)))}
    return study(
        "symmetric" if flat else "symmetric_nonplanar",
        constraints if flat else constraints | {"joint_height": {"max": 0.3, "of": "radius"}},
        [{}, *(pose() for _ in range(rng.integers(1, 3)))],
        index=str(rng.choice(["condition_number", "frobenius"])),
        aggregate=str(rng.choice(["worst", "weighted"])),
    )


def test_random_studies_end_at_an_optimum():
    rng = np.random.default_rng(12)
    kinks = 0
    for _ in range(size(3, 60)):
        result = nd.optimize(random_study(rng))
        assert result.status == "optimal", result.reason
        assert nd.check(result, perturbations=100).passed
        kinks += math.isclose(*radii(result), rel_tol=1e-9)
    assert kinks >= size(1, 15)


def test_a_platform_that_shrinks_to_nothing_raises_nothing():
    """Measured in its own radius a smaller platform may always be better, until it has no size and is singular."""
    poses = [{"position": (0.1, 0.1, 0.0), "internal_point": "best"}, {"rotation_deg": (0.0, 10.0, 0.0)}]
    assert nd.optimize(study("hexagonal", {}, poses), starts=1).status != "infeasible"
