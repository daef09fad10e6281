"""What is proved of a machine where O follows a rule.

Oracle: poses drawn from the definition of the region, rotations by scipy, the rule written out term by term, every
number by the numpy model.
"""

import itertools
import json
from dataclasses import replace

import numpy as np
import numpy_model as model
import pytest
from region_poses import drawn
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd
from ninedof import _core
from ninedof.proof.machine import certify
from ninedof.proof.machine_record import MachineCertificate
from ninedof.proof.point_rule import PointRule

GEOMETRY = nd.Geometry(*(model.orbit(r, a, 0.0) for r, a in ((500.0, 0.0), (230.0, 0.4), (150.0, 0.9), (90.0, -0.3))))
NEUTRAL = nd.Configuration.neutral([360.0], [260.0])
LIMITS = {"stroke": (None, 300.0), "leg_clearance": {"min": 1.0}, "stroke_ratio": (None, 3.0)}
BEST = {"internal_point": "best"}
REGIONS = {
    "box": nd.Region(box=(30.0, 40.0, 20.0), tilt=0.12, **BEST),
    "six": nd.Region(box=(20.0, 15.0, 10.0), tilt=0.08, yaw=0.1, **BEST),
    "shift": nd.Region(box=(40.0, 30.0, 20.0), **BEST),
    "ball": nd.Region(ball=25.0, yaw=0.2, **BEST),
    "cylinder": nd.Region(cylinder=(0.1, 0.05), tilt=0.1, unit="zp", **BEST),
    "path": nd.Region(path=((0.0, 0.0, 0.0), (40.0, 0.0, 10.0), (40.0, -40.0, 10.0)), yaw=0.2, **BEST),
    "line": nd.Region(path=((-30.0, 10.0, 0.0), (30.0, -20.0, 5.0)), **BEST),
    "turns": nd.Region(tilt=0.2, **BEST),
}


def study(region, limits=LIMITS):
    return nd.Study(
        family="general", constraints=limits, characteristic_length=150.0, objective=nd.Objective(region=region)
    )


def random_rule(region, rng, degree):
    """Every term up to a degree in the coordinates that move; s goes along with about half of the shift."""
    scale = [64.0, 64.0, 32.0, 0.25, 0.25, 0.5]
    shift, tilt, yaw = drawn(region, 360.0, np.random.default_rng(0), 100)
    moving = np.flatnonzero(np.ptp(np.column_stack([shift, tilt[:, :2], yaw]), axis=0))
    powers = [p for p in itertools.product(range(degree + 1), repeat=6) if sum(p) <= degree]
    powers = [p for p in powers if all(n == 0 or k in moving for k, n in enumerate(p))]
    coefficients = 1.5 * rng.normal(size=(len(powers), 3))
    for k in range(3):
        coefficients[[p == tuple(np.eye(6, dtype=int)[k]) for p in powers], k] += 0.5 * scale[k]
    return PointRule.of(NEUTRAL[0], _core.PointRule(scale=scale, powers=powers, coefficients=coefficients))


def posed(region, rule, rng, count):
    """The robot at poses of a region, O by the rule."""
    shift, tilt, yaw = drawn(region, 360.0, rng, count)
    x = np.column_stack([shift, tilt[:, :2], yaw]) / rule.scale
    s = NEUTRAL.internal_point + sum(
        np.prod(x ** np.array(p), axis=1)[:, None] * np.array(c)
        for p, c in zip(rule.powers, rule.coefficients, strict=True)
    )
    about_z = np.column_stack([np.zeros((count, 2)), yaw])
    q = (Rotation.from_rotvec(tilt) * Rotation.from_rotvec(about_z)).as_matrix() @ NEUTRAL.rotation[0]
    return model.robot(GEOMETRY, nd.Configuration(NEUTRAL.position + shift, q, s))


def proved(region, rule, **options):
    return certify(study(region), GEOMETRY, NEUTRAL, 150.0, rule=rule, **options)


@pytest.mark.slow
@pytest.mark.parametrize(("shape", "degree"), [*((shape, 2) for shape in REGIONS), ("box", 3), ("line", 6), ("six", 1)])
def test_no_sampled_pose_passes_what_is_proved_of_a_rule(shape, degree):
    region, rng = REGIONS[shape], np.random.default_rng(23)
    rule = random_rule(region, rng, degree)
    certificate = proved(region, rule, gap=3.0, time_limit=3.0)
    assert certificate.rule == rule
    by_name = {one.name: one for one in certificate.limits}
    low, high = np.transpose(certificate.lengths)
    reached = np.zeros(9)
    for _ in range(size(1, 50)):
        m = posed(region, rule, rng, 10_000)
        lengths = model.lengths(m)
        assert (lengths >= low * (1.0 - 1e-13)).all()
        assert (lengths <= high * (1.0 + 1e-13)).all()
        assert (lengths.max(axis=0) - lengths.min(axis=0)).max() <= by_name["stroke"].value[1]
        assert (lengths.max(axis=0) / lengths.min(axis=0)).max() <= by_name["stroke_ratio"].value[1]
        assert model.condition_number(m, 150.0).max() <= certificate.condition[1]
        reached = np.maximum(reached, lengths.max(axis=0))
    # The bounds are not far above what a sample meets.
    assert (reached > 0.95 * high).all()
    # A rule called on poses is the one written out here, whatever it makes the tilt and the yaw from.
    assert rule(m.p, m.Q) == pytest.approx(m.s, abs=1e-9)


