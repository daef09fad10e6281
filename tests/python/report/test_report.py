"""The page of a run: all sections, everything escaped, nothing from elsewhere, small."""

import json
import math
import re
import shlex
import tomllib
from base64 import b64decode, b64encode
from dataclasses import replace
from html import unescape
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pytest
from body_volume import body_volume
from typer import Exit

import ninedof as nd
from ninedof import _core
from ninedof.cli.answer import Answer, finish_job
from ninedof.cli.app import main
from ninedof.cli.options import JobOptions
from ninedof.optimize.actuator_choice import ActuatorChoice, Combination
from ninedof.optimize.pareto import Front
from ninedof.optimize.pareto.limits import without_degrees
from ninedof.records.record import Record
from ninedof.report import origin
from ninedof.report.optimization import FAMILIES, question
from ninedof.report.page import BLANK, title_block
from ninedof.tables.numbers import short

IMPOSSIBLE = {"height": (None, 1.0), "leg_length": (3.0, None), "footprint": (None, 1.0)}
VOID = {"meta", "link", "img", "input", "br"}


class Reader(HTMLParser):
    """Ids, sources and text of a page, and whether every element is closed."""

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.sources, self.words = [], [], [], []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.open += [] if tag in VOID else [tag]
        self.ids += [value for name, value in attrs if name == "id"]
        self.sources += [value for name, value in attrs if name in ("src", "href", "data", "action")]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] not in ("script", "style"):
            self.words.append(data)


def read(path):
    text = path.read_text(encoding="utf-8")
    assert len(text) < 3e6
    assert not re.search(r"https?://|//cdn|@import|url\(", text)
    page = Reader(text)
    assert all(source.startswith(("data:", "#")) for source in page.sources)
    assert len(page.ids) == len(set(page.ids))
    return text, page, " ".join(page.words)


def scene_of(text):
    return json.loads(re.search(r'id="scene-data">(.*?)</script>', text, re.DOTALL)[1])


@pytest.mark.slow(sanitized=True)
def test_a_run_has_every_section_and_the_numbers_of_the_result(page, folder, result):
    assert page == folder / "report.html"
    text, found, words = read(page)
    assert found.ids[0] == "question"
    expected = ["question", "answer", "machine", "drawing", "region", "sheet", "figures", "proof", "again"]
    assert [name for name in found.ids if name in expected] == expected
    assert "<b>a&b" not in text
    assert "<b>a&b" in words
    assert f"{result.objective:.6f}" in words
    assert "optimal" in words
    assert "a box of half edges 0.2, 0.2, 0.1 m, tilts of at most 5 degrees" in words
    assert re.sub(r"[_ ]", "", result.agreement[:30]) in re.sub(r"[_ ]", "", words)
    most = result.best.constraint_violation
    assert f"no limit or bound is violated at the poses imposed{f' by more than {most:.1e}' if most else ''}." in words
    assert "RUN" not in words
    found = result.sheet()
    for leg in found.legs:
        assert f"{leg.longest:.5f}" in words
    for row in found.limits:
        assert row.name.replace("_", " ") in words


