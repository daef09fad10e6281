"""What is proved of every machine within tolerances.

Oracle: random machines, a good part of them at the ends of their tolerances, by the numpy model; the poses that they
reach with the lengths of the drawing, by `error_samples`, which tracks poses and knows nothing of proofs.
"""

import math
from dataclasses import replace

import numpy as np
import numpy_model as model
import pytest
from proved_machine import LIMITS, REGIONS, apart, at_pose, proved, sampled
from region_poses import disc
from singular_robots import unit_rows
from sizes import size
from workspace_oracle import angles

import ninedof as nd
from ninedof.proof import machine

TOLERANCES = nd.Tolerances(joints=0.1, legs=0.05)
JOINTS = ("r", "rh", "u", "ut")


def built(m, rng, radius):
    """Another machine at each pose: joints in balls about those of the drawing, half of them on the spheres."""
    count = len(m.p)
    moved = {name: getattr(m, name) + radius * disc(rng, 3 * count, 3, 0.5).reshape(count, 3, 3) for name in JOINTS}
    return m._replace(**moved)


def drawing_of(certificate):
    return {(one.name, one.side): one for one in certificate.limits}


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("shape", REGIONS)
def test_no_machine_within_tolerances_passes_what_is_proved(shape):
    region = REGIONS[shape]
    geometry, neutral, certificate = proved(region, gap=0.25, tolerance=TOLERANCES)
    by_name = drawing_of(certificate)
    start = model.robot(geometry, neutral)
    side = np.sign(np.linalg.det(np.stack(unit_rows(start))))
    rng = np.random.default_rng(11)
    reached = np.zeros(9)
    for _ in range(size(2, 100)):
        m = built(sampled(region, geometry, neutral, rng, 10_000), rng, TOLERANCES.joints)
        read = model.lengths(m) + TOLERANCES.legs * rng.choice([-1.0, 0.0, 1.0], (len(m.p), 9))
        low, high = np.transpose(certificate.lengths)
        assert (read >= low).all()
        assert (read <= high).all()
        reached = np.maximum(reached, read.max(axis=0))
        assert read.max() / read.min() <= by_name["leg_ratio", "max"].value[1]
        determinants = np.linalg.det(np.stack(unit_rows(m))) * side[:, None].reshape(3, 1)
        assert determinants.min() >= by_name["no singularity", "min"].value[0]
        assert angles(m, False, home=start).max() <= by_name["base_cone", "max"].value[1]
        axis = np.array(LIMITS["platform_cone"]["axis"])
        assert angles(m, True, axis).max() <= by_name["platform_cone", "max"].value[1]
        first = m.at(slice(0, 3_000))
        assert model.condition_number(first, 150.0).max() <= certificate.condition[1]
        assert apart(first, rng).min() >= by_name["leg_clearance", "min"].value[0]
        base = np.concatenate([m.r, m.rh], axis=1)
        widest = np.linalg.norm(base[..., :2], axis=-1).max(axis=-1)
        assert widest.max() <= by_name["footprint", "max"].value[1]
        platform = np.linalg.norm(np.concatenate([m.u, m.ut], axis=1)[..., :2], axis=-1).max(axis=-1)
        assert (widest / platform).max() <= by_name["radius_ratio", "max"].value[1]
        for triples in (base, np.concatenate([m.u, m.ut], axis=1)):
            spacing = np.linalg.norm(triples[:, :, None] - triples[:, None], axis=-1) + 1e9 * np.eye(6)
            assert spacing.min() >= by_name["joint_spacing", "min"].value[0]
    assert (reached > 0.97 * high).all()


@pytest.mark.parametrize("shape", ["box", "path"])
def test_no_machine_is_off_by_more_than_is_proved(shape):
    region = REGIONS[shape]
    geometry, neutral, certificate = proved(region, tolerance=TOLERANCES, time_limit=0.01)
    position, turn, point = certificate.errors
    rng = np.random.default_rng(3)
    m = sampled(region, geometry, neutral, rng, size(2_000, 100_000))
    poses = nd.Configuration(m.p, m.Q, np.broadcast_to(m.s, m.p.shape))
    first = nd.error_bounds(geometry, poses, leg_errors=TOLERANCES.legs, joint_errors=TOLERANCES.joints)
    worst = int(np.argmax(first.position))
    for k in [worst, int(np.argmax(first.rotation)), int(np.argmax(first.internal_point)), 0, 1]:
        off = nd.error_samples(geometry, poses[k], TOLERANCES.legs, TOLERANCES.joints, size(4_000, 40_000))
        assert np.isfinite(off).all()
        turned, moved, o = (np.linalg.norm(off[:, j : j + 3], axis=1).max() for j in (0, 3, 6))
        assert turned <= turn[1]
        assert moved <= position[1]
        assert o <= point[1]
    # The first numbers are those of the worst pose, to first order; the second are not far above them.
    for (low, high), of_poses in ((position, first.position), (turn, first.rotation), (point, first.internal_point)):
        assert of_poses.max() <= low * (1.0 + 1e-3)
        assert of_poses.max() >= 0.9 * low
        assert high <= 1.12 * low


