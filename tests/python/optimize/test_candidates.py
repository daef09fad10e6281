"""Candidates are distinct designs: what differs in something without effect is one of them."""

import itertools
import math

import pytest

import ninedof as nd

RATIO = {"radius_ratio": (None, 2.0)}
POSES = [{}, {"position": (0.1, 0.0, 0.0)}, {"rotation_deg": (10.0, 0.0, 0.0)}]
ONCE = {
    "size: only the shape matters": nd.Study(
        family="symmetric",
        constraints=RATIO | {"leg_ratio": (None, 3.0)},
        characteristic_length="mean_leg",
        objective={"poses": POSES, "unit": "zp"},
    ),
    "O of a robot with six legs": nd.Study(
        variables={"a1": (0.0, 1.0), "a2": (0.0, 1.0), "b1": (2.0, 3.0), "b2": (2.0, 3.0)},
        objective={"index": "six_legged"},
    ),
    "a shift of the base along z": nd.Study(
        family="symmetric_nonplanar",
        variables={"base_external_radius": 2.0, "base_internal_radius": 1.0, "platform_external_radius": 1.0}
        | {"platform_internal_radius": 0.5, "platform_external_height": 0.0, "platform_internal_height": 0.0}
        | {"platform_internal_angle": 1.0, "platform_external_angle": 0.2, "zs": (1.0, 2.0), "zp": (1.0, 3.0)},
        constraints={"leg_ratio": (None, 2.0)},
    ),
}


@pytest.mark.parametrize("study", ONCE.values(), ids=ONCE.keys())
def test_a_design_is_listed_once(study):
    result = nd.optimize(study)
    assert result.status == "optimal"
    assert result.best.reached > 1
    for a, b in itertools.pairwise(result.candidates):
        assert not math.isclose(a.objective, b.objective, rel_tol=1e-7)


def test_different_designs_as_good_are_listed():
    """Flat plates with legs within 4 : 1 reach the proved bound in many shapes."""
    result = nd.optimize(nd.Study(family="symmetric", constraints={"leg_ratio": (None, 4.0)}))
    assert len([c for c in result.candidates if math.isclose(c.objective, result.objective, rel_tol=1e-7)]) == 4
