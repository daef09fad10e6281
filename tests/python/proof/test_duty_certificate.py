"""Certificates of sets of designs with limits of forces, rates and powers: replayed; changed, refused or true.

Oracle of what is still proved: forces and rates in numpy of designs drawn from the boxes, at poses from the region.
"""

import math

import numpy as np
import pytest
import set_in_balls
from duty_oracle import DUTY
from forged import assert_refused_or_true, line_of, lines_of, no_limit_breaks, sealed, spelled, verdict_of, with_word
from sizes import size

import ninedof as nd

SIZES = {"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": 5.0, "zs": 3.0, "theta_z": 0.0}
LIMITS = {"force": (None, 85.0), "rate": (None, 1.6), "power": (None, 112.0), "lower_force": (None, 83.0)}
WEIGHTS = "gravity 0.4, 0, -9.81, mass of the platform 3, centre {} in the frame of the plate, of O 0.1"
REGION = {"box": (0.1, 0.05, 0.05)}  # O is carried


@pytest.fixture(scope="module")
def lines(tmp_path_factory):
    study = nd.Study(variables=SIZES, constraints=LIMITS, objective={"region": REGION}, **DUTY)
    designs = nd.admissible(study, ("a2", "b1"), resolution=0.06)
    return lines_of(designs.save_certificate(tmp_path_factory.mktemp("set") / "designs.certificate").read_bytes())


@pytest.fixture
def verdict(tmp_path):
    return lambda lines: verdict_of(sealed(lines), tmp_path)


def test_a_set_with_limits_of_forces_and_rates_is_replayed(lines, verdict):
    check = verdict(lines)
    assert check.proved, check.words
    assert "force at most 85" in check.study
    assert WEIGHTS.format("(0.1, -0.2, 0.3)") in check.study
    assert "load of the moment 30, -20, 5, the force 20, 10, -20, the force on O 0, 0, 0" in check.study
    assert "speeds up to 0.7 and 0.4 rad (22.9183 deg) per time, O carried" in check.study
    for state in ("inside", "outside"):
        assert sum(f" {state}" in line for line in lines) > 20


@pytest.mark.parametrize("rotation", [(0.0, 0.0, 0.0), (0.3, -0.2, 0.7), (3.0, 0.5, 0.0)])
def test_the_centre_of_the_mass_is_shown_in_the_frame_of_the_plate(tmp_path, rotation):
    """As the study and the sheet have it; the file has it in the frame of the tool."""
    tool = {"position": (0.5, 0.0, -0.3), "rotation": rotation}
    study = nd.Study(variables=SIZES, constraints=LIMITS, objective={"region": REGION}, tool=tool, **DUTY)
    designs = nd.admissible(study, ("a2", "b1"), resolution=0.9, time_limit=0.1)
    check = nd.check_certificate(designs.save_certificate(tmp_path / "designs.certificate"))
    assert WEIGHTS.format("(0.1, -0.2, 0.3)") in check.study


@pytest.mark.slow
def test_a_machine_that_keeps_its_forces_and_rates_is_replayed(tmp_path):
    fixed = SIZES | {"a2": 6.0, "b1": 3.0}
    region = REGION | {"tilt": 0.1, "yaw": 0.1, "internal_point": "held"}
    limits = {"force": (None, 200.0), "rate": (None, 4.0), "upper_rate": (None, 4.0)}
    result = nd.optimize(nd.Study(variables=fixed, constraints=limits, objective={"region": region}, **DUTY))
    path = result.save_certificate(result.certify(gap=0.5), tmp_path / "machine.certificate")
    assert nd.check_certificate(path).proved
    lines = lines_of(path.read_bytes())
    for start in ("weights ", "leg ", "load ", "speeds "):
        path.write_bytes(sealed([line for line in lines if not line.startswith(start)]))
        assert "the duty lacks its weights, its nine legs, its loads or its speeds" in nd.check_certificate(path).words
    n = line_of(lines, "weights")
    path.write_bytes(sealed(with_word(lines, n, 4, spelled(-3.0))))
    assert "the masses or speeds of the duty are none" in nd.check_certificate(path).words


@pytest.mark.parametrize(
    ("start", "new"),
    [
        ("weights", None),
        ("leg", None),
        ("load", None),
        ("speeds", None),
        ("speeds", "speeds 0x1p+0 0x0p+0 hope"),
        ("speeds", "speeds -0x1p+0 0x0p+0 carried"),
        ("speeds", "speeds 0x1p+0 inf carried"),
        ("leg", "leg 0x0p+0 0x0p+0 0x0p+0"),
        ("leg", "leg 0x1p+1023 0x1p-1 0x0p+0 0x0p+0"),  # what overflows was divided for minutes
    ],
)
def test_a_duty_that_is_none_is_refused(start, new, lines, verdict):
    """Without loads every force would be small enough."""
    first = line_of(lines, start)
    last = first + (new is not None or sum(line.startswith(f"{start} ") for line in lines))
    forged = [*lines[:first], *[new] * (new is not None), *lines[last:]]
    check = verdict(forged)
    assert not check.proved
    assert not check.incomplete
    assert set_in_balls.check(sealed(forged)).startswith("refused")


