"""`ninedof admissible`: what it prints and keeps, how it goes on, and what it refuses."""

import json
import zlib
from dataclasses import replace

import numpy as np
import pytest

import ninedof as nd

STUDY = """
[variables]
a1 = 0.0
a2 = [2.0, 10.0]
b1 = [1.0, 5.0]
b2 = 0.0
zp = [2.0, 8.0]
zs = [1.0, 6.0]
[constraints]
radius_ratio = { max = 2.5 }
leg_ratio = { max = 3.0 }
"""
ASKED = "--vary a2 --vary b1 --set zp=5 --set zs=3 --resolution"


@pytest.fixture
def study(tmp_path):
    file = tmp_path / "study.toml"
    file.write_text(STUDY)
    return file


def test_what_is_printed_is_what_python_proves(run, study, tmp_path):
    status, out, err = run(f"admissible {study} {ASKED} 0.05 --around --json --out {tmp_path / 'set'}")
    assert status == 0
    answer = json.loads(out)
    found = nd.admissible(nd.Study.load(study), ("a2", "b1"), at={"zp": 5.0, "zs": 3.0}, resolution=0.05)
    assert answer["shares"] == pytest.approx(found.shares)
    assert list(answer["excluded"]) == list(found.excluded)
    assert set(answer["excluded"]) == {"radius_ratio", "leg_ratio"}
    assert "keep every limit at every pose" in " ".join(err.split())
    names = {file.name for file in (tmp_path / "set").iterdir()}
    assert names == {"admissible-a2-b1.npz", *(f"admissible-a2-b1.{kind}" for kind in ("png", "svg", "pdf"))}
    assert answer["around"].keys() == {"a2", "b1"}


def test_its_certificate_is_checked_by_another_command(run, study, tmp_path):
    file = tmp_path / "designs.certificate"
    status, out, err = run(f"admissible {study} {ASKED} 0.1 --certificate {file} --json")
    assert status == 0
    assert json.loads(out)["certificate"] == str(file)
    shares = json.loads(out)["shares"]
    status, out, err = run(f"check {file} --json")
    assert status == 0
    answer = json.loads(out)
    assert answer["proved"]
    assert not answer["incomplete"]
    assert answer["words"].startswith(f"{shares['inside']:.3%}")
    assert "leg_ratio at most 3" in err
    lines = file.read_text().splitlines()
    lines[2:] = [line.replace("limit leg_ratio", "limit hope") for line in lines[2:]]
    body = "".join(f"{line}\n" for line in lines[2:])
    file.write_text(f"{lines[0]}\nchecksum {zlib.crc32(body.encode()):x}\n{body}")
    status, out, err = run(f"check {file}")
    assert status == 3
    assert "Incomplete: not confirmed are" in " ".join(out.split())
    assert "not checked: hope" in " ".join(out.split())


@pytest.mark.slow(sanitized=True)
def test_the_same_command_goes_on_and_another_question_begins_anew(run, study, tmp_path):
    folder = str(tmp_path / "set")
    shares = []
    for resolution in ("0.3", "0.05", "0.05"):
        status, out, _ = run(f"admissible {study} {ASKED} {resolution} --json --out {folder}")
        assert status == 0
        shares.append(json.loads(out))
    assert shares[1]["shares"]["undecided"] < shares[0]["shares"]["undecided"]
    assert shares[2]["designs"] >= shares[1]["designs"] > shares[0]["designs"]
    status, out, _ = run(f"admissible {study} {ASKED} 0.05 --condition 3.8 --json --out {folder}")
    assert status == 0
    assert "condition_number" in json.loads(out)["excluded"]


def test_a_value_of_a_variable_that_varies_is_that_of_the_marked_design(run, study, tmp_path, monkeypatch):
    """It began the search anew without a word, and left the old one as that of another question."""
    monkeypatch.setattr("ninedof.plot.admissible", lambda _: None)
    monkeypatch.setattr("ninedof.plot.save", lambda *_: [])
    folder = tmp_path / "set"
    line = f"admissible {study} {ASKED} 0.3 --out {folder}"
    status, before, _ = run(line)
    status, out, _ = run(f"{line} --set a2=6")
    assert status == 0
    assert "a2 varies: --set says which design is marked and where --around begins." in " ".join(out.split())
    assert "another question" not in out
    assert "varies" not in before
    assert nd.AdmissibleSet.load(folder / "admissible-a2-b1.npz").of.at["a2"] == 6.0
    whole = nd.AdmissibleSet.load(folder / "admissible-a2-b1.npz")
    anew = nd.admissible(nd.Study.load(study), ("a2", "b1"), at={"a2": 6.0, "zp": 5.0, "zs": 3.0}, resolution=0.3)
    assert whole.shares["inside"] >= anew.shares["inside"] > 0.0
    assert "a2 and b1 vary: --set" in " ".join(run(f"{line} --set a2=6 --set b1=3")[1].split())
    assert "a2 is outside of the range: the middle is marked." in " ".join(run(f"{line} --set a2=60")[1].split())
    another = line.replace("zs=3", "zs=3.1")
    assert "the designs of another question are kept as" in " ".join(run(another)[1].split())
    assert (folder / "admissible-a2-b1-earlier.npz").is_file()


