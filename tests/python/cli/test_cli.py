"""The command line: text, JSON, exit status, files, interruption."""

import html
import json
import signal
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

import ninedof as nd
from ninedof.cli.app import app


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")


@pytest.mark.slow(sanitized=True)
def test_main_job(run, tmp_path):
    status, out, _ = run("--out run")
    assert status == 0
    for figure in (
        "3.9110",
        "3.911000",
        "3.786570",
        "3.762659",
        "6.1902",
        "2.3745",
        "2.5110",
        "6.0079",
        "3.18 %",
        "3.79 %",
    ):
        assert figure in out
    names = {path.name for path in (tmp_path / "run").iterdir()}
    stems = ("mechanism", "drawing", "condition")
    drawn = {f"{stem}.{kind}" for stem in stems for kind in ("png", "svg", "pdf")}
    kept = {"question.json", "pieces"}
    assert names == {"record.json", "report.html"} | kept | drawn
    record = json.loads((tmp_path / "run" / "record.json").read_text())
    assert record["study"]["solver"] == {"starts": 64, "seed": 0}
    assert {"ninedof", "python", "numpy"} <= set(record["versions"])
    assert record["results"]["optimization"]["status"] == "optimal"
    assert set(record["files"]) == names - kept - {"record.json"}


def test_standard_output_is_json_only(run):
    status, out, err = run("--json --no-figures --threads 1")
    assert status == 0
    data = json.loads(out)
    assert data["optimization"]["candidates"][0]["neutral_condition_number"] == pytest.approx(3.762659078596, rel=1e-9)
    assert [row["title"] for row in data["designs"]]
    assert Path(data["record"]).is_file()
    assert "3.762659" in err


def test_starts_and_seed_reach_the_record(run):
    command = "optimize --starts 5 --seed 7 --no-figures --out run"
    run(command)
    record = json.loads(Path("run/record.json").read_text())
    assert record["study"]["solver"] == {"starts": 5, "seed": 7}
    assert record["command"] == f"ninedof {command}"


STUDIES = {
    "optimal": ("[constraints]\nradius_ratio = { max = 2.0 }", 0),
    "unbounded": ("[variables]\na2 = [0.0, inf]\nzp = [0.1, inf]\nzs = [0.1, inf]", 3),
    "infeasible": ("[constraints]\nleg_ratio = { max = 0.5 }\n[solver]\nstarts = 16", 3),
}


def test_a_limit_at_the_neutral_pose_is_named_on_the_screen(run):
    Path("study.toml").write_text(
        """
        [constraints]
        leg_ratio = [{ max = 3.0 }, { max = 2.0, at = "neutral" }]
        [[objective.poses]]
        position = [0.2, 0, 0]
        """
    )
    status, out, _ = run("optimize study.toml --starts 4 --no-figures --out run")
    assert status == 0
    assert "1 % more leg_ratio at neutral gains" in out
    line = "pareto study.toml --against 'leg_ratio at neutral' --value 1.9 --value 2.1"
    status, out, err = run(f"{line} --starts 4 --json --no-figures --out front")
    assert status == 0
    assert "may have designs too" not in err  # limits that were given
    _, _, err = run("pareto --points 2 --starts 4 --json --no-figures --out chosen")
    assert "may have designs too" in err
    assert json.loads(out)["front"]["against"] == "leg_ratio at neutral"
    status, _, err = run("pareto study.toml --against 'stroke at neutral' --value 1.0")
    assert status == 2
    assert 'stroke.at: got "neutral"' in err


@pytest.mark.parametrize("status", STUDIES)
def test_study_file(run, status):
    text, code = STUDIES[status]
    Path("study.toml").write_text(text)
    got, out, _ = run("optimize study.toml --no-figures --out run")
    assert got == code
    assert status in out
    record = json.loads(Path("run/record.json").read_text())
    assert record["results"]["optimization"]["status"] == status


def test_study_over_poses_shows_prices_and_poses(run):
    Path("study.toml").write_text(
        "[constraints]\nradius_ratio = { max = 2.0 }\n[objective]\nunit = 'zp'\n"
        "[objective.box]\nhalf = [0.1, 0.0, 0.0]\n[solver]\nstarts = 8\n"
    )
    status, out, _ = run("study.toml --no-figures --out run")
    assert status == 0
    text = " ".join(out.split())
    for part in (
        "neutral condition",
        "worst over the poses",
        "best over the poses",
        "more radius_ratio gains",
        "were followed to the end",
    ):
        assert part in text
    best = json.loads(Path("run/record.json").read_text())["results"]["optimization"]["candidates"][0]
    assert len(best["conditions"]) == 3
    assert best["objective"] == pytest.approx(max(best["conditions"]), rel=1e-9)
    assert "radius_ratio" in best["prices"]
    evaluated = json.loads(run("evaluate run --json")[1])
    assert evaluated["condition_number"] == pytest.approx(best["neutral_condition_number"], rel=1e-9)


def test_evaluate_published_design(run):
    status, out, _ = run("evaluate --a1 0 --a2 5.8124 --b1 2.9062 --b2 0 --zp 3.9828 --zs 2.3745 --json")
    data = json.loads(out)
    assert status == 0
    assert data["condition_number"] == pytest.approx(3.9110, abs=5e-5)
    assert data["reciprocal_condition_number"] == pytest.approx(1.0 / data["condition_number"])
    assert len(data["singular_values"]) == 6
    kinds = data["characteristic_lengths"]
    assert min(kinds.values(), key=lambda k: k["condition_number"]) == kinds["optimal"]


