"""The pages in headless Chromium: nothing on the console, nothing wider than the screen or the paper, scripts run."""

import re
from dataclasses import replace

import chromium
import pytest

import ninedof as nd
from ninedof.records.figures import figures_of
from ninedof.records.proofs import certificate_file, save_certificate
from ninedof.records.record import write_run

pytestmark = pytest.mark.skipif(chromium.PROGRAM is None, reason="needs the program chromium")
WIDTHS = (320, 1280)
PAPER = 688  # pixels between the margins of A4
STILL = "<svg xmlns='http://www.w3.org/2000/svg'/>"

DRAWN = """(() => {
  const canvas = document.querySelector("canvas"), context = canvas.getContext("2d");
  return new Set(new Uint32Array(context.getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size;
})()"""
OTHER_POSE = """(() => {
  const select = document.querySelector("#poses select");
  select.value = 1;
  select.dispatchEvent(new Event("change"));
})()"""
WIDE = """[...document.querySelectorAll("table, pre, img, #view, dl")].filter((e) => {
  const box = e.getBoundingClientRect();
  return e.scrollWidth > e.clientWidth + 1 || box.left < -1 || box.right > document.documentElement.clientWidth + 1;
}).map((e) => e.innerText || e.tagName)"""
BROKEN = "[...document.querySelectorAll('tr')].filter((r) => getComputedStyle(r).breakInside !== 'avoid').length"


TEXTS = """(() => {
  const texts = [], canvas = CanvasRenderingContext2D.prototype, plain = canvas.fillText;
  canvas.fillText = function (text, ...at) { texts.push(text); plain.call(this, text, ...at); };
  dispatchEvent(new Event("beforeprint"));
  return texts;
})()"""


@pytest.fixture(scope="module")
def pages(page, tmp_path_factory):
    """The pages of an optimization, a front and a workspace."""
    place = tmp_path_factory.mktemp("pages")
    g, home = nd.Geometry.hexagonal(a1=0.0, a2=5.8, b1=2.9, b2=0.0), nd.Configuration.neutral(4.0, 2.4)
    box, criteria = ([-2.0, -2.0, 3.0], [2.0, 2.0, 7.0]), {"leg_limits": (2.5, 6.5)}
    space = nd.workspace(g, box, criteria=criteria, home=home, tolerance=0.1)
    bodies = ("base_external", "base_internal", "platform_external", "platform_internal")
    asked = {
        "geometry": {name: getattr(g, name) for name in bodies},
        "home": {name: getattr(home, name) for name in ("position", "rotation", "internal_point")},
        "criteria": criteria,
    }
    front = nd.pareto(
        nd.Study(constraints={"leg_length": (None, 9.0)}, starts=4), "radius_ratio", values=[2.0, 2.5, 4.0]
    )
    made = {"optimization": page}
    for name, run in (("front", front), ("workspace", space)):
        (place / name).mkdir()
        write_run(run, place / name, question=asked if run is space else None)
        (place / name / "mechanism.svg").write_text(STILL)
        made[name] = nd.report(place / name)
    return made


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", ["optimization", "front", "workspace"])
def test_nothing_overflows_and_the_view_is_drawn_at_phone_and_desktop_width(browser, pages, name):
    browser.errors.clear()
    browser.messages.clear()
    for width in WIDTHS:
        browser.open(pages[name], width, 800)
        root = "document.documentElement"
        assert browser.run(f"{root}.scrollWidth") <= browser.run(f"{root}.clientWidth"), width
        assert browser.run(f"{root}.dataset.scene") == "ready"
        assert browser.run(DRAWN) > 8
    assert browser.errors == []
    assert browser.messages == []


def test_another_pose_has_another_condition_number(browser, pages):
    browser.open(pages["optimization"])
    first = browser.run("document.getElementById('kappa').textContent")
    browser.run("document.querySelector('[data-view=top]').click()")
    browser.run(OTHER_POSE)
    assert browser.run("document.getElementById('kappa').textContent") != first


@pytest.mark.parametrize("name", ["optimization", "front", "workspace"])
def test_tables_fit_the_paper(browser, pages, name):
    browser.open(pages[name], PAPER, 1000, media="print")
    assert browser.run(WIDE) == []
    assert browser.run(BROKEN) == 0


TORN = """(() => {
  const height = 1024; // pixels of A4 between the margins
  return [...document.querySelectorAll("main table")].filter((t) => t.getBoundingClientRect().height > height)
    .map((t) => t.caption?.innerText).concat([...document.querySelectorAll("table, figure, .stage, tr")]
    .filter((e) => getComputedStyle(e).breakInside !== "avoid").map((e) => e.className || e.tagName));
})()"""
ORDINARY = nd.Study(
    variables={
        "a1": 0.0,
        "a2": (100.0, 850.0),
        "b1": (50.0, 350.0),
        "b2": 0.0,
        "zp": (300.0, 700.0),
        "zs": (50.0, 650.0),
    },
    constraints={
        "stroke_ratio": (None, 1.4),
        "base_cone": {"max_deg": 45},
        "platform_cone": {"max_deg": 45},
        "leg_clearance": {"min": 20.0},
    },
    objective={"region": {"box": [60.0, 60.0, 40.0], "tilt_deg": 10}},
    starts=4,
    unit="mm",
    characteristic_length=150.0,
)


