"""Actuators of a study: rows, files of rows, and the limits of the legs that have them."""

import math
import pickle
import re
from dataclasses import replace

import numpy as np
import pytest
from duty_oracle import DUTY

import ninedof as nd
from ninedof.design.actuators import hull
from ninedof.optimize.actuator_choice import notes_of
from ninedof.optimize.actuators import least_travel

INF = math.inf
ROWS = [
    {"name": "A", "shortest": 2.0, "longest": 5.0, "force": 80.0, "rate": 1.5, "price": 100.0},
    {"name": "B", "shortest": 3.0, "longest": 8.0, "price": 0},
]
HEAD = "name,shortest,longest,force,rate,price\n"
FILE = HEAD + "A,2,5,80,1.5,100\n# what the shop has\n\nB,3,8,,,0\n"
A, B = (nd.Actuator(**row) for row in ROWS)


def saved(folder, text, name="catalogue.csv"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_rows_of_a_study_are_those_of_its_file(tmp_path):
    typed = nd.Study(actuators=ROWS, actuators_for="all", greatest_price=700)
    assert typed.actuators == (A, B)
    assert (B.force, B.rate, B.price) == (INF, INF, 0.0)
    typed.save(tmp_path / "study.toml")
    assert nd.Study.load(tmp_path / "study.toml") == typed
    assert nd.Study.from_dict(typed.to_dict()) == typed
    assert "actuators" not in nd.Study().to_dict()
    (tmp_path / "lists").mkdir()
    saved(
        tmp_path / "lists", "﻿price,name,stroke,longest (mm),shortest (mm),rate,force\n100,A,3,5,2,1.5,80\n0,B,5,8,3,,\n"
    )
    text = 'unit = "mm"\nactuators = "lists/catalogue.csv"\n[design]\nactuators_for = "all"\ngreatest_price = 700.0\n'
    loaded = nd.Study.load(saved(tmp_path, text, "listed.toml"))
    assert (loaded.actuators, loaded.actuators_for, loaded.greatest_price) == ((A, B), "all", 700.0)
    assert (loaded.catalogue, typed.catalogue) == ("lists/catalogue.csv", "")
    assert notes_of(loaded)[0] == "actuators from lists/catalogue.csv, 2 rows"
    assert not any("rows" in words for words in notes_of(typed))
    read = nd.Study(actuators=saved(tmp_path, FILE))
    assert (read.actuators, read.catalogue) == ((A, B), "catalogue.csv")
    other = replace(read, actuators=saved(tmp_path, FILE, "other.csv"))
    assert (other.catalogue, replace(read, actuators=[A]).catalogue, replace(read, actuators=()).catalogue) == (
        "other.csv",
        "",
        "",
    )
    assert pickle.loads(pickle.dumps(read)).catalogue == replace(read, starts=3).catalogue == "catalogue.csv"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "got an empty file, expected a line with the names"),
        (HEAD, "got no rows, expected at least one actuator"),
        (HEAD.replace(",", ";"), "line 1: got columns separated by semicolons, expected commas"),
        (HEAD.replace(",", "\t"), "line 1: got columns separated by tabs, expected commas"),
        (FILE.replace("rate", "speed"), "line 1: got no column rate, expected name, shortest, longest, force, "),
        (FILE.replace("rate", "force"), "line 1, column force: got it twice"),
        (FILE.replace("shortest", "shortest (in)"), "line 1, column shortest: got in, expected mm as in the study"),
        ("A,2,5,80,1.5,100\n", "line 1: got the number 2, expected the names of the columns"),
        (FILE + "C,1,2\n", "line 6: got 3 entries, expected 6"),
        (FILE + "C,,2,,,\n", "line 6, column shortest: got '', expected a finite number"),
        (FILE + "C,1,two,,,\n", "line 6, column longest: got 'two', expected a finite number"),
        (FILE + "C,2,1,,,\n", "line 6, column longest: got 1, expected more than the shortest, 2"),
        (FILE + "C,1,2,-5,,\n", "line 6, column force: got -5.0, expected a number above 0"),
        (FILE + "C,1,2,,,-5\n", "line 6, column price: got -5.0, expected a finite number at least 0"),
        (FILE + ",1,2,,,\n", "line 6, column name: got '', expected a name"),
        (FILE + "A,1,2,,,\n", "name: got two rows of the name 'A', expected each name once"),
    ],
)  # fmt: skip
def test_bad_files(tmp_path, text, message):
    path = saved(tmp_path, text)
    for read in (
        lambda: nd.Study(unit="mm", actuators=path),
        lambda: nd.Study.load(saved(tmp_path, 'unit = "mm"\nactuators = "catalogue.csv"', "study.toml")),
    ):
        with pytest.raises(ValueError, match=re.escape(f"{path}: {message}")):
            read()


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        (
            {"actuators": [{"name": "A", "shortest": 1}]},
            "actuators[0]: got no longest, expected name, shortest, longest",
        ),
        ({"actuators": [ROWS[0] | {"shortest": 5}]}, "actuators[0].longest: got 5, expected more than the shortest, 5"),
        ({"actuators": [ROWS[0] | {"shortest": 0}]}, "actuators[0].shortest: got 0, expected a number above 0"),
        ({"actuators": [ROWS[0] | {"force": -1}]}, "actuators[0].force: got -1, expected a number above 0"),
        ({"actuators": [ROWS[0] | {"forces": 1}]}, "did you mean 'force'?"),
        ({"actuators": [ROWS[0] | {"name": " "}]}, "actuators[0].name: got ' ', expected a name"),
        ({"actuators": [ROWS[0], ROWS[0]]}, "actuators: got two rows of the name 'A', expected each name once"),
        ({"actuators": 3}, "actuators: got 3, expected rows with name, shortest and longest"),
        ({"actuators": [3]}, "actuators[0]: got 3, expected a mapping"),
        ({"actuators": ROWS, "actuators_for": "legs"}, "actuators_for: got 'legs', expected one of kinds, all"),
        ({"greatest_price": 5}, "greatest_price: got 5 without actuators, expected both"),
        (
            {"actuators": [A, nd.Actuator("C", 1, 2)], "greatest_price": 5},
            "actuators[1].price: got none, expected a number, as greatest_price is given",
        ),
        (
            {"actuators": ROWS, "constraints": {"upper_length": (None, 3)}},
            "constraints.upper_length: got it beside actuators, which set it",
        ),
    ],
)
def test_bad_rows(entries, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        nd.Study(**entries)


def test_a_study_file_names_rows_or_a_file_beside_it(tmp_path):
    saved(tmp_path, FILE)
    (tmp_path / "studies").mkdir()
    for name in ("../catalogue.csv", str(tmp_path / "catalogue.csv")):
        with pytest.raises(ValueError, match="expected a CSV file in the folder of the study file"):
            nd.Study.load(saved(tmp_path / "studies", f'actuators = "{name}"', "study.toml"))
    with pytest.raises(ValueError, match=r"actuators: got no rows, expected at least one"):
        nd.Study.from_dict({"actuators": []})
    with pytest.raises(ValueError, match=r"actuators: got 'catalogue.csv', expected rows"):
        nd.Study.from_dict({"actuators": "catalogue.csv"})  # of a record: it names no files
    with pytest.raises(ValueError, match=r"none.csv: cannot be read"):
        nd.Study.load(saved(tmp_path, 'actuators = "none.csv"', "study.toml"))


def test_rows_become_limits_of_their_legs():
    study = nd.Study(actuators=ROWS, constraints={"force": (None, 500.0)}, **DUTY)
    chosen = study.with_actuators({"external": A, "upper": B})
    assert chosen.constraints == {
        "force": (None, 500.0),
        "external_length": (2.0, 5.0),
        "external_force": (None, 80.0),
        "external_rate": (None, 1.5),
        "upper_length": (3.0, 8.0),
    }
    assert (chosen.actuators, study.actuators) == ((), (A, B))
    assert dict(nd.Study(actuators=ROWS).with_actuators({"lower": A}).constraints) == {"lower_length": (2.0, 5.0)}
    assert hull([A, B]) == nd.Actuator("any", 2.0, 8.0)
    assert hull([A, replace(A, name="C", force=90.0)]) == nd.Actuator("any", 2.0, 5.0, 90.0, 1.5)


def test_forces_and_rates_of_a_kind_are_those_of_its_legs():
    """Beside those of all legs, in every leg's own number."""
    names = [f"{kind}_{what}" for what in ("force", "rate") for kind in ("external", "upper", "lower")]
    study = nd.Study(constraints=dict.fromkeys(["force", "rate", *names], (None, 50.0)), **DUTY)
    point = study.evaluate({"a1": 0.5, "a2": 5.0, "b1": 3.0, "b2": 0.4, "zp": 4.0, "zs": 2.4})
    for what in ("force", "rate"):
        of_kinds = [point.values[f"{kind}_{what}"] for kind in ("external", "upper", "lower")]
        assert max(of_kinds) == pytest.approx(point.values[what], rel=1e-12)
        assert len({round(value, 9) for value in of_kinds}) == 3


@pytest.mark.parametrize(("one", "other", "as_good"), [
    (B, nd.Actuator("C", 3.5, 8.0, price=0.0), True),
    (B, nd.Actuator("C", 2.5, 8.0, price=0.0), False),
    (B, nd.Actuator("C", 3.5, 8.5, price=0.0), False),
    (A, nd.Actuator("C", 2.0, 5.0, 80.0, 1.5, 120.0), True),
    (A, nd.Actuator("C", 2.0, 5.0, 80.0, 1.5, 90.0), False),
    (A, nd.Actuator("C", 2.0, 5.0, 90.0, 1.5, 120.0), False),
    (A, nd.Actuator("C", 2.0, 5.0, 80.0, 1.6, 120.0), False),
    (A, nd.Actuator("C", 2.0, 5.0, 80.0, 1.5), False),
])  # fmt: skip
def test_which_row_makes_another_superfluous(one, other, as_good):
    assert one.is_as_good_as(other) is as_good


@pytest.mark.parametrize("rule", ["shifted", "held"])
@pytest.mark.parametrize("shape", [{"box": (0.9, 0.7, 0.4)}, {"ball": 0.5}, {"cylinder": (0.6, 0.3)}])
def test_no_design_has_a_shorter_stroke(rule, shape):
    region = nd.Region(**shape, internal_point=rule)
    rng = np.random.default_rng(5)
    directions = rng.normal(size=(400, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    sizes = np.array(shape.get("box") or [shape.get("ball", 0.0)] * 3)
    if "cylinder" in shape:
        sizes = np.array([0.6, 0.6, 0.3])
    shifts = directions * np.min(sizes)
    least = np.full(3, np.inf)
    for _ in range(60):
        g = nd.Geometry.hexagonal(*rng.uniform(0.3, 6.0, 4))
        zp = rng.uniform(1.0, 6.0)
        home = nd.Configuration.neutral(zp, rng.uniform(0.2, 0.8) * zp)
        moved = shifts if rule == "shifted" else 0.0 * shifts
        c = nd.Configuration(home.position + shifts, home.rotation, home.internal_point + moved)
        stroke = np.ptp(nd.leg_lengths(g, c), axis=0).reshape(3, 3).min(axis=1)
        least = np.minimum(least, stroke)
    travel = [least_travel(region, kind) for kind in ("external", "upper", "lower")]
    assert (travel <= least * 1.03 + 1e-12).all()  # the ball is sampled
    assert travel == [2.0 * sizes.min(), 2.0 * sizes.min() * (rule == "held"), 2.0 * sizes.min() * (rule == "shifted")]
    assert least_travel(nd.Region(**shape, unit="zp"), "external") == 0.0
    assert (
        least_travel(nd.Region(tilt=0.1), "external")
        == least_travel(nd.Region(path=((0, 0, 0), (1, 0, 0))), "external")
        == 0.0
    )