def worst_joints(m, radius, value):
    """The machine whose joints lie where the slopes of a number lead, by differences."""
    moved = {}
    for name in JOINTS:
        joints = np.array(getattr(m, name), float).reshape(3, 3)
        slopes = np.zeros((3, 3))
        for index in np.ndindex(3, 3):
            step = np.zeros((3, 3))
            step[index] = 1e-4
            slopes[index] = value(m._replace(**{name: joints + step})) - value(m._replace(**{name: joints - step}))
        length = np.linalg.norm(slopes, axis=1, keepdims=True)
        moved[name] = joints + radius * np.divide(slopes, length, out=np.zeros_like(slopes), where=length > 0.0)
    return m._replace(**moved)


@pytest.mark.parametrize("joints", [0.01, 0.5, 3.0])
def test_a_cone_is_proved_as_large_as_a_machine_within_tolerances_has_it(joints):
    """Errors counted as if all led away from the axis: a small cone was proved 40 % too large, and optimize ended."""
    one = {"position": [40.0, 30.0, 20.0], "rotation": [0.1, 0.05, 0.0], "internal_point": "held"}
    drawn = nd.Study(
        unit="mm",
        variables={"a1": 0.0, "a2": 700.0, "b1": 200.0, "b2": 0.0, "zp": 450.0, "zs": 280.0, "theta_z": 0.0},
        constraints={name: {"max_deg": 30.0} for name in ("base_cone", "platform_cone")},
        objective={"poses": [one]},
        characteristic_length=150.0,
    )
    certificate = nd.optimize(drawn).certify(tolerance=nd.Tolerances(joints=joints))
    cones = [one.value for one in certificate.limits if "cone" in one.name]
    assert len(cones) == 2
    for met, high in cones:
        assert met > 0.1
        assert met <= high <= met * (1.0 + 1e-8 + 1e-4 * (joints / 3.0) ** 2)
    assert certificate.condition_boxes < 1000  # listed poses are proved at once, up to what their tolerances allow
    assert certificate.condition[1] < 1.5 * certificate.condition[0]


def test_what_is_violated_a_machine_within_tolerances_passes():
    region = REGIONS["box"]
    _, _, drawn = proved(region, time_limit=0.01)
    geometry, neutral, whole = proved(region, time_limit=0.01, tolerance=TOLERANCES)
    start = model.robot(geometry, neutral)
    before, after = (drawing_of(c)["base_cone", "max"].value for c in (drawn, whole))
    assert before[1] < after[0] <= after[1]

    def largest(m):
        return angles(m, False, home=start).max()

    tight = 0.5 * (before[1] + after[0])  # that of the drawing keeps it
    *_, certificate = proved(
        region, {"base_cone": {"max_deg": np.degrees(tight)}}, time_limit=0.01, tolerance=TOLERANCES
    )
    one = drawing_of(certificate)["base_cone", "max"]
    assert one.answer == "violated"
    m = at_pose(one.at[0], geometry, neutral)
    assert largest(m) < tight < largest(worst_joints(m, TOLERANCES.joints, largest))


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("shape", ["box", "cylinder"])
def test_strokes_of_one_machine_are_within_what_is_proved(shape):
    """Errors of joints count at both ends of a stroke: the bound is far below what they would be apart."""
    region = REGIONS[shape]
    geometry, neutral, certificate = proved(region, time_limit=0.01, tolerance=TOLERANCES)
    *_, drawn = proved(region, time_limit=0.01)
    ratio = {"stroke_ratio": (None, 1.9), "stroke": (None, 400.0)}
    *_, ratios = proved(region, ratio, time_limit=0.01, tolerance=TOLERANCES)
    most, most_ratio = (
        drawing_of(c)[name, "max"].value[1] for c, name in ((certificate, "stroke"), (ratios, "stroke_ratio"))
    )
    rng, reached = np.random.default_rng(2), 0.0
    poses = sampled(region, geometry, neutral, rng, size(4_000, 20_000))
    for _ in range(size(150, 5_000)):
        moved = {name: getattr(poses, name) + TOLERANCES.joints * disc(rng, 3, 3, 0.9) for name in JOINTS}
        lengths = model.lengths(poses._replace(**moved))
        longest, shortest = lengths.max(axis=0) + TOLERANCES.legs, lengths.min(axis=0) - TOLERANCES.legs
        reached = max(reached, (longest - shortest).max())
        assert (longest / shortest).max() <= most_ratio
    assert reached <= most
    whole = drawing_of(drawn)["stroke", "max"].value[1]
    assert most - whole < 2.0 * TOLERANCES.legs + 0.7 * TOLERANCES.joints