def test_a_condition_number_met_by_the_rule_is_that_of_the_model():
    region = REGIONS["six"]
    rule = random_rule(region, np.random.default_rng(5), 2)
    certificate = proved(region, rule, gap=5.0, time_limit=0.05)
    met = certificate.condition_at
    turn = Rotation.from_rotvec(met.tilt) * Rotation.from_rotvec((0.0, 0.0, met.yaw))
    s = rule.at((*met.shift, *met.tilt[:2], met.yaw))
    q = turn.as_matrix() @ NEUTRAL.rotation[0]
    there = model.robot(GEOMETRY, nd.Configuration(NEUTRAL.position[0] + met.shift, q, s))
    assert model.condition_number(there, 150.0) == pytest.approx(certificate.condition[0], rel=1e-9)


def test_a_rule_that_passes_a_limit_is_said_to():
    region = REGIONS["shift"]
    rule = random_rule(region, np.random.default_rng(5), 1)
    worst = max(b - a for a, b in proved(region, rule, gap=9.0, time_limit=0.01).lengths)
    limits = {"stroke": (None, 0.99 * worst)}
    found = certify(study(region, limits), GEOMETRY, NEUTRAL, 150.0, rule=rule, gap=9.0, time_limit=0.01)
    assert found.limits[1].answer == "violated"
    assert "Violated by the rule: stroke" in str(found)
    assert str(found).startswith("O follows the rule stored in the certificate: a polynomial of degree 1 with 4 terms")


def test_the_rule_comes_back_from_the_file():
    region = REGIONS["path"]
    rule = random_rule(region, np.random.default_rng(5), 3)
    certificate = proved(region, rule, gap=5.0, time_limit=0.05)
    data = json.loads(json.dumps(certificate.to_dict()))
    again = MachineCertificate.from_dict(data)
    assert again == certificate
    assert again.rule == rule
    with pytest.raises(ValueError, match=r"^rule\.scale: got 'x', expected a list"):
        MachineCertificate.from_dict(data | {"rule": data["rule"] | {"scale": "x"}})


def test_a_proof_goes_on_with_its_own_rule_alone():
    region = REGIONS["turns"]
    rng = np.random.default_rng(5)
    rule, other = (random_rule(region, rng, 2) for _ in range(2))
    part = proved(region, rule, gap=1e-9, time_limit=0.02)
    assert part.left_count
    again = certify(study(region), GEOMETRY, NEUTRAL, 150.0, resume=part, gap=1.0, time_limit=0.05)
    assert again.rule == rule
    assert again.condition[1] <= part.condition[1]
    with pytest.raises(ValueError, match=r"^rule: got another one than that of the certificate"):
        proved(region, other, resume=part)
    with pytest.raises(ValueError, match=r"^resume: got a certificate without a rule for O"):
        certify(study(region), GEOMETRY, NEUTRAL, 150.0, resume=replace(part, rule=None))


def test_a_rule_that_does_not_fit_is_named():
    with pytest.raises(ValueError, match=r"^coordinates: got shape \(3,\), expected"):
        random_rule(REGIONS["box"], np.random.default_rng(1), 1).at((1.0, 2.0, 3.0))
    region = REGIONS["box"]
    rule = random_rule(region, np.random.default_rng(5), 1)
    with pytest.raises(ValueError, match=r"^rule: got none, expected one that says where O is"):
        certify(study(region), GEOMETRY, NEUTRAL, 150.0)
    with pytest.raises(ValueError, match=r'^rule: got one, expected none: .* internal_point is "best"'):
        certify(study(replace(region, internal_point="shifted")), GEOMETRY, NEUTRAL, 150.0, rule=rule)
    with pytest.raises(ValueError, match=r"^rule: got one about another neutral pose"):
        certify(study(region), GEOMETRY, nd.Configuration.neutral([361.0], [260.0]), 150.0, rule=rule)
    with pytest.raises(ValueError, match=r"^rule.powers: got a term of degree 7"):
        proved(region, replace(rule, powers=((7, 0, 0, 0, 0, 0), *rule.powers[1:])))
    with pytest.raises(ValueError, match=r"^position: got shape \(2,\), expected"):
        rule((1.0, 2.0))
    with pytest.raises(ValueError, match=r"^rotation: got shape \(3,\), expected"):
        rule((1.0, 2.0, 3.0), (1.0, 2.0, 3.0))


def test_a_rule_is_asked_for_only_where_all_else_fits():
    region = REGIONS["turns"]
    rule = random_rule(region, np.random.default_rng(5), 1)
    asked = []

    def give():
        asked.append(True)
        return rule

    with pytest.raises(ValueError, match=r"^gap: got 0.0"):
        proved(region, give, gap=0.0)
    part = proved(region, rule, gap=1e-4, time_limit=0.02)
    proved(region, give, resume=part, time_limit=0.02)
    assert not asked
    assert proved(region, give, gap=9.0, time_limit=0.02).rule == rule
    assert asked
    with pytest.raises(ValueError, match=r"^rule: got 3, expected a PointRule"):
        proved(region, 3)


def test_a_rule_is_a_function_of_poses_without_jumps():
    """Calls of single poses, of stacks, and without a rotation; at no tilt, and next to it."""
    rule = random_rule(REGIONS["six"], np.random.default_rng(5), 3)
    p = NEUTRAL.position[0] + np.array([5.0, -3.0, 2.0])
    turns = Rotation.from_rotvec([(0.0, 0.0, 0.1), (1e-9, 0.0, 0.1), (0.0, -1e-9, 0.1)]).as_matrix()
    stack = rule(p, turns)
    assert stack.shape == (3, 3)
    assert np.ptp(stack, axis=0).max() < 1e-6
    assert rule(p, turns[0]) == pytest.approx(stack[0], abs=1e-12)
    assert rule(p) == pytest.approx(rule.at((5.0, -3.0, 2.0, 0.0, 0.0, 0.0)), abs=1e-12)
    assert rule(NEUTRAL.position, NEUTRAL.rotation).shape == (1, 3)