@pytest.mark.slow(sanitized=True)
def test_a_run_gives_the_other_variables(run, study, tmp_path):
    folder = tmp_path / "run"
    assert run(f"optimize {study} --out {folder} --starts 4 --no-report")[0] == 0
    status, out, _ = run(f"admissible {folder} --vary a2 --vary zp --resolution 0.1")
    assert status == 0
    assert (folder / "admissible-a2-zp.npz").exists()
    assert "zp from 2 to 8" in " ".join(out.split())
    result = nd.load(folder)
    line = (
        f"admissible {folder} --vary theta_z_deg=-20:20 --set zs=+10% --set theta_z_deg=5 --set b1=-5% --resolution 0.1"
    )
    status, out, _ = run(f"{line} --json")
    assert status == 0
    at = {"zs": 1.1 * result.variables["zs"], "b1": 0.95 * result.variables["b1"], "theta_z": np.radians(5.0)}
    expected = nd.admissible(result, {"theta_z": np.radians((-20.0, 20.0))}, at=at, resolution=0.1)
    same = nd.admissible(
        result, {"theta_z_deg": (-20.0, 20.0)}, at={"zs": "+10%", "b1": "-5%", "theta_z_deg": 5.0}, resolution=0.1
    )
    assert same.of.ranges == expected.of.ranges == (tuple(np.radians((-20.0, 20.0))),)
    assert same.of.at == pytest.approx(expected.of.at, rel=1e-15)
    assert json.loads(out)["shares"] == pytest.approx(expected.shares)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("--vary a3", "--vary: got 'a3', expected variables of the study: a1, a2"),
        ("--vary a1", "--vary a1: got a variable that is fixed in the study, expected its ends too, (low, high)"),
        ("--vary a2=8:2", "--vary a2: got (8, 2), expected low < high"),
        ("--vary a2=1", "--vary: got a2=1, expected NAME or NAME=LOW:HIGH"),
        ("--vary a2", "--set: got no b1, expected a value"),
        ("--vary a2 --set b1=x", "--set: got 'b1=x', expected NAME=VALUE"),
        ("--vary a2 --set zs=+10%", "zs: got '+10%', expected a number: it has no value to change"),
        ("--vary a2 --set theta_z=30", "theta_z: got 30 rad, expected at most a turn, or theta_z_deg"),
        ("--vary theta_z=0:30", "theta_z: got 30 rad, expected at most a turn, or theta_z_deg"),
        ("--vary a2 --set b9=1", "--set: got 'b9', expected one of a1, a2"),
        ("", "--vary: got none, expected one to four of a1, a2, b1, b2, zp, zs, theta_z, or --around"),
        ("--around --out x", "--out: got x, expected none with --around and no --vary"),
        ("--around --time 5", "--time: got 5, expected none with --around and no --vary"),
        ("--around --resolution 0.1", "--resolution: got 0.1, expected none with --around and no --vary"),
        ("--vary a2 --proportions a2=1", "--proportions: got it without --around"),
        ("--around --proportions a2=2;b1=1", "--proportions: got 'a2=2;b1=1', expected NAME=NUMBER,NAME=NUMBER"),
        ("--around --proportions a2=2,a2=1", "--proportions: got 'a2=2,a2=1', expected NAME=NUMBER,NAME=NUMBER"),
        (f"{ASKED} 0.1 --around --proportions a2=2,b9=1", "--proportions: got ['a2', 'b9'], expected a2, b1"),
        (f"{ASKED} 0.1 --around --proportions a2=2,b1=-1", "--proportions: got -1, expected numbers above 0"),
        ("--around --proportions a2=2,b1=1", "--proportions: got ['a2', 'b1'], expected a2, b1, zp, zs"),
    ],
)
def test_what_is_refused(run, study, line, words):
    status, out, err = run(f"admissible {study} {line}")
    assert status == 2
    assert not out  # nothing was searched
    assert words in " ".join(err.split())


def test_rows_of_a_catalogue_have_no_design_that_is_marked(run, study):
    study.write_text('actuators = [{ name = "S", shortest = 1.0, longest = 2.0 }]\n' + STUDY)
    status, out, err = run(f"admissible {study} {ASKED} 0.3 --set a2=6")
    assert (status, out) == (2, "")
    assert "--set: got a2, which varies, expected variables that do not: no design is marked" in " ".join(err.split())


