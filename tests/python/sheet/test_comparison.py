"""Machines beside each other, and what a changed dimension does over the region."""

import json
from dataclasses import replace

import numpy as np
import pytest

import ninedof as nd
from ninedof import plot

LIMITS = {"leg_ratio": (None, 3.0), "stroke_ratio": (None, 1.3)}
REGION = {"region": {"box": [0.3, 0.3, 0.2], "tilt_deg": 5.0}}


@pytest.fixture(scope="module")
def machine():
    variables = {"a1": 0.0, "a2": (1.0, 6.0), "b1": (1.0, 3.0), "b2": 0.0, "zp": (2.0, 5.0), "zs": (0.5, 4.0)}
    study = nd.Study(variables=variables | {"theta_z": 0.0}, constraints=LIMITS, objective=REGION, unit="mm", starts=4,
                     characteristic_length=1.0)  # fmt: skip
    return nd.optimize(study, threads=1)


@pytest.fixture(scope="module")
def neutral():
    return nd.optimize(nd.Study(constraints=LIMITS, unit="mm", starts=2, characteristic_length=1.0))


@pytest.fixture(scope="module")
def at_home(neutral):
    """Two designs of a study of the neutral pose."""
    return nd.compare(neutral, neutral.with_changes(b1="+10%"))


@pytest.mark.slow(sanitized=True)
def test_variables_that_differ_by_the_rounding_of_a_unit_are_equal(machine):
    inches = {"a2": 10.1, "b1": 5.7, "zp": 11.3, "zs": 5.6}
    one = replace(machine, study=replace(machine.study, unit="in")).with_changes(**inches)
    other = machine.with_changes(**{name: 25.4 * value for name, value in inches.items()})
    numbers = nd.compare(one, other).numbers
    assert not {*inches} & {*numbers}
    assert "zp" in nd.compare(one, other.with_changes(zp="+1%")).numbers
    assert "What differs in the studies, lengths in the unit of each" in str(nd.compare(one, other))
    assert "unit of each" not in str(nd.compare(other, other.with_changes(zp="+1%")))


@pytest.mark.slow(sanitized=True)
def test_the_limits_that_a_change_breaks_are_named(machine):
    changed = machine.with_changes(a2="+10%")
    both = nd.compare(machine, changed, names=("run", "changed"))
    worst = nd.sheet(changed).condition_number.value
    assert both.numbers["worst condition number"][1] == pytest.approx(worst, rel=1e-9)
    assert both.broken[0] == ()
    assert "leg_ratio max" in both.broken[1]
    assert "changed breaks" in str(both)


@pytest.mark.slow(sanitized=True)
def test_values_outside_of_the_bounds_of_their_study_are_named(machine):
    changed = machine.with_changes(a2=6.5, b1=2.0, theta_z_deg=10.0)
    both = nd.compare(machine, changed, names=("run", "changed"))
    assert both.outside == ({}, {"a2": (6.5, 1.0, 6.0), "theta_z": (pytest.approx(np.radians(10.0)), 0.0, 0.0)})
    words = "changed is outside of the bounds of its study: a2 = 6.5 mm (1 to 6), theta_z = 10° (fixed at 0)"
    assert words in str(both)
    assert both.to_dict()["outside"][1]["a2"] == [6.5, 1.0, 6.0]


@pytest.mark.slow(sanitized=True)
def test_the_actuators_of_machines_stand_beside_each_other(machine):
    """The rows chosen, their lengths, the limits that they set, prices; a change keeps the rows of its study."""
    long, short = nd.Actuator("long", 2.0, 9.0, price=120.5), nd.Actuator("short", 0.2, 2.5, price=80.0)
    variables = machine.study.variables | {"a2": 5.0, "b1": 2.5, "zp": 4.0, "zs": 2.4}
    study = replace(machine.study, variables=variables, constraints={}, objective={"poses": [{}]}, starts=1)
    chosen = nd.optimize(replace(study, actuators=[long, short]))
    names = [row.name for row in chosen.actuators.chosen.rows.values()]
    price = 3 * sum({"long": 120.5, "short": 80.0}[name] for name in names)
    both = nd.compare(chosen, machine, chosen.with_changes(zp="+1%"))
    text = [" ".join(line.replace("│", " ").split()) for line in str(both).splitlines()]
    for kind, name in zip(("external", "upper", "lower"), names, strict=True):
        row = {"long": long, "short": short}[name]
        k = text.index(f"{kind} {name} - {name}")
        assert text[k + 1] == f"from {row.shortest:g} to {row.longest:g} mm {row.shortest:g} to {row.longest:g} mm"
        assert text[k + 2] == "limits set length length"
        assert text[k + 3] == f"price of one {row.price:g} {row.price:g}"
    assert f"price of all nine {price:g} - {price:g}" in text
    assert both.to_dict()["actuators"][1] is None
    assert "Actuators" not in str(nd.compare(machine, machine))
    rows = [replace(one, name=f"{one.name} 2", price=10.0 * one.price) for one in (long, short)]
    dear = nd.optimize(replace(study, actuators=rows))
    assert dear.study == chosen.study
    rows = nd.compare(chosen, dear, chosen.with_changes(zp="+1%")).actuators
    assert [row and row.price for row in rows] == [price, 10.0 * price, None]


def test_a_change_of_nothing_changes_nothing_and_what_differs_in_the_studies(machine):
    same = machine.with_changes(b1=machine.variables["b1"])
    other = replace(same, study=replace(same.study, constraints=LIMITS | {"leg_ratio": (None, 2.9)}))
    both = nd.compare(machine, other)
    assert all(one == pytest.approx(other, rel=1e-9) for one, other in both.numbers.values())
    assert both.differences == {"constraints.leg_ratio.max": (3.0, 2.9)}
    assert "outside" not in str(both)
    assert str(both).startswith("Numbers over the poses or the region of each study\n")


