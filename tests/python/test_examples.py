"""Every file in examples/ runs and ends as its first lines say."""

import json
import runpy
from pathlib import Path

import pytest

from ninedof.cli import main

EXAMPLES = Path(__file__).parents[2] / "examples"
STATUS = {"01_paper.toml": 0, "02_twist_and_legs.toml": 0, "03_eqs_8_9_alone.toml": 3}


def test_no_example_is_left_out():
    assert {p.name for p in EXAMPLES.iterdir() if p.is_file()} == {*STATUS, "04_design.toml", "05_indices.py"}


@pytest.mark.parametrize("name", STATUS)
def test_study(name, tmp_path, capsys):
    with pytest.raises(SystemExit) as end:
        main(["optimize", str(EXAMPLES / name), "--no-figures", "--json", "--out", str(tmp_path / "run")])
    assert end.value.code == STATUS[name]
    assert json.loads(capsys.readouterr().out)["optimization"]["candidates"]


def test_design(capsys):
    with pytest.raises(SystemExit) as end:
        main(["evaluate", str(EXAMPLES / "04_design.toml"), "--json"])
    assert end.value.code == 0
    assert json.loads(capsys.readouterr().out)["condition_number"] == pytest.approx(3.9070663, abs=5e-7)


def test_script(capsys):
    runpy.run_path(str(EXAMPLES / "05_indices.py"), run_name="__main__")
    assert "4851 poses" in capsys.readouterr().out
