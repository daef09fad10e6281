"""CSV: the file comes back as the same design, to the last bit, and files written by hand are read with care."""

import csv
import json

import numpy as np
import pytest
from written_designs import HEXAGON, PAPER, general, limited, text_of

import ninedof as nd
from ninedof.export import csv as written

DESIGNS = {"paper": PAPER, "hexagon": HEXAGON, "general": general(), "tiny": general(1, "ft", 1e-7)}
BY_HAND = """\
# joints measured on the drawing
joint,x (mm),y (mm),z (mm)
base_external_1,0,-4,0
base_external_2,-3.5,2,0
base_external_3,3.5,2,0
base_internal_1,0,-4,0
base_internal_2,-3.5,2,0
base_internal_3,3.5,2,0
platform_external_1,1.5,-1,0
platform_external_2,-1.5,-1,0
platform_external_3,0,2,0
platform_internal_1,-1.5,-1,0
platform_internal_2,0,2,0
platform_internal_3,1.5,-1,0
pose,x (mm),y (mm),z (mm)
p,0,0,4
O,0,0,2.5
"""


def load(tmp_path, text):
    file = tmp_path / "joints.csv"
    file.write_text(text, encoding="utf-8")
    return nd.load(file)


@pytest.mark.parametrize("name", DESIGNS)
def test_a_design_comes_back_to_the_last_bit(name, tmp_path):
    text = text_of(written, DESIGNS[name])
    outcome = load(tmp_path, text)
    assert isinstance(outcome, nd.Design)
    assert outcome == DESIGNS[name]
    assert text_of(written, outcome) == text


def test_what_is_written_beside_the_joints(tmp_path):
    result = limited()
    g, c = result.geometry, result.configuration
    text = text_of(written, result)
    joints, pose, rotation, legs, _ = ([*csv.reader(part.splitlines())] for part in text.split("\n\n"))
    assert joints[0] == ["joint", "x (mm)", "y (mm)", "z (mm)", "base x (mm)", "base y (mm)", "base z (mm)"]
    assert legs[0] == ["leg", "from", "to", "neutral (mm)", "shortest (mm)", "longest (mm)"]
    at = {name: np.array(rest[-3:], dtype=float) for name, *rest in joints[1:] + pose[1:]}
    for i in range(3):
        np.testing.assert_allclose(at[f"platform_internal_{i + 1}"], c.position + c.rotation @ g.platform_internal[i])
    np.testing.assert_array_equal(np.array([row[1:] for row in rotation[1:]], dtype=float), c.rotation)
    assert [row[0] for row in legs[1:]] == "l1 l2 l3 q1 q2 q3 r1 r2 r3".split()
    for (_, start, end, neutral, shortest, longest), length in zip(legs[1:], nd.leg_lengths(g, c), strict=True):
        assert float(neutral) == length
        assert np.linalg.norm(at[end] - at[start]) == pytest.approx(length, rel=1e-12)
        assert (shortest, longest) == ("1.0", "9.0")
    assert load(tmp_path, text).geometry == g


def test_pandas_reads_the_joints_as_a_table(tmp_path):
    pandas = pytest.importorskip("pandas")
    (tmp_path / "joints.csv").write_text(text_of(written, HEXAGON))
    table = pandas.read_csv(tmp_path / "joints.csv", nrows=12, index_col="joint")
    own = np.vstack([getattr(HEXAGON.geometry, name) for name in ("platform_external", "platform_internal")])
    np.testing.assert_allclose(table[["x (mm)", "y (mm)", "z (mm)"]].to_numpy()[6:], own, rtol=1e-15)


def test_a_file_written_by_hand(tmp_path):
    outcome = load(tmp_path, BY_HAND)
    assert outcome.unit == "mm"
    assert outcome.characteristic_length == 1.0
    assert outcome.configuration == nd.Configuration.neutral(4.0, 2.5)
    np.testing.assert_array_equal(outcome.geometry.base_external, [[0, -4, 0], [-3.5, 2, 0], [3.5, 2, 0]])
    from_a_spreadsheet = "\ufeff" + BY_HAND.replace("\n", ",,,\r\n")
    assert load(tmp_path, from_a_spreadsheet) == outcome
    assert load(tmp_path, BY_HAND.replace(" (mm)", "")).unit == ""


BAD = {
    "empty": ("", "joint"),
    "a table of another program": ("a,b\n1,2\n", "line 1: got 'a'"),
    "no pose": (BY_HAND[: BY_HAND.index("pose")], "no section pose"),
    "no O": (BY_HAND.replace("O,0,0,2.5\n", ""), "line 15: got no O below"),
    "a joint missing": (BY_HAND.replace("base_external_2,-3.5,2,0\n", ""), "line 2: got no base_external_2"),
    "a joint twice": (BY_HAND.replace("base_external_2", "base_external_1"), "line 4: got base_external_1 twice"),
    "a joint misspelt": (BY_HAND.replace("base_external_2", "base_externl_2"), "did you mean 'base_external_2'"),
    "words": (BY_HAND.replace("-3.5,2,0", "left,2,0", 1), "line 4, column x: got 'left'"),
    "a number missing": (BY_HAND.replace("-3.5,2,0", "-3.5,2", 1), "line 4, column z: got ''"),
    "not finite": (BY_HAND.replace("p,0,0,4", "p,0,0,inf"), "line 16, column z: got 'inf'"),
    "two units": (BY_HAND.replace("pose,x (mm)", "pose,x (m)"), "line 15, column x: got m, expected mm"),
    "an unknown unit": (BY_HAND.replace("(mm)", "(furlong)"), "line 2, column x: unit: got 'furlong'"),
    "a column missing": (BY_HAND.replace("pose,x (mm),y (mm),z (mm)", "pose,x (mm),y (mm)"), "columns x, y and z"),
    "no rotation": (BY_HAND + "rotation,x,y,z\nrow 1,1,0,0\nrow 2,0,2,0\nrow 3,0,0,1\n", "rotation: "),
    "a length of zero": (BY_HAND + "setting,value\ncharacteristic_length,0\n", "expected a positive number"),
    "an unknown kind": (BY_HAND + "setting,value\ncharacteristic_length,best\n", "got 'best'"),
    "an unknown setting": (BY_HAND + "setting,value\nlc,1\n", "got 'lc'"),
    "joints on a line": (
        BY_HAND.replace("-3.5,2,0", "0,2,0").replace("3.5,2,0", "0,3,0"),
        "base_internal: got collinear joints",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_files_are_one_line_that_names_the_place(name, tmp_path):
    text, words = BAD[name]
    with pytest.raises(ValueError) as caught:  # noqa: PT011  # the message is compared below
        load(tmp_path, text)
    message = str(caught.value)
    assert message.startswith(str(tmp_path / "joints.csv"))
    assert words in message
    assert "\n" not in message


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(ValueError, match=r"missing\.csv: cannot be read"):
        nd.load(tmp_path / "missing.csv")
    (tmp_path / "picture.csv").write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(ValueError, match=r"picture\.csv: cannot be read"):
        nd.load(tmp_path / "picture.csv")


def test_commands_take_such_a_file_as_design(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "joints.csv").write_text(BY_HAND)
    for command in ("evaluate", "sheet"):
        status, out, _ = run(f"{command} joints.csv --json")
        assert status == 0
        assert json.loads(out)["unit"] == "mm"