def test_around_alone_says_how_far_all_free_variables_may_go(run, study):
    study.write_text('unit = "mm"\n' + STUDY)
    line = f"admissible {study} --around --set a2=6 --set b1=3 --set zp=5 --set zs=3"
    status, out, _ = run(line)
    assert status == 0
    words = " ".join(out.split())
    assert words.startswith("Proved around a2 = 6 mm, b1 = 3 mm, zp = 5 mm, zs = 3 mm: a2 may be ")
    assert " mm, all at once. " in words
    answer = json.loads(run(f"{line} --json")[1])
    room = answer["around"]
    assert all(f"{name} {side}" in words for name in room for side in ("down", "up"))
    ended = [end for two in answer["ended_by"].values() for end in two]
    assert any(end == "a bound of the study" for end in ended)
    assert any(end.startswith(("radius ratio, at ", "leg ratio, at ")) for end in ended)
    at = {"a2": 6, "b1": 3, "zp": 5, "zs": 3}
    found = nd.admissible(nd.Study.load(study), tuple(at), at=at, time_limit=0.0)
    assert {name: tuple(ends) for name, ends in room.items()} == found.around()
    for name, (low, high) in room.items():  # rounded to the safe side
        printed = words.split(f"{name} may be ")[1].split(" mm")[0].split(" to ")
        assert low <= float(printed[0]) < float(printed[1]) <= high
    status, out, _ = run(f"{line} --proportions a2=2,b1=1,zp=1,zs=1 --json")
    assert status == 0
    widths = {name: high - low for name, (low, high) in json.loads(out)["around"].items()}
    assert widths == pytest.approx(dict.fromkeys(widths, widths["b1"]) | {"a2": 2.0 * widths["b1"]})


def test_after_an_interruption_of_the_set_nothing_is_asked_around(run, study, tmp_path, monkeypatch):
    found = nd.admissible(nd.Study.load(study), ("a2", "b1"), at={"zp": 5.0, "zs": 3.0}, time_limit=0.0)
    monkeypatch.setattr(nd, "admissible", lambda *_, **__: replace(found, interrupted=True))
    status, out, err = run(f"admissible {study} {ASKED} 0.05 --around --out {tmp_path / 'set'}")
    assert status == 130
    assert "around" not in out
    assert (tmp_path / "set" / "admissible-a2-b1.npz").exists()
    assert "interrupted; to go on, type: ninedof admissible " in err


def test_without_a_folder_nothing_is_kept_to_go_on_with(run, study, monkeypatch):
    found = nd.admissible(nd.Study.load(study), ("a2", "b1"), at={"zp": 5.0, "zs": 3.0}, time_limit=0.0)
    monkeypatch.setattr(nd, "admissible", lambda *_, **__: replace(found, interrupted=True))
    status, out, err = run(f"admissible {study} {ASKED} 0.05")
    assert status == 130
    assert "Without --out nothing of it is kept." in out
    assert err.startswith("ninedof: interrupted; to begin anew, type: ninedof admissible ")
    assert err.endswith(" --out designs\n")


def test_around_alone_names_the_limit_that_leaves_no_room(run, study):
    status, out, _ = run(f"admissible {study} --around --set a2=7.5 --set b1=3 --set zp=5 --set zs=3 --json")
    assert status == 0
    answer = json.loads(out)
    assert answer["around"] is None
    assert answer["reason"].startswith(
        "it is on the limit radius ratio (within 1e-06 of it): no room on that side; with"
    )
    assert "with every limit 0.1% wider a2 may be " in answer["reason"]


def test_with_more_than_four_free_variables_around_asks_which(run, study):
    study.write_text("[constraints]\nleg_ratio = { max = 3.0 }\n")
    status, _, err = run(f"admissible {study} --around")
    assert status == 2
    words = " ".join(err.split())
    assert "--vary: got none with 6 free variables: a1, a2, b1, b2, zp, zs, expected one to four" in words


def test_a_study_with_actuators_says_for_which_rows_a_design_exists(run, study):
    with study.open("a") as file:
        file.write('[[actuators]]\nname = "A"\nshortest = 2.0\nlongest = 9.0\n')
        file.write('[[actuators]]\nname = "B"\nshortest = 0.1\nlongest = 0.5\n')
    said = " ".join(run(f"admissible {study} {ASKED} 0.05 --time 0")[1].split())
    assert said.startswith("Of designs with a2 from 2 to 10, b1 from 1 to 5, at zp = 5, zs = 3")
    assert said.endswith("Undecided: a longer --time may decide it.")
    status, out, _ = run(f"admissible {study} {ASKED} 0.05 --json")
    assert status == 0
    rows = json.loads(out)["rows"]
    assert [(row["legs"], row["actuator"]) for row in rows[:3]] == [
        ("external", "A"),
        ("external", "B"),
        ("upper", "A"),
    ]
    assert {row["state"] for row in rows if row["actuator"] == "B"} == {"none"}
    status, out, _ = run(f"admissible {study} {ASKED} 0.05")
    assert "yes" in out
    assert "no " in out
    for option in ("--around", "--around --proportions a2=1", "--condition 4", "--out x", "--scheduler x"):
        status, _, err = run(f"admissible {study} {ASKED} 0.05 {option}")
        assert status == 2
        assert f"{option.split()[0]}: got" in err
        assert "expected none for a study with actuators" in err