def test_the_question_names_what_the_machine_is_for():
    study = nd.Study(
        constraints={"force": (None, 900.0)},
        tool={"position": [0.0, 0.0, -80.0]},
        loads={"wrenches": [[0.0, 0.0, 0.0, 0.0, 0.0, 300.0], [0.0, 0.0, 5.0, 100.0, 0.0, 0.0]]},
        masses={"platform": 10.0, "centre": [0.0, 0.0, -20.0], "rod": 0.5},
        speeds={"linear": 200.0, "angular_deg": 30.0, "acceleration": 1500.0},
        tolerances={"joints": 0.03, "legs": 0.02},
        unit="mm",
        characteristic_length=160.0,
    )
    words = " ".join(Reader(question(study)).words)
    for part in (
        "of the tool at (0, 0, -80) mm",
        "load 2: moment (0, 0, 5) N mm, force (100, 0, 0) N",
        "Masses: platform 10 kg, rod 0.5 kg, the platform's centre at (0, 0, -20) mm in the frame of the plate",
        "gravity (0, 0, -9.81)",
        "Speed of the platform: at most 200 mm/s and 30°/s. Acceleration of the platform: at most 1500 mm/s² and 0°/s²",
        "joint centres 0.03 mm, leg lengths 0.02 mm",
        "force 900 N",
        "Forces: of each leg under every load.",
    ):
        assert part in words
    plain = " ".join(Reader(question(nd.Study.paper())).words)
    assert not re.search("tool|[Ll]oad|Masses|Speed|Tolerances|Forces", plain)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({}, "Actuators are chosen from a catalogue of 2, one of them for each kind of legs: A, B."),
        (
            {"actuators_for": "all", "greatest_price": 12345.67},
            "catalogue of 2, one of them for all legs, all nine for 12345.67 at most: A, B.",
        ),
    ],
)
def test_the_question_names_the_catalogue(more, words):
    rows = [{"name": name, "shortest": 1.0, "longest": 2.0, "price": 9.0} for name in "AB"]
    assert words in question(nd.Study(actuators=rows, **more))
    assert "catalogue" not in question(nd.Study())
    many = [{"name": f"N{k}", "shortest": 1.0, "longest": 2.0} for k in range(40)]
    assert "catalogue of 40, one of them for each kind of legs: N0, N1, " in question(nd.Study(actuators=many))
    assert ", N11 and 28 more." in question(nd.Study(actuators=many))


def test_the_rows_that_were_chosen_are_a_key_figure_and_in_the_answer(tmp_path):
    rows = [nd.Actuator(name, 1.0, 9.0, price=10.0) for name in ("A", "B<i>", "C")]
    chosen = Combination(*rows, objective=3.76)
    result = nd.optimize(nd.Study.paper(), starts=2)
    with_rows = replace(result, actuators=ActuatorChoice(chosen, combinations=27, solved=4))
    page = nd.report(with_rows, tmp_path / "rows.html").read_text(encoding="utf-8")
    assert "<dt>actuators</dt><dd>external A, upper B&lt;i&gt;, lower C</dd>" in page
    assert "Actuators: external A, upper B&lt;i&gt;, lower C; price 90." in page
    assert "<dt>actuators</dt>" not in nd.report(result, tmp_path / "none.html").read_text(encoding="utf-8")


def test_the_study_file_in_the_page_makes_the_same_study(page, result):
    text, _, _ = read(page)
    data = re.search(r'href="data:text/plain;base64,([^"]+)"', text)[1]
    assert nd.Study.from_dict(tomllib.loads(b64decode(data).decode())) == result.study


def test_the_smaller_of_two_figures_is_embedded_and_the_view_has_a_still(page):
    text, _, _ = read(page)
    figure = "<svg xmlns='http://www.w3.org/2000/svg'/>"  # that of the folder: in its place, and without scripts
    assert text.count(f"data:image/svg+xml;base64,{b64encode(figure.encode()).decode()}") == 2
    assert b64encode(b"\x89PNG" + bytes(200)).decode() not in text
    assert "<noscript><figure><img" in text


@pytest.mark.parametrize(
    ("about", "project", "others"),
    [
        (SimpleNamespace(project="", author="", revision=""), BLANK, [BLANK, BLANK]),
        (SimpleNamespace(project="Polishing <head>", author="M. N.", revision="B"), "Polishing <head>", ["M. N.", "B"]),
    ],
)
def test_the_title_block_has_project_author_and_revision(about, project, others):
    study = SimpleNamespace(unit="mm", about=about)
    page = Reader(title_block(study, "<b>a&b", "2026-01-02T03:04:05"))
    words = [word for word in page.words if word.strip()]
    names = ["project", "author", "revision", "date", "run", "lengths in"]
    assert words == [
        part for pair in zip(names, [project, *others, "2026-01-02", "<b>a&b", "mm"], strict=True) for part in pair
    ]


