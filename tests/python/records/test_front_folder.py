"""Fronts in run folders, written and read back, and the command that makes them."""

from dataclasses import replace

import pytest

import ninedof as nd
from ninedof.optimize.pareto import solving
from ninedof.records.load import design_and_result
from ninedof.records.record import load_run as load


@pytest.fixture
def command(run, tmp_path):
    return lambda line: run(f"pareto --out {tmp_path / 'run'} {line}")


@pytest.mark.slow(sanitized=True)
def test_the_command_prints_and_records(command, tmp_path):
    status, out, _ = command("--value 1.5 --value 2")
    assert status == 0
    for words in ("3.762659", "3.941177", "condition number against radius ratio", "front.png"[:5], "run folder"):
        assert words in out
    names = {path.name for path in (tmp_path / "run").iterdir()}
    assert names == {"record.json", "question.json", "report.html", "front.png", "front.svg", "front.pdf", "pieces"}
    assert load(tmp_path / "run").limits == (1.5, 2.0)


def test_the_command_reports_an_infeasible_study(command):
    status, out, _ = command("--against leg_ratio --value 0.5 --starts 16")
    assert status == 3
    assert "infeasible" in out


def test_a_front_interrupted_before_its_first_point_has_none_to_choose():
    front = nd.Front(nd.Study(), "leg_ratio", (), (), interrupted=True)
    with pytest.raises(ValueError, match=r"^run: got a front without a point, expected one of its points$"):
        design_and_result(front, "run")


@pytest.mark.slow(sanitized=True)
def test_the_command_continues_after_an_interruption(command, tmp_path, monkeypatch):
    """The first time the second limit is cut short: what is solved is printed and kept, and drawn at the end."""
    calls = []

    def cut(study, **options):
        calls.append(study)
        return replace(nd.optimize(study, **options), interrupted=len(calls) == 2)

    monkeypatch.setattr(solving, "optimize", cut)
    line = "--value 1.5 --value 2"
    status, out, _ = command(line)
    assert status == 130
    words = " ".join(out.split())
    assert "interrupted: 1 limit is solved so far and kept in" in words
    assert "solved so far and kept in" in words
    assert not (tmp_path / "run" / "front.png").exists()
    assert load(tmp_path / "run").limits == (2.0,)
    assert command(line)[0] == 0
    assert len(calls) == 5  # four, and the one that was cut short
    assert (tmp_path / "run" / "front.png").is_file()
    assert load(tmp_path / "run").limits == (1.5, 2.0)
    assert not load(tmp_path / "run").interrupted