LOADED = replace(
    ORDINARY,
    constraints={**ORDINARY.constraints, "force": (None, 600.0), "rate": (None, 400.0)},
    loads={"wrenches": [[0.0, 0.0, 0.0, 0.0, 0.0, -500.0]]},
    speeds={"linear": 200.0, "angular_deg": 30.0},
    tool={"position": [0.0, 0.0, -100.0]},
    masses={"platform": 12.0, "centre": [0.0, 0.0, -30.0]},
)
THREE_DESIGNS = """(() => {
  for (const row of document.querySelectorAll("#answer tr")) {
    row.lastChild.textContent ||= "best";
    if (row.innerText.startsWith("limits reached")) row.lastChild.textContent = "leg ratio, base cone, platform cone";
    row.append(row.lastChild.cloneNode(true), row.lastChild.cloneNode(true));
  }
})()"""
DESKTOP = (1000, 1200, 1920)
MANY_REACHED = """(() => {
  const rows = [...document.querySelectorAll("#answer tr")].filter((r) => r.innerText.startsWith("limits reached"));
  for (const row of rows)
    row.lastChild.textContent = "base external radius, stroke ratio, base cone, platform cone, leg clearance";
  return rows.length;
})()"""
CUT = """[...document.querySelectorAll(".table")].filter((e) => e.scrollWidth > e.clientWidth + 1)
  .map((e) => e.innerText)"""
OVERLAP = """[...document.querySelectorAll(".beside > div")].filter((e) => e.scrollWidth > e.clientWidth + 1).length"""


POSES = [
    *nd.poses.box(half=(60.0, 60.0, 40.0), tilt_deg=(10, 10, 0)),
    *nd.poses.box(half=(30.0, 30.0, 20.0), tilt_deg=(5, 0, 10)),
]
POSED = replace(LOADED, objective={"poses": POSES[:31]})
OF_KINDS = {"external": (14.0, 23.0, 1200.0, 4.5), "upper": (7.0, 11.0, 900.0, 6.0), "lower": (14.0, 23.0, 1200.0, 4.5)}
CERTIFIED = replace(
    LOADED,
    unit="in",
    characteristic_length=6.0,
    about={"project": "Drill head positioner", "author": "J. Doe", "revision": "B"},
    variables={"a1": 0.0, "a2": (6.0, 34.0), "b1": (3.0, 14.0), "b2": 0.0, "zp": (12.0, 28.0), "zs": (3.0, 25.0)}
    | {"theta_z": 0.0},
    constraints={"base_cone": {"max_deg": 45.0}, "platform_cone": {"max_deg": 45.0}, "leg_clearance": {"radius": 0.6}}
    | {"power": {"max": 4000.0}, "singularity_free": {}}
    | {f"{kind}_length": row[:2] for kind, row in OF_KINDS.items()}
    | {f"{kind}_force": {"max": row[2]} for kind, row in OF_KINDS.items()}
    | {f"{kind}_rate": {"max": row[3]} for kind, row in OF_KINDS.items()},
    objective={"region": {"box": [2.0, 2.0, 1.5], "tilt_deg": 8.0}},
    tool={"position": [0.0, 0.0, -3.5]},
    loads={"wrenches": [[0.0, 0.0, 40.0, 0.0, 0.0, 300.0]]},
    masses={"platform": 14.0, "centre": [0.0, 0.0, -1.0], "cylinder": 1.4, "rod": 0.6},
    speeds={"linear": 3.0, "angular_deg": 15.0},
    tolerances={"joints": 0.001, "legs": 0.0005},
)


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize(
    "study",
    [ORDINARY, LOADED, POSED, CERTIFIED],
    ids=["ordinary", "loads and limits of them", "dozens of poses too", "a certificate too"],
)
def test_a_report_has_at_most_four_pages_and_no_table_is_torn_or_cut(browser, tmp_path, study):
    result = nd.optimize(study)
    write_run(result, tmp_path)
    for name, figure in figures_of(result)():
        nd.plot.save(figure, tmp_path, name)
    if study is CERTIFIED:
        save_certificate(result.certify(time_limit=20.0), certificate_file(tmp_path))
    made = nd.report(tmp_path)
    browser.open(made)
    assert ("tool" in browser.run(TEXTS)) == bool(study.tool)
    for width in DESKTOP:
        browser.open(made, width, 1000)
        assert browser.run(MANY_REACHED) == 1
        assert browser.run(CUT) == [], width
    browser.open(made, PAPER, 1000, media="print")
    assert browser.run(TORN) == []
    assert browser.run("getComputedStyle(document.querySelector('.of-mechanism')).display") == "none"  # shown already
    browser.pdf(tmp_path / "it.pdf")
    assert len(re.findall(rb"/Type\s*/Page\b", (tmp_path / "it.pdf").read_bytes())) <= 4
    if study is POSED:
        shown = "[...document.querySelectorAll('#again pre')].filter((e) => e.offsetHeight).at(-1).innerText"
        assert "# and 25 more, on the screen\n" in browser.run(shown)
        browser.open(made)
        assert browser.run(shown).count("[[objective.poses]]") == 31
        browser.open(made, PAPER, 1000, media="print")
    browser.run(THREE_DESIGNS)
    assert browser.run(OVERLAP) == 0