def test_evaluate_names_the_condition_number_of_each_length(run, monkeypatch):
    """The line was "107.3: k = 3.896", while every other one says condition number."""
    monkeypatch.setenv("COLUMNS", "80")
    out = run("evaluate --a1 0 --a2 581.24 --b1 290.62 --b2 0 --zp 398.28 --zs 244.35")[1]
    assert "107.299091: condition number 3.896032 │" in out
    assert " k = " not in out


def test_evaluate_a_singular_design(run):
    status, out, _ = run("evaluate --a1 1 --a2 2 --b1 0.5 --b2 1 --zp 3 --zs 1 --json")
    data = json.loads(out)
    assert status == 0
    assert data["condition_number"] == "inf"
    assert data["reciprocal_condition_number"] == 0.0
    assert data["singular"] is True


def test_evaluate_reads_degrees(run):
    published = "evaluate --a1 0 --a2 5.8124 --b1 2.9062 --b2 0 --zp 3.9828 --zs 2.4432 --json"
    turned = json.loads(run(published + " --theta-z-deg 2.8647889756541161")[1])
    assert turned["condition_number"] == pytest.approx(3.8819, abs=5e-5)


def test_paper_prints_a_verdict_on_every_number(run):
    status, out, _ = run("paper --json")
    rows = json.loads(out)
    assert status == 0
    assert {"eq. (7)", "eq. (39a)", "eq. (39b)", "eq. (39c)", "eq. (40)", "eq. (41)", "sec. 5"} <= {
        r["where"] for r in rows
    }
    assert all(r["verdict"] for r in rows)


def test_the_figures_of_the_paper_are_drawn_where_asked(run, tmp_path, monkeypatch):
    """Without Figs. 6 and 7, whose sweeps have tests of their own."""
    few = {name: partial(nd.sweep_figure, name, points) for name, points in (("6", 5), ("7", 2))}
    monkeypatch.setattr("ninedof.paper.figures.sweep_figure", lambda name: few[name]())

    def save(figure, folder, stem):
        (folder / f"{stem}.png").touch()
        return [folder / f"{stem}.png"]

    monkeypatch.setattr("ninedof.plot.save", save)
    status, out, err = run("paper --figures --json --out figures")
    assert status == 0
    assert "drawn: figure_5" in err
    figures = {f"figure_{k}.png" for k in range(1, 8)}
    assert {path.name for path in (tmp_path / "figures").iterdir()} == {
        "record.json",
        "report.html",
        "question.json",
        "pieces",
    } | figures
    page = (tmp_path / "figures" / "report.html").read_text()
    assert page.count("data:image/png") == 7
    for row in json.loads(out):
        cells = (row[key].replace("radius_ratio", "radius ratio") for key in ("where", "printed", "ours", "verdict"))
        assert all(html.escape(cell) in page for cell in cells)
    assert "Fig. 5, the plates." in page
    assert "ninedof paper --figures --json --out figures" in page
    assert "got the record of a run of kind paper" in run("sheet figures")[2]
    assert run("paper --out other")[0] == 2


@pytest.mark.parametrize("line", ["--help", "optimize --help", "evaluate -h", "paper --help"])
def test_help(run, line):
    status, out, _ = run(line)
    assert status == 0
    assert "Usage" in out
    if " " in line:
        assert "Example" in out


def test_every_command_has_a_row_in_the_tour():
    commands = [command.callback.__name__ for command in app().registered_commands]
    assert len(commands) > 6
    assert commands[0] == "optimize"
    tour = (Path(__file__).resolve().parents[3] / "docs" / "tour.md").read_text()
    rows = [row for row in tour.splitlines() if row.startswith("| `ninedof")]
    assert [name for name in commands if not any(f"ninedof {name}" in row for row in rows)] == []


def test_version(run):
    status, out, _ = run("--version")
    assert status == 0
    assert out.strip().count(".") == 2


def test_interrupted_run_records_the_best_design(tmp_path):
    """Ctrl-C on a run of a million starts: status 130, the best so far printed and recorded."""
    arguments = ["--starts", "1000000", "--no-figures", "--out", "run"]
    script = f"""
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # inherited as ignored by a job in the background
sys.path[:] = {sys.path}
import ninedof.cli.app, ninedof.cli.screen
report = ninedof.cli.screen.Bar.show
def starts(bar, done, total, best):
    report(bar, done, total, best)
    if done < total:
        sys.stderr.write("working\\n")
ninedof.cli.screen.Bar.show = ninedof.cli.screen.Bar.__call__ = starts
ninedof.cli.app.main({arguments})
"""
    command = [sys.executable, "-c", script]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as child:
        while "working" not in child.stderr.readline():  # past the small studies, in the large one
            assert child.poll() is None
        child.send_signal(signal.SIGINT)
        out, err = child.communicate(timeout=120)
    assert child.returncode == 130, err
    assert "Traceback" not in err
    assert "3.762659" in out
    assert "interrupted after" in out
    record = json.loads((tmp_path / "run" / "record.json").read_text())
    assert record["results"]["optimization"]["interrupted"] is True
