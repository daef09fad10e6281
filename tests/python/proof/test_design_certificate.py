"""Certificates of sets of designs that were changed and sealed anew: refused, not confirmed, or true.

Oracle of what is still proved: margins of designs drawn from the boxes at poses drawn from the region, in numpy.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from forged import assert_refused_or_true, line_of, lines_of, no_limit_breaks, sealed, spelled, verdict_of, with_word
from interrupts import interrupter
from sizes import size

import ninedof as nd

STUDY = nd.Study(
    variables={"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": 5.0, "zs": 3.0, "theta_z": 0.0},
    constraints={"leg_length": (2.0, 6.8), "stroke_ratio": (None, 1.22), "leg_clearance": (0.12, None)},
    objective={"region": {"box": (0.3, 0.2, 0.2), "tilt": 0.1}},
)


@pytest.fixture(scope="module")
def designs():
    return nd.admissible(STUDY, ("a2", "b1"), resolution=0.1)


@pytest.fixture(scope="module")
def lines(designs, tmp_path_factory):
    path = designs.save_certificate(tmp_path_factory.mktemp("set") / "designs.certificate")
    return lines_of(path.read_bytes())


@pytest.fixture
def verdict(tmp_path):
    return lambda lines: verdict_of(sealed(lines), tmp_path)


def boxes(lines, state):
    return [n for n, line in enumerate(lines) if line.startswith("box") and f" {state}" in line]


def in_state(lines, n, state):
    """A box in another state, and the shares that go with it."""
    line, old = lines[n], next(word for word in ("inside", "outside", "undecided") if f" {word}" in lines[n])
    ends = [float.fromhex(x) for x in line.split(" ")[1:5]]
    volume = (ends[1] - ends[0]) * (ends[3] - ends[2]) / (8.0 * 4.0)
    out = [*lines[:n], line.split(f" {old}")[0] + " " + state, *lines[n + 1 :]]
    shares = line_of(lines, "shares")
    for place, sign in ((old, -1.0), (state.split(" ")[0], 1.0)):
        k = 1 + ("inside", "outside", "undecided").index(place)
        out = with_word(out, shares, k, spelled(float.fromhex(out[shares].split(" ")[k]) + sign * volume))
    return out


def test_a_genuine_file_is_proved_and_says_what_it_is_about(designs, lines, verdict):
    check = verdict(lines)
    assert check.proved
    assert not check.incomplete
    assert check.boxes == len(designs.state)
    assert "a2 from 2 to 10" in check.study
    angles = "tilts up to 0.1 rad (5.72958 deg), yaw up to 0 rad (0 deg)"
    assert f"at every pose of a box of 0.3, 0.2, 0.2, {angles}, O shifted" in check.study
    assert "stroke_ratio at most 1.22" in check.study
    assert min(len(boxes(lines, state)) for state in ("inside", "outside", "undecided")) > 5


@pytest.mark.slow
def test_a_box_called_inside_that_is_not_is_refused(lines, verdict):
    rng, named = np.random.default_rng(1), 0
    for n in rng.choice(boxes(lines, "outside"), 15, replace=False):
        check = verdict(in_state(lines, n, "inside"))
        assert not check.proved
        named += "called inside" in check.words
        assert check.incomplete or "called inside" in check.words
    assert named > 10


@pytest.mark.slow
def test_an_undecided_box_called_inside_is_refused_not_confirmed_or_true(lines, verdict):
    rng = np.random.default_rng(3)
    refused = 0
    for n in rng.choice(boxes(lines, "undecided"), 15, replace=False):
        forged = in_state(lines, n, "inside")
        check = verdict(forged)
        assert not check.proved or holds(forged, rng, [n] * 4)
        refused += "called inside" in check.words
        assert check.proved or check.incomplete or "called inside" in check.words
    assert refused > 5


def test_a_box_called_outside_that_is_not_is_refused(lines, verdict):
    reason = lines[boxes(lines, "outside")[0]].split(" outside")[1]
    rng = np.random.default_rng(2)
    for n in rng.choice(boxes(lines, "inside"), 15, replace=False):
        check = verdict(in_state(lines, n, "outside" + reason))
        assert not check.proved
        assert "called outside" in check.words


@pytest.mark.slow
def test_a_pose_that_was_moved_is_refused_or_shows_as_much(lines, verdict):
    refused = 0
    for n in boxes(lines, "outside")[:10]:
        words = lines[n].split(" ")
        at = words.index("outside") + 3  # the first coordinate of the pose
        moved = lines
        for place in range(at, at + 6):
            moved = with_word(moved, n, place, "0x0p+0")
        refused += not verdict(moved).proved
        far = with_word(lines, n, at, "0x1p+60")  # the nearest pose of the region counts
        assert not verdict(far).proved or verdict(far).words == verdict(lines).words
        assert not verdict(with_word(lines, n, at - 1, "-2")).proved  # a listed pose, of which there is none
        assert not verdict(with_word(lines, n, at - 1, "-1")).proved  # the neutral pose is no listed one
    assert refused > 0


def test_boxes_that_are_no_division_are_refused(lines, verdict):
    n = boxes(lines, "inside")[3]
    width = float.fromhex(lines[n].split(" ")[2])
    for forged in (
        [*lines[:n], *lines[n + 1 :]],
        [*lines[:n], lines[n], *lines[n:]],
        with_word(lines, n, 2, spelled(np.nextafter(width, 100.0))),
        with_word(lines, n, 2, spelled(np.nextafter(width, 0.0))),
        with_word(lines, line_of(lines, "variable a2"), 3, spelled(10.5)),
        lines[:-1],
    ):
        check = verdict(forged)
        assert not check.proved
        assert "division" in check.words


def test_other_shares_are_refused(lines, verdict):
    n = line_of(lines, "shares")
    for place in (1, 2, 3):
        check = verdict(with_word(lines, n, place, spelled(float.fromhex(lines[n].split(" ")[place]) + 1e-6)))
        assert check.words == "the shares are not those of the boxes"


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("family hexagonal", "family general", "variables are not those"),
        ("family hexagonal", "family hope", "no family"),
        ("variable a1", "variable a9", "variable a1 is missing"),
        ("variable zp 0x1.4p+2 0x1.4p+2", "variable zp 0x1.4p+2 inf", "no bounds"),
        ("0x1.4p+2", "0x1.40p+2", "not spelled"),
        ("0x1.4p+2", "5.0", "not a hexadecimal"),
        ("region box", "region cube", "no shape"),
        ("shifted", "best", "neither"),
        ("limit leg_length", "limit leg length", "hexadecimal"),
        ("shares", "hope", "not in its place"),
        ("exempt 5", "exempt 5 6", "goes on after"),
        ("tool 0x0p+0 0x0p+0 0x0p+0 0x0p+0 0x0p+0 0x0p+0\n", "", 'tool" is missing'),
        ("tool 0x0p+0", "tool inf", "above 1e100"),
        ("exempt 5\n", "", "called inside"),
        ("exempt 5", "exempt 21", "not from 0 to 20"),
        ("exempt 5", "exempt 0", "shares no joint"),
        ("exempt 5", "exempt 99999999999999999999", "whole number"),
        ("inside", "aside", "no state"),
        ("outside 2", "outside 7", "names no limit"),
        ("outside 2", "outside -1", "names no limit"),
        ("tool", "family hexagonal\ntool", "not in its place"),
    ],
)
def test_a_file_that_is_none_is_refused(old, new, words, lines, verdict):
    text = "\n".join(lines)
    assert old in text
    check = verdict(text.replace(old, new, 1).split("\n"))
    assert not check.proved
    assert not check.incomplete
    assert words in check.words
    assert check.study == ()


def test_a_limit_that_the_checker_does_not_know_leaves_it_incomplete(lines, verdict):
    zero = "0x0p+0 0x0p+0 0x0p+0"
    n = line_of(lines, "exempt")
    for line, name in (
        (f"limit hope 0x0p+0 0x1p+3 length poses {zero}", "hope"),
        (f"limit base_cone 0x0p+0 0x1p+1 zp poses {zero}", "base_cone"),
    ):
        check = verdict([*lines[:n], line, *lines[n:]])
        assert check.incomplete
        assert not check.proved
        assert f"not checked: {name}" in check.words


@pytest.mark.slow
def test_a_set_and_a_machine_that_may_lose_a_leg_are_replayed(tmp_path):
    """And not with a lower bound, which a design in the middle of a box breaks."""
    study = replace(STUDY, constraints={"fault_tolerant": (None, 4.8)}, objective={})
    found = nd.admissible(study, {"a2": (5.0, 7.0), "b1": (2.0, 4.0)}, resolution=0.05)
    assert min(found.shares["inside"], found.shares["outside"]) > 0.2
    lines = lines_of(found.save_certificate(tmp_path / "designs.certificate").read_bytes())
    check = verdict_of(sealed(lines), tmp_path)
    assert check.proved, check.words
    assert "fault_tolerant at most 4.8 with the characteristic length 1" in check.study
    n = line_of(lines, "limit fault_tolerant")
    assert "breaks fault_tolerant" in verdict_of(sealed(with_word(lines, n, 3, spelled(4.0))), tmp_path).words
    assert "keeps the limit" in verdict_of(sealed(with_word(lines, n, 3, spelled(6.0))), tmp_path).words
    one = {"variables": dict(study.variables) | {"a2": 6.0, "b1": 3.0}, "objective": {"region": {"ball": 0.05}}}
    machine = nd.optimize(replace(study, **one))
    path = machine.save_certificate(machine.certify(gap=0.5), tmp_path / "machine.certificate")
    assert nd.check_certificate(path).proved


def test_damage_anywhere_is_refused(designs, tmp_path):
    path = designs.save_certificate(tmp_path / "designs.certificate")
    data = path.read_bytes()
    for at in np.random.default_rng(4).integers(0, len(data), size(60, 600)):
        path.write_bytes(data[:at] + bytes([data[at] ^ 1]) + data[at + 1 :])
        assert not nd.check_certificate(path).proved
        path.write_bytes(data[:at])
        assert not nd.check_certificate(path).proved


def holds(lines, rng, which=None):
    """Whether no design of a box inside breaks a limit of the lines, as far as samples show."""
    limits = {
        line.split(" ")[1]: [float.fromhex(x) for x in line.split(" ")[2:4]] for line in lines if "limit " in line
    }
    shape = [float.fromhex(x) for x in lines[line_of(lines, "region")].split(" ")[2:7]]
    fixed = {
        line.split(" ")[1]: float.fromhex(line.split(" ")[2])
        for line in lines
        if line.startswith("variable") and line.split(" ")[1] not in ("a2", "b1")
    }
    study = nd.Study(
        variables=dict(STUDY.variables) | fixed,
        constraints={
            name: (low if low > 0.0 else None, high if math.isfinite(high) else None)
            for name, (low, high) in limits.items()
        },
        objective={"region": {"box": shape[:3], "tilt": shape[3], "yaw": shape[4]}},
    )
    chosen = rng.choice(boxes(lines, "inside"), 4) if which is None else which
    return no_limit_breaks(study, fixed, [lines[n] for n in chosen], 40, rng)


@pytest.mark.slow
def test_what_is_proved_of_a_changed_file_is_true(lines, verdict):
    """Numbers before the boxes, moved by up to some percent."""
    rng = np.random.default_rng(7)

    def change(n, k, value):
        word = spelled(value * math.exp(0.03 * rng.normal()))
        forged = with_word(lines, n, k, word)
        if lines[n].startswith("variable") and lines[n].split(" ")[2] == lines[n].split(" ")[3]:
            forged = with_word(forged, n, 5 - k, word)  # both ends of a variable that is fixed
        return forged

    kinds = ("variable", "region", "limit")
    proved, refused = assert_refused_or_true(lines, kinds, change, verdict, holds, rng, size(60, 600))
    assert proved > 5
    assert refused > 5


@pytest.fixture(scope="module")
def machine_lines(tmp_path_factory):
    """A machine in millimetres whose condition number is proved over a region."""
    sizes = {"a1": 0.0, "a2": 600.0, "b1": 280.0, "b2": 0.0, "zp": 480.0, "zs": 300.0, "theta_z": 0.0}
    objective = {"region": {"box": (40.0, 50.0, 40.0), "tilt": 0.1}, "condition_limit": 6.0}
    result = nd.optimize(nd.Study(variables=sizes, objective=objective, characteristic_length=150.0))
    path = tmp_path_factory.mktemp("machine") / "machine.certificate"
    return lines_of(result.save_certificate(result.certify(gap=0.1), path).read_bytes())


def test_a_machine_that_breaks_its_bound_in_a_corner_is_refused_soon(machine_lines, verdict):
    """With a smaller base the condition number is 7 % above what the file says: refused in a second, not in minutes."""
    n = line_of(machine_lines, "variable a2 ")
    check = verdict(with_word(with_word(machine_lines, n, 2, spelled(480.0)), n, 3, spelled(480.0)))
    assert not check.proved
    assert "the machine is called inside, and its design in the middle breaks condition_number" in check.words


def test_ctrl_c_ends_the_check_of_a_machine(machine_lines, tmp_path):
    n = line_of(machine_lines, "limit condition_number ")
    path = tmp_path / "close.certificate"
    path.write_bytes(sealed(with_word(machine_lines, n, 3, spelled(4.7718))))  # a hair above the worst: minutes
    with interrupter() as interrupt, pytest.raises(KeyboardInterrupt):
        nd.check_certificate(path, progress=interrupt)
