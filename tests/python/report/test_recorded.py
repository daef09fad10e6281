"""The pages of a motion, a sweep and an atlas say what their records hold."""

import json
import re

import pytest

import ninedof as nd
from ninedof import plot

DESIGN = """
unit = "mm"
[geometry]
a1 = 0.0
a2 = 581.24
b1 = 290.62
b2 = 0.0
[configuration]
zp = 398.28
zs = 244.35
"""


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "design.toml").write_text(DESIGN)
    return tmp_path


@pytest.fixture
def made(run, here):
    """What a command line leaves in the folder `run`: its status, the results of its record, its page."""

    def by(line):
        status = run(f"{line} --out run")[0]
        text = (here / "run" / "report.html").read_text()
        return status, json.loads((here / "run" / "record.json").read_text())["results"], text

    return by


def shown(text):
    return " ".join(re.sub(r"<[^>]*>", " ", text).split())


def test_a_path(made):
    status, results, page = made("path design.toml --circle 30 --points 41 --legs 200 470 --lc 100")
    motion, words = results["motion"], shown(page)
    assert status == (3 if motion["breaks"] else 0)
    assert f"condition number, worst {motion['condition_number']['worst']:.4f} at t =" in words
    assert f"limits broken {len(motion['breaks'])}" in words
    assert "most (mm) low (mm) high (mm) margin speed (mm/s) accel. (mm/s²)" in words
    assert "[0.0, 0.0, 398.28]" in words  # lists of numbers in one line
    assert f"{motion['legs']['l1']['longest']:.6g}" in words
    assert "along 41 poses from t = 0 to 1" in words


def test_a_sweep(made):
    _, results, page = made("sweep design.toml --over x_p=-50:50:11 --lc 100")
    least = results["sweep"]["indices"]["condition_number"]["least"]
    assert f"condition number least {least['value']:.6g} x_p = {least['at']['x_p']:.5g}" in shown(page)
    assert "How does condition number vary over x_p?" in shown(page)


@pytest.mark.parametrize("asked", ["figure-6 --points 5", "--over x_p=-1:1:3 --index leg_lengths"])
def test_axes_with_names(made, asked):
    """Of coordinates or legs."""
    _, results, page = made(f"sweep {asked}")
    (found,) = results["sweep"]["indices"].values()
    name = next(value for value in found["least"]["at"].values() if isinstance(value, str))
    assert re.search(rf"(coordinate|leg) {name}", shown(page))


@pytest.mark.slow(sanitized=True)
def test_an_atlas(made):
    _, results, page = made("atlas --designs 2000")
    assert "Which condition numbers have 2000 designs drawn at random?" in shown(page)
    best = [row["condition_number"] for row in results["atlas"]["best"] if row["radius_ratio"] < 4.0]
    assert f"4 {min(best):.4f}" in shown(page)


@pytest.mark.slow(sanitized=True)
def test_paths_workspaces_and_sweeps_of_a_run_have_its_title_block_and_its_tool(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    variables = {"a1": 0.0, "a2": 581.24, "b1": 290.62, "b2": 0.0, "zp": 398.28, "zs": 244.35}
    about = {"project": "Polishing head", "author": "A. Smith", "revision": "C"}
    study = nd.Study(
        variables=variables, unit="mm", characteristic_length=100.0, about=about, tool={"position": [0, 0, -50]}
    )
    nd.save(nd.optimize(study), "machine")
    drawn = []
    monkeypatch.setattr(plot, "drawing", lambda *a: drawn.append(a[3]) or plot.mechanisms([plot.Robot("", *a[:2])]))
    box = "--x -5 5 --y -5 5 --z 395 400"
    asked = {"path": "--line 5 0 5 --points 21", "workspace": f"--legs 100 900 {box}", "sweep": "--over x_p=-5:5:5"}
    for name, options in asked.items():
        run(f"{name} machine {options} --out {name}")
        page = shown((tmp_path / name / "report.html").read_text())
        assert "project Polishing head author A. Smith revision C" in page
        assert "lengths in mm" in page or name == "sweep"
        assert ("The box cuts the workspace: " in page) == (name == "workspace")
    assert drawn == [study.tool]
