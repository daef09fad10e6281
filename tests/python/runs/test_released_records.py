"""Records of released versions load, with the numbers they were written with: one folder for each release."""

from pathlib import Path

import numpy as np
import pytest

import ninedof as nd
from ninedof.runs.command_file import read_command

KEPT = Path(__file__).parents[2] / "data" / "records"
FOLDERS = sorted(folder for folder in KEPT.iterdir() if folder.is_dir())


@pytest.fixture(params=FOLDERS, ids=lambda folder: folder.name)
def kept(request):
    return request.param


def test_there_is_one_of_this_release():
    assert nd.__version__.partition("+")[0] in [folder.name for folder in FOLDERS]


def test_optimizations(kept):
    paper = nd.load(kept / "comparison")
    assert (paper.status, paper.condition_number) == (nd.Status.OPTIMAL, 3.7626590785960476)
    assert paper.condition_number == pytest.approx(nd.condition_number(paper.best.geometry, paper.best.configuration))
    region = nd.load(kept / "optimization")
    assert (region.best.objective, region.region.rounds) == (3.8656851899437608, 2)
    assert region.study.objective.region.reach[0] == 0.2


def test_fronts(kept):
    front = nd.load(kept / "front")
    assert front.limits == (1.5, 2.0)
    assert front.objectives == (3.941177491336009, 3.7626590785960476)
    assert nd.load(f"{kept / 'front'}#1").best.objective == front.objectives[0]


def test_sweeps_and_atlases(kept):
    swept = nd.load(kept / "sweep")
    assert swept["condition_number"].round(8).tolist() == [6.72884558, 4.82885328, 3.90706635, 4.76694564, 6.52279041]
    assert swept.coords["x_p"].tolist() == [-1.0, -0.5, 0.0, 0.5, 1.0]
    survey = nd.load(kept / "atlas")
    assert (int(survey["histogram"].sum()), float(np.nanmin(survey["best"]))) == (1000, 4.284923059604827)


def test_workspaces(kept):
    found = nd.load(kept / "workspace")
    assert found.volume == 64.16510038204504
    assert found.certified.volume == (42.215107035577, 92.09134930016184)


def test_motions(kept):
    found = nd.load(kept / "motion")
    assert found.leg_lengths.shape == (5, 9)
    assert found.leg_lengths[0, 0] == pytest.approx(4.99298851, abs=1e-8)


def test_certificates(kept):
    made = nd.load_certificate(kept / "comparison")
    assert made.condition == (3.7626590785918124, 3.762659082354472)
    assert nd.load(kept / "comparison").is_certified_by(made)
    checked = nd.check_certificate(kept / "optimum.certificate")
    assert (checked.proved, checked.boxes) == (True, 14307)


def test_designs(kept):
    design = nd.load(kept / "design.toml")
    assert nd.condition_number(design.geometry, design.configuration) == pytest.approx(3.9070664, abs=1e-7)


def test_commands(kept):
    asked = read_command(kept / "optimization" / "command.json")
    assert asked.arguments == ("optimize", "study.toml", "--no-figures", "--out", "optimization")
    assert (asked.input.name, asked.status) == ("study.toml", 0)
    assert "box = [0.2, 0.0, 0.0]" in asked.input.text
