"""Rules for O that are fitted: nearly as good as O placed anew at every pose, and within the limits.

Oracle: poses drawn from the definition of the region, and the numpy model; the best O by a search of `redundancy`.
"""

import math

import numpy as np
import numpy_model as model
import pytest
from interrupts import InterruptedPhase
from region_poses import drawn
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof.design.domains.region_poses import Placing
from ninedof.proof.point_rule import rule_of

VARIABLES = {"a1": 1.0, "a2": 0.8, "b1": 0.5, "b2": 0.6, "zp": 2.0, "zs": 1.0, "theta_z": 0.6}
GEOMETRY = nd.Geometry.hexagonal(1.0, 0.8, 0.5, 0.6)
NEUTRAL = nd.Configuration.neutral([2.0], [1.0], [0.6])
BEST = {"internal_point": "best"}
REGIONS = {
    "box": nd.Region(box=(0.15, 0.15, 0.1), tilt=0.15, **BEST),
    "shift": nd.Region(box=(0.2, 0.2, 0.0), **BEST),
    "path": nd.Region(path=((0.0, 0.0, 0.0), (0.1, 0.1, 0.0), (0.1, -0.05, 0.0)), unit="zp", **BEST),
    "turns": nd.Region(tilt=0.2, yaw=0.1, **BEST),
}


def robots(region, place_o, count=3000):
    """The robot at poses of a region, with O where a function puts it."""
    shift, tilt, yaw = drawn(region, 2.0, np.random.default_rng(7), count)
    about_z = np.column_stack([np.zeros((count, 2)), yaw])
    q = (Rotation.from_rotvec(tilt) * Rotation.from_rotvec(about_z)).as_matrix() @ NEUTRAL.rotation[0]
    p = NEUTRAL.position + shift
    return model.robot(GEOMETRY, nd.Configuration(p, q, place_o(p, q)))


def shifted(p, _):
    return NEUTRAL.internal_point + p - NEUTRAL.position


def best(p, q):
    return nd.best_internal_map(GEOMETRY, p, q, seed_every=1).configuration.internal_point


def fitted(region, constraints, objective, progress=None):
    study = nd.Study(constraints=constraints, objective=nd.Objective(region=region))
    place = Placing(study, NEUTRAL[0], VARIABLES, objective, ())
    return rule_of(place, GEOMETRY, NEUTRAL, 1.0, progress=progress)


@pytest.mark.slow
@pytest.mark.parametrize("shape", REGIONS)
def test_a_rule_is_nearly_as_good_as_the_best_o(shape):
    region = REGIONS[shape]
    least = model.condition_number(robots(region, best, 300)).max()
    rule = fitted(region, {}, least)
    worst = model.condition_number(robots(region, rule)).max()
    assert worst <= 1.02 * least
    assert worst < model.condition_number(robots(region, shifted)).max()


def test_a_fit_says_what_it_does():
    told = InterruptedPhase()
    fitted(REGIONS["shift"], {}, 20.3, told)
    first = [words.split()[0] for words in told.phases]
    assert first[:2] == ["placing", "fitting"]
    assert "checking" in first


@pytest.mark.parametrize("at", ["placing", "fitting", "checking"])
def test_an_interrupted_fit_raises(at):
    told = InterruptedPhase(at)
    with pytest.raises(KeyboardInterrupt):
        fitted(REGIONS["shift"], {}, 20.3, told)
    assert told.phases[-1].startswith(at)


@pytest.mark.slow
def test_a_study_with_o_placed_is_certified_by_a_rule(run, tmp_path):
    study = nd.Study(
        constraints={"radius_ratio": (None, 2.0), "stroke_ratio": (None, 1.6)},
        objective={"region": {"box": [0.05, 0.05, 0.0], "unit": "zp", **BEST}},
        starts=2,
    )
    result = nd.optimize(study)
    nd.save(result, tmp_path / "run")
    status, out, _ = run(f"certify {tmp_path / 'run'} --gap 0.02")
    assert status == 0
    assert "O follows the rule stored in the certificate" in " ".join(out.split())
    certificate = nd.load_certificate(tmp_path / "run")
    assert certificate.proved
    assert certificate.rule is not None
    # The optimum is the worst of the best O: no rule is better, and this one is nearly as good.
    assert result.condition_number * (1.0 - 1e-5) <= certificate.condition[1]
    assert certificate.condition[0] <= result.condition_number * 1.02
    assert "O follows the rule" in nd.report(tmp_path / "run", tmp_path / "page.html").read_text()
    assert run(f"certify {tmp_path / 'run'} --time 1")[0] == 0
    again = nd.load_certificate(tmp_path / "run")
    assert again.rule == certificate.rule
    assert again.condition[1] <= certificate.condition[1]
    assert math.isfinite(again.condition[1])