def test_long_entries_of_studies_are_told_apart_by_the_first_that_differs(neutral):
    """Cut to 20 characters, two lists of loads were the same "[[0.0, 0.0, 0.0, ..."."""
    rows = [[0.0, 0.0, 0.0, 0.0, 0.0, 90.0], [0.0, 0.0, 0.0, 5.0, 0.0, 90.0]]
    one, two = (replace(neutral, study=replace(neutral.study, loads={"wrenches": rows[:k]})) for k in (1, 2))
    words = (
        "loads.wrenches, no. {}, the first that differs: A {} ({} in all), B [0.0, 0.0, 0.0, {}, 0.0, 90.0] ({} in all)"
    )
    assert words.format(2, "none", 1, "5.0", 2) in str(nd.compare(one, two))
    assert words.format(1, "none", 0, "0.0", 1) in str(nd.compare(neutral, one))
    named = [
        replace(neutral, study=replace(neutral.study, about={"project": f"Polishing machine no. {k}"})) for k in "XY"
    ]
    assert "about.project: A Polishing machine no. X, B Polishing machine no. Y" in " ".join(
        str(nd.compare(*named)).split()
    )


def test_changes_that_do_not_fit_are_refused(machine):
    for changes, words in (
        ({"b1": -1.0}, "b1: got -1"),
        ({"radius": 1.0}, "expected one of a1, a2"),
        ({"b1": "+1"}, "as '"),
        ({"b1": "wide"}, "as '"),
        ({}, "got none"),
        ({"zs": 3.0, "zp": 3.0}, r"zs, zp: got zs = 3, expected 0 < zs < zp = 3"),
        ({"zs": 0.0}, "zs: got zs = 0, expected 0 < zs < zp"),
        ({"a1": 0.0, "a2": 0.0}, "a1, a2: .*expected a base of some size"),
        ({"theta_z": 30.0}, "theta_z: got 30 rad, expected at most a turn, or theta_z_deg"),
    ):
        with pytest.raises(ValueError, match=words):
            machine.with_changes(**changes)


def test_lengths_are_in_the_unit_of_the_first_and_all_have_one(machine):
    design = nd.Design(machine.geometry, machine.configuration, 1.0, "mm")
    metres = nd.Design(
        nd.Geometry.hexagonal(0.0, machine.variables["a2"] / 1e3, machine.variables["b1"] / 1e3, 0.0),
        nd.Configuration.neutral(machine.variables["zp"] / 1e3, machine.variables["zs"] / 1e3),
        1e-3,
        "m",
    )
    both = nd.compare(design, metres)
    assert all(one == pytest.approx(other, rel=1e-9) for one, other in both.numbers.values())
    assert both.outside == ({}, {})  # without a study
    with pytest.raises(ValueError, match="got A in mm and B in no unit"):
        nd.compare(design, design._replace(unit=""))


@pytest.mark.slow(sanitized=True)
def test_both_commands_fit_on_80_columns_and_draw(machine, run, tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    nd.save(machine, tmp_path / "run")
    name, picture = str(tmp_path / "run"), tmp_path / "plates.png"
    neutral = str(nd.save(nd.Design(machine.geometry, machine.configuration, 1.0, "mm"), tmp_path / "neutral.toml"))
    for line in (f"evaluate {name} --set b1=+10% --plot {picture}", f"compare {name} {neutral} {neutral}"):
        status, out, _ = run(line)
        assert status == 0
        assert max(len(line) for line in out.splitlines() if str(tmp_path) not in line) <= 80
    assert picture.read_bytes().startswith(b"\x89PNG")
    data = json.loads(run(f"evaluate {name} --set b1=+10% --json")[1])
    assert data["numbers"]["b1"][1] == pytest.approx(1.1 * machine.variables["b1"])


def test_plates_are_in_one_scale(at_home):
    assert not at_home.differences  # the dimensions alone differ
    figure = plot.compare(at_home)
    base, platform = figure.axes
    assert base.get_xlim() == platform.get_xlim() == base.get_ylim()


def test_heights_of_a_tool_are_explained(at_home):
    values = {"a1": 0.0, "a2": 5.0, "b1": 2.5, "b2": 0.0, "zp": 4.0, "zs": 2.0}
    with_tool, without = (
        nd.optimize(nd.Study(variables=values, tool=tool)) for tool in ({"position": (0.0, 0.0, -0.5)}, {})
    )
    both = nd.compare(with_tool, without)
    assert both.numbers["height p"] == pytest.approx((3.5, 4.0))
    assert "height p its height; zp is that of the plate" in str(both)
    assert "of the plate" not in str(at_home)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("zp=4", "set: zp from {zp} mm to 4 mm"),
        ("b1=+10%", "set: b1 from {b1} mm to {more} mm"),
        ("theta_z_deg=30", "set: theta_z from 0 deg to 30 deg"),
        ("a1=0", "set: a1 is 0 mm in the run already"),
    ],
)
def test_a_change_says_from_what_to_what(machine, tmp_path, run, given, words):
    nd.save(machine, tmp_path / "run")
    values = {name: f"{x:.7g}" for name, x in machine.variables.items()}
    values["more"] = f"{1.1 * machine.variables['b1']:.7g}"
    assert words.format(**values) in run(f"evaluate {tmp_path / 'run'} --set {given}")[1].splitlines()