def test_a_stroke_of_the_drawing_alone_is_no_violation():
    region = REGIONS["box"]
    _, _, drawn = proved(region, time_limit=0.01)
    stroke = drawing_of(drawn)["stroke", "max"].value[1] + 0.01
    *_, certificate = proved(region, {"stroke": (None, stroke)}, time_limit=0.01, tolerance=TOLERANCES)
    assert drawing_of(certificate)["stroke", "max"].answer == "undecided"


def test_tolerances_of_nothing_are_the_drawing():
    region = REGIONS["ball"]
    *_, drawn = proved(region, time_limit=0.01)
    *_, none = proved(region, time_limit=0.01, tolerance=0.0)
    assert none.errors is None
    assert [one.value for one in none.limits] == [one.value for one in drawn.limits]
    assert none.machine == drawn.machine


@pytest.mark.slow(sanitized=True)
def test_the_certificate_says_of_which_machines_it_is():
    region = REGIONS["ball"]
    *_, certificate = proved(region, time_limit=0.01, tolerance=0.1)
    first, *_ = certificate.sentences()
    assert first.startswith("As built: every joint centre within 0.1 and every leg length within 0.1 of the drawing.")
    assert certificate.tolerances == nd.Tolerances(0.1, 0.1)
    again = type(certificate).from_dict(certificate.to_dict())
    assert again == certificate
    *_, drawn = proved(region, time_limit=0.01)
    with pytest.raises(ValueError, match="another machine"):
        proved(region, time_limit=0.01, tolerance=0.1, resume=drawn)


@pytest.mark.slow(sanitized=True)
def test_tolerances_as_large_as_the_machine_prove_nothing_and_do_not_fail():
    *_, certificate = proved(REGIONS["box"], time_limit=0.01, tolerance=30.0)
    assert not certificate.proved
    with pytest.raises(ValueError, match="tolerance: got 200, expected less than a tenth of the machine's height, 36"):
        proved(REGIONS["box"], tolerance=200.0)
    assert "No bound of the error of its pose is proved: the tolerances are too large" in certificate.sentences()[0]
    assert any(line.startswith("No bound of the condition number is proved") for line in certificate.sentences())


def test_an_error_without_a_bound_has_its_reason(monkeypatch):
    result = nd.optimize(nd.Study.paper(), starts=2)
    certificate = result.certify(time_limit=0.01, tolerance=1e-4)
    assert "p is off by at most" in certificate.sentences()[0]
    assert not certificate.errors_timed
    open_ends = tuple((low, math.inf) for low, _ in certificate.errors)
    without = replace(certificate, errors=open_ends)
    no_bound = "No bound of the error of its pose is proved"
    too_large = f"{no_bound}: the tolerances are too large for the proof. To first order p is off by 0.00"
    assert too_large in without.sentences()[0]
    assert f"{no_bound}: the time ended the search. " in replace(without, errors_timed=True).sentences()[0]
    with monkeypatch.context() as patch:
        patch.setattr(machine, "FOR_LIMITS", 0.0)
        assert result.certify(time_limit=0.0, tolerance=1e-4).errors_timed
    singular = replace(certificate, errors=((math.inf, math.inf),) * 3)
    assert f"{no_bound}: to first order it is infinite at a pose, which is singular." in singular.sentences()[0]
    assert type(certificate).from_dict(without.to_dict()) == without
