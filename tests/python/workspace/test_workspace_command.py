"""The command `ninedof workspace`."""

import importlib
import json
import re

import numpy as np
import pytest
from interrupts import interrupted_on_entry
from numpy.testing import assert_allclose

import ninedof as nd
from ninedof.cli.app import main

BOX = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0])
LEGS = {"leg_limits": (2.5, 6.5)}
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)


def run(arguments, capsys):
    with pytest.raises(SystemExit) as end:
        main(["workspace", *arguments])
    return end.value.code, capsys.readouterr()


def test_the_command_leaves_a_run_folder(tmp_path, capsys, published):
    box = ["--x", "-2.5", "2.5", "--y", "-2.5", "2.5", "--z", "3", "7"]
    code, out = run(
        [*"--legs 2.5 6.5 --condition 5 --tolerance 5e-3 --json".split(), *box, "--out", str(tmp_path / "run")], capsys
    )
    assert code == 0
    numbers = json.loads(out.out)["workspace"]
    expected = nd.workspace(published, BOX, criteria=LEGS | {"condition_number": 5.0}, tolerance=5e-3)
    assert_allclose(numbers["volume"], expected.volume, rtol=1e-12)
    assert {p.name for p in (tmp_path / "run").iterdir()} == {
        "record.json",
        "map.npz",
        "workspace.png",
        "workspace.svg",
    }
    record = json.loads((tmp_path / "run" / "record.json").read_text())
    assert record["results"]["workspace"]["volume"] == numbers["volume"]
    assert record["question"]["criteria"]["leg_limits"] == [2.5, 6.5]
    assert nd.WorkspaceMap.load(tmp_path / "run" / "map.npz").volume == numbers["volume"]


def test_the_command_with_orientations_and_with_an_empty_workspace(tmp_path, capsys):
    region = ["--archetype", "orientation", "--tilt-deg", "40", "--torsion-deg", "30", "--resolution", "8"]
    code, out = run([*region, "--legs", "2", "6.5", "--no-figures", "--out", str(tmp_path / "a")], capsys)
    assert code == 0
    assert "volume" in out.out
    code, out = run(["--legs", "0", "1", "--no-figures", "--out", str(tmp_path / "b")], capsys)
    assert code == 3
    assert "no allowed pose" in out.out
    code, out = run(["--out", str(tmp_path / "c")], capsys)
    assert code == 2
    assert "expected at least one" in out.err
    assert not (tmp_path / "c").exists()


def test_the_command_passes_on_position_length_and_sample(tmp_path, capsys, published):
    at = "--archetype orientation --angle-deg 40 --position 0.5 0 4 --lc 2 --resolution 8".split()
    code, out = run(
        [*at, "--legs", "2", "6.5", "--condition", "6", "--json", "--no-figures", "--out", str(tmp_path / "a")], capsys
    )
    assert code == 0
    expected = nd.workspace(
        published,
        archetype="orientation",
        position=(0.5, 0.0, 4.0),
        region={"angle": np.radians(40.0)},
        criteria={"leg_limits": (2.0, 6.5), "condition_number": 6.0},
        characteristic_length=2.0,
        resolution=8,
    )
    assert json.loads(out.out)["workspace"]["volume"] == expected.volume
    sample = ["--method", "sample", "--points", "500", "--seed", "3", "--legs", "2.5", "6.5"]
    box = ["--x", "-2.5", "2.5", "--y", "-2.5", "2.5", "--z", "3", "7"]
    code, out = run([*sample, *box, "--json", "--out", str(tmp_path / "b")], capsys)
    expected = nd.workspace(published, BOX, criteria=LEGS, method="sample", points=500, seed=3)
    assert json.loads(out.out)["workspace"]["volume"] == expected.volume


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (
            ["--position", "0", "0", "4"],
            r"--position: got \(0.0, 0.0, 4.0\), expected none but for --archetype orientation",
        ),
        (["--lc", "long"], "--lc: got 'long', expected a number or one of"),
        (["--points", "0"], "points: got 0, expected"),
        (["--seed", "-1"], "seed: got -1, expected"),
        (["--method", "grid", "--points", "5"], "--points: got 5, expected none with --method grid"),
    ],
)
def test_the_command_names_invalid_options(tmp_path, capsys, arguments, words):
    code, out = run(["--legs", "2.5", "6.5", *arguments, "--out", str(tmp_path / "run")], capsys)
    assert code == 2
    assert re.search(words, out.err)
    assert out.err.count("\n") == 1


def test_ctrl_c_before_the_first_level_leaves_a_record(tmp_path, capsys, monkeypatch):
    """All numbers are NaN, and the command ends as after any other interruption."""
    monkeypatch.setattr(
        importlib.import_module("ninedof.cli.commands.workspace"),
        "find_workspace",
        lambda *arguments, **options: nd.workspace(*arguments, **options | {"resolution": 128}),
    )
    asked = ["--condition", "6", "--internal-point", "best", "--json", "--out", str(tmp_path / "run")]
    with interrupted_on_entry("workspace"):
        code, out = run(asked, capsys)
    assert code == 130
    numbers = json.loads(out.out)["workspace"]
    assert numbers["status"] == "stopped"
    assert numbers["levels"] == []
    again = nd.WorkspaceMap.load(tmp_path / "run" / "map.npz")
    assert again.percentiles.shape == (101,)
    assert np.isnan(again.percentiles).all()
    assert "interrupted" in out.err


def test_the_command_starts_from_the_published_design_at_its_best(tmp_path, capsys):
    code, _ = run(["--legs", "0", "1", "--json", "--no-figures", "--out", str(tmp_path / "run")], capsys)
    assert code == 3
    asked = json.loads((tmp_path / "run" / "record.json").read_text())["question"]
    zs = asked["home"]["internal_point"][2]
    heights = nd.Configuration.neutral(asked["home"]["position"][2], zs + np.array([-1e-4, 0.0, 1e-4]))
    around = nd.condition_number(nd.Geometry(**asked["geometry"]), heights)
    assert around.argmin() == 1