@pytest.mark.slow(sanitized=True)
def test_the_page_has_a_drawing_and_the_map_of_the_region(page, folder):
    text = read(page)[0]
    for section, caption in (
        ("drawing", "Dimensions. E1 to E3 are joints"),
        ("region", "the worst condition number at each place"),
    ):
        part = text.partition(f'id="{section}"')[2].partition("</section>")[0]
        assert f'<figure class="of-{section}"><img' in part
        assert caption in part
    assert '<div class="block">' in text
    plain = nd.report(nd.optimize(nd.Study.paper(), starts=2), folder.parent / "plain.html").read_text()
    assert 'id="drawing"' in plain
    assert 'id="region"' not in plain


def test_the_view_shows_the_machine_and_its_worst_poses(page, result):
    text, _, _ = read(page)
    scene = scene_of(text)
    (machine,) = scene["machines"]
    poses = {pose["name"].split(",")[0]: pose for pose in machine["poses"]}
    assert {"neutral pose", "worst condition number"} <= set(poses)
    g = result.geometry
    np.testing.assert_allclose(machine["base"], np.vstack([g.base_external, g.base_internal]), atol=1e-4)
    worst = poses["worst condition number"]
    c = nd.Configuration(worst["p"], np.array(worst["q"]), worst["s"])
    assert float(worst["kappa"]) == pytest.approx(result.objective, rel=1e-5)
    assert float(nd.condition_number(g, c)) == pytest.approx(result.objective, rel=1e-3)
    np.testing.assert_allclose([float(x) for x in worst["lengths"]], nd.leg_lengths(g, c), rtol=1e-4)
    assert scene["unit"] == "m"
    assert len(machine["body"]["faces"]) > 100
    assert np.ptp(np.vstack(machine["region"]), axis=0) == pytest.approx([0.4, 0.4, 0.2], abs=1e-4)


def test_an_infeasible_run_says_why_and_shows_no_machine(tmp_path):
    found = nd.optimize(nd.Study(constraints=IMPOSSIBLE, starts=4))
    text, page, words = read(nd.report(found, tmp_path / "it.html"))
    assert "machine" not in page.ids
    assert "infeasible" in words
    assert found.reason[1:] in words
    assert scene_of(text) is None


@pytest.mark.slow(sanitized=True)
def test_an_interrupted_run_makes_no_claim(tmp_path, result):
    stopped = replace(result, status=nd.Status.STOPPED, interrupted=True, reason="interrupted")
    _, page, words = read(nd.report(stopped, tmp_path / "it.html"))
    assert "machine" in page.ids
    assert "not claimed to be an optimum" in words
    assert "Checked:" not in words
    _, page, words = read(nd.report(replace(stopped, candidates=(), region=None), tmp_path / "none.html"))
    assert "machine" not in page.ids
    assert "stopped" in words


@pytest.mark.slow(sanitized=True)
def test_a_front_has_a_machine_for_each_point(tmp_path):
    study = nd.Study(constraints=IMPOSSIBLE, starts=4)
    front = nd.pareto(study, "footprint", values=[1.0, 40.0, 60.0])
    nd.save(front, tmp_path / "front")
    text, _, words = read(nd.report(tmp_path / "front"))
    scene = scene_of(text)
    assert [m["name"] for m in scene["machines"]] == ["point 2: footprint 40", "point 3: footprint 60"]
    assert scene["machines"][scene["start"]]["name"] == "point 2: footprint 40"  # the other limit has no effect
    assert "Of point 2, the least objective; the front has no knee." in words
    assert "Point 2. " in words
    assert f"ninedof workspace {tmp_path / 'front'}#2 " in words
    for leg in front.results[1].sheet().legs:
        assert f"{leg.longest:.5f}" in words
    assert f"{front.objectives[2]:.6f}" in words
    assert front.results[0].reason.split(";")[0] in words
    point = nd.report(f"{tmp_path / 'front'}#2")
    assert point.name == "report-2.html"
    words = read(point)[2]
    assert "front#2" in words
    assert f"ninedof workspace {tmp_path / 'front'}#2 " in words
    assert "ninedof pareto study.toml --against footprint --value 1.0 --value 40.0 --value 60.0" in words
    assert "optimize study.toml" not in words
    assert "same bits" not in words