def test_no_duty_at_all_is_refused(lines, verdict):
    check = verdict([line for line in lines if line.split(" ")[0] not in ("weights", "leg", "load", "speeds")])
    assert "force is a limit of a duty, and the file has none" in check.words


def machine(lines, rule):
    """One design of a box inside, whose O moves by another rule."""
    words = next(line for line in lines if line.endswith(" inside")).split(" ")
    lines = [line for line in lines if not line.startswith("box ")]
    for name, value in (("a2", words[1]), ("b1", words[3])):
        lines[line_of(lines, f"variable {name} ")] = f"variable {name} {value} {value}"
    lines[line_of(lines, "shares")] = "shares 0x1p+0 0x0p+0 0x0p+0"
    return [*with_word(lines, line_of(lines, "speeds"), 3, rule), "box inside"]


@pytest.mark.parametrize("rule", ["carried", "held", "shifted", "least"])
def test_forces_and_rates_are_shown_in_balls_too(rule, lines, verdict):
    """By a balance of platform and O and by 3 x 3 systems; the checker's numbers are those of nine equations."""
    one = machine(lines, rule)
    assert verdict(one).proved
    assert set_in_balls.check(sealed(one)) == "proved"


@pytest.mark.parametrize(
    ("start", "place", "value"),
    [
        ("weights", 3, -60.0),
        ("weights", 4, 30.0),
        ("weights", 5, 20.0),
        ("weights", 8, 60.0),
        ("leg", 1, 60.0),
        ("leg", 3, 60.0),
        ("load", 6, -300.0),
        ("load", 9, 2000.0),
        ("speeds", 1, 4.0),
        ("speeds", 2, 6.0),
        ("limit force", 3, 20.0),
        ("limit rate", 3, 0.4),
        ("limit power", 3, 10.0),
        ("limit lower_force", 3, 10.0),
    ],
)
def test_a_changed_duty_that_a_machine_does_not_bear_is_proved_by_neither(start, place, value, lines, verdict):
    one = machine(lines, "carried")
    forged = with_word(one, line_of(one, start), place, spelled(value))
    assert "breaks" in verdict(forged).words
    assert set_in_balls.check(sealed(forged)) == "incomplete"


def numbers(lines, start):
    return [[float.fromhex(x) for x in line.split(" ")[1:] if "0x" in x] for line in lines if line.startswith(start)]


def holds(lines, rng):
    """Whether no design of the boxes inside breaks a limit of the lines, as far as samples show."""
    weights, leg, (linear, angular) = (
        numbers(lines, "weights ")[0],
        numbers(lines, "leg ")[0],
        *numbers(lines, "speeds "),
    )
    names = ("cylinder", "cylinder_centre", "rod", "rod_centre")
    fixed = {w[1]: float.fromhex(w[2]) for w in (line.split(" ") for line in lines) if w[0] == "variable"}
    study = nd.Study(
        variables=SIZES | {name: x for name, x in fixed.items() if name not in ("a2", "b1")},
        constraints={w[1]: (None, float.fromhex(w[3])) for w in (line.split(" ") for line in lines) if w[0] == "limit"},
        loads={"gravity": weights[:3], "wrenches": [load[:6] for load in numbers(lines, "load ")]},
        masses={"platform": weights[3], "centre": weights[4:7], "internal_point": weights[7]}
        | dict(zip(names, leg, strict=True)),
        speeds={"linear": linear, "angular": angular},
        objective={"region": {"box": numbers(lines, "region ")[0][:3]}},
    )
    inside = [line for line in lines if line.endswith(" inside")]
    return no_limit_breaks(study, fixed, [inside[k] for k in rng.integers(0, len(inside), 4)], 12, rng)


@pytest.mark.slow
def test_what_is_proved_of_changed_loads_masses_speeds_and_limits_is_true(lines, verdict):
    """A number before the boxes, moved by a fifth; of the legs, all nine."""
    rng = np.random.default_rng(17)

    def change(n, k, value):
        word, forged = spelled(value * math.exp(0.2 * rng.normal())), lines
        for m in range(len(lines)):
            if m == n or (lines[n].startswith("leg ") and lines[m].startswith("leg ")):
                forged = with_word(forged, m, k, word)
        return forged

    kinds = ("weights", "leg", "load", "speeds", "limit", "region")
    proved, refused = assert_refused_or_true(lines, kinds, change, verdict, holds, rng, size(25, 400))
    assert proved > 2
    assert refused > 2
