"""The command line: text, JSON, exit status, files, interruption."""

import html
import json
import signal
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


def test_limits_of_a_front_that_were_chosen_are_told_from_those_given(run):
    given, chosen = (
        run(f"pareto {limits} --starts 4 --no-figures --out {name}")[1]
        for limits, name in (("--value 1.9 --value 2.1", "given"), ("--points 2", "chosen"))
    )
    assert "may have designs too" not in given
    assert "may have designs too" in chosen


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
    evaluated = json.loads(run("evaluate run --json")[1])
    assert evaluated["condition_number"] == pytest.approx(best["neutral_condition_number"], rel=1e-9)


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


COMMANDS = [command.callback.__name__ for command in app().registered_commands]


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_help_has_an_example_of_every_command(run, command):
    status, out, _ = run(f"{command} --help")
    assert (status, "Usage" in out) == (0, True)
    assert ("Example" in out) == bool(command)


def test_every_command_has_a_row_in_the_tour():
    assert COMMANDS[0] == "optimize"
    tour = (Path(__file__).resolve().parents[3] / "docs" / "tour.md").read_text()
    rows = [row for row in tour.splitlines() if row.startswith("| `ninedof")]
    assert [name for name in COMMANDS if not any(f"ninedof {name}" in row for row in rows)] == []


def test_version(run):
    status, out, _ = run("--version")
    assert status == 0
    assert out.strip().count(".") == 2


def test_an_interrupted_run_records_the_best_design(run, monkeypatch):
    """Ctrl-C on a run of a million starts: status 130, the best so far printed and recorded."""
    many = 10**6

    def pressed(bar, done, total, best):
        if total == many and done > 10:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr("ninedof.cli.screen.Bar.__call__", pressed)
    status, out, err = run(f"--starts {many} --no-figures --out run")
    assert (status, "Traceback" in err) == (130, False)
    assert "3.762659" in out
    assert "interrupted after" in out
    assert nd.load("run").interrupted