@pytest.mark.parametrize(
    ("against", "limits"),
    [("leg_ratio at neutral", (1.4754638729041, 2.0)), ("base_cone", (0.5235987755982988, 0.7))],
)
def test_the_command_of_a_front_asks_for_the_same_limits_to_the_last_bit(monkeypatch, tmp_path, against, limits):
    front = Front(nd.Study(starts=4), against, limits, ())
    text = unescape(re.sub(r"<[^>]*>", " ", origin.of_front(front, Record("front", front.study, {}))))
    command = shlex.split(next(line for line in text.splitlines() if "ninedof pareto" in line))
    front.study.save(tmp_path / "study.toml")
    asked = {}

    def trace(study, against, values, points, **_):
        asked.update(study=study, against=against, values=values)
        raise ValueError("enough")

    monkeypatch.setattr(nd, "pareto", trace)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit):
        main(command[1:])
    plain, degrees = without_degrees(asked["against"])
    assert (asked["study"], plain) == (front.study, against)
    assert tuple(math.radians(x) if degrees else x for x in asked["values"]) == limits


@pytest.fixture(scope="module")
def reach():
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    home = nd.Configuration.neutral(3.9828, 2.4432)
    box = ([-2.0, -2.0, 3.0], [2.0, 2.0, 7.0])
    return nd.workspace(g, box, criteria={"leg_limits": (2.5, 6.5)}, home=home, tolerance=0.1)


@pytest.mark.slow(sanitized=True)
def test_a_job_ends_with_its_report(run, tmp_path):
    place = tmp_path / "reach"
    options = "--legs 2.5 6.5 --tolerance 0.05 --no-figures --out"
    assert run(f"workspace {options} {place}")[0] == 0
    assert not (place / "report.html").exists()
    status, out, _ = run(f"report {place}")
    assert status == 0
    assert "report.html" in out.replace("\n", "")  # a long path is folded
    text, _, words = read(place / "report.html")
    record = nd.load(place)
    assert f"{record.volume:.6g}" in words
    assert "every leg keeps to its limits" in words
    scene = scene_of(text)
    body = scene["machines"][0]["body"]
    points = np.array(body["vertices"])
    assert (points.min(axis=0) >= record.low - 1e-9).all()
    assert (points.max(axis=0) <= record.high + 1e-9).all()
    assert body_volume(body) == pytest.approx(record.volume, rel=0.1)


def test_a_workspace_that_was_saved_has_no_question_and_no_machine(tmp_path, reach):
    nd.save(reach, tmp_path / "kept")
    text, page, words = read(nd.report(tmp_path / "kept"))
    assert not {"question", "machine"} & set(page.ids)
    assert {"answer", "proof", "again"} <= set(page.ids)
    assert scene_of(text) is None
    assert f"{reach.volume:.6g}" in words
    assert "The record does not hold what was asked." in words
    assert "Proved: " not in words


@pytest.mark.slow(sanitized=True)
def test_an_orientation_workspace_is_shown_in_degrees(run, tmp_path):
    place = tmp_path / "turns"
    options = "--archetype orientation --angle-deg 60 --legs 1.5 6.5 --tolerance 0.1 --no-figures --out"
    run(f"workspace {options} {place}")
    _, _, words = read(nd.report(place))
    found = nd.load(place)
    words = " ".join(words.split())
    assert "from (-60, -60, -60) to (60, 60, 60) deg." in words
    assert f"largest ball: radius (deg) {found.ball_radius * 180.0 / math.pi:.4g}" in words
    sides = (found.box_high - found.box_low) * 180.0 / math.pi
    assert f"largest box: sides (deg) {sides[0]:.4g} {sides[1]:.4g}" in words
    assert f"volume (rad³, of 8 π² in all) {found.volume:.6g}" in words
    assert "(rad)" not in words


def test_optimize_writes_its_report_and_lists_it(run, tmp_path):
    study = tmp_path / "study.toml"
    study.write_text("[constraints]\nradius_ratio = { max = 2.0 }\nheight = { max = 0.001 }\n[solver]\nstarts = 4\n")
    for name, more in (("with", ""), ("without", "--no-report")):
        run(f"optimize {study} --out {tmp_path / name} {more}")
        listed = json.loads((tmp_path / name / "record.json").read_text())["files"]
        assert ("report.html" in listed) == (name == "with") == (tmp_path / name / "report.html").is_file()


@pytest.mark.parametrize("command", ["", "ninedof optimize 'my study.toml' --out <b>", "ninedof pareto --out x"])
def test_the_page_shows_the_command_that_made_the_run(command):
    """As it was typed, beside the one that solves the study of the page."""
    study = nd.Study.paper()
    shown = origin.of_study(study, "ninedof optimize study.toml", Record("optimization", study, {}, command=command))
    words = unescape(re.sub(r"<[^>]*>", " ", shown))
    assert "ninedof optimize study.toml" in words
    assert ("The command that made it:" in words) == bool(command)
    assert command in words


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (OSError(28, "No space left [on device]"), "[Errno 28] No space left [on device]"),
        (ValueError("two\nlines"), "two lines"),
        (KeyError("geometry"), "KeyError('geometry')"),
        (ZeroDivisionError("division"), "ZeroDivisionError('division')"),
    ],
)
def test_a_report_that_fails_does_not_fail_the_job(run, tmp_path, monkeypatch, error, said):
    def fails(folder):
        raise error

    def drawn(figure, folder, stem):
        (folder / "front.svg").write_text("<svg xmlns='http://www.w3.org/2000/svg'/>")
        return [folder / "front.svg"]

    monkeypatch.setattr("ninedof.cli.answer.report", fails)
    monkeypatch.setattr("ninedof.plot.save", drawn)
    place = tmp_path / "run"
    status, out, _ = run(f"pareto --against radius_ratio --value 2 --starts 2 --out {place}")
    assert status == 0
    assert f"the report could not be written: {said}\n" in out
    assert json.loads((place / "record.json").read_text())["files"] == ["front.svg"]
    assert not (place / "report.html").exists()
    assert len(nd.load(place)) == 1


@pytest.mark.parametrize("fails", [False, True])
def test_the_page_of_an_interrupted_run_does_not_outlive_it(tmp_path, monkeypatch, fails):
    """Neither where the continued run writes none, nor where its own page fails."""

    def broken(folder):
        raise ValueError("no page")

    monkeypatch.setattr("ninedof.cli.answer.report", broken)
    (tmp_path / "report.html").write_text("interrupted")
    options = JobOptions(report=fails)
    with pytest.raises(Exit):
        finish_job(options, tmp_path, Answer([], {}), lambda: tmp_path / "record.json", None)
    assert not (tmp_path / "report.html").exists()


@pytest.mark.parametrize(
    ("value", "among", "text"),
    [
        (0.0123456, (), "0.0123456"),
        (0.581243, (), "0.581243"),
        (0.0123456, (0.581243, -0.2), "0.012346"),
        (-0.2, (0.581243,), "-0.200000"),
        (581.24, (), "581.2400"),
        (12.3456, (581.24,), "12.3456"),
        (0.0, (581.24,), "0"),
        (-1e-14, (581.24,), "0"),
        (2e-6, (581.24,), "2.00000e-06"),
        (1.234567e-4, (), "1.23457e-04"),
        (1.234567e8, (), "1.23457e+08"),
        (np.inf, (1.0,), "inf"),
        (1.0, (np.inf, np.nan), "1.00000"),
    ],
)
def test_numbers_keep_six_digits_in_any_unit(value, among, text):
    assert short(value, among) == text


def test_every_family_of_designs_has_its_words():
    assert set(FAMILIES) == set(_core.design_family_names())
