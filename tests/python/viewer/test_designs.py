"""A set of admissible designs in the viewer: a click in its picture shows the design there, with its numbers."""

import asyncio
import math
import time
from types import SimpleNamespace

import chromium
import numpy as np
import pytest
from interrupts import until
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof.plot.admissible import INSIDE
from ninedof.records.proofs import admissible_file, latest_admissible
from ninedof.viewer.designs import DesignPicture

STUDY = nd.Study(
    variables={"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": (2.0, 8.0), "zs": (1.0, 6.0)}
    | {"theta_z": (-0.5, 0.5)},
    constraints={"leg_ratio": (None, 3.0), "radius_ratio": (None, 2.5)},
)
VARY = {"two": ("a2", "b1"), "three, with an angle": ("a2", "zp", "theta_z")}


@pytest.fixture(scope="module")
def result():
    return nd.optimize(STUDY, starts=2, seed=1)


@pytest.fixture(scope="module", params=VARY)
def designs(result, request):
    return nd.admissible(result, VARY[request.param], resolution=0.1)


def ray_to(picture, mark):
    """A ray from an eye somewhere to a point in the frame of the picture, as viser states its rotation."""
    turn = Rotation.from_quat(np.roll(picture.turn, -1)).as_matrix()
    eye = np.array([1.3, -9.0, 4.1])
    way = picture.centre + turn @ mark - eye
    return tuple(eye), tuple(way / np.linalg.norm(way))


def test_every_place_in_the_picture_is_the_design_there(designs):
    picture = DesignPicture(designs)
    rng = np.random.default_rng(1)
    ends = np.array(designs.of.ranges)
    pairs = [(i, j) for i in range(len(ends)) for j in range(i + 1, len(ends))]
    for x in rng.uniform(ends[:, 0], ends[:, 1], (20, len(ends))):
        variables = dict(designs.of.at) | dict(zip(designs.vary, x.tolist(), strict=True))
        marks = picture.marks(variables)
        assert len(marks) == len(pairs)
        for mark, pair in zip(marks, pairs, strict=True):
            there = picture.design_at(*ray_to(picture, mark))
            varied = {designs.vary[k]: variables[designs.vary[k]] for k in pair}
            assert there == pytest.approx(dict(designs.of.at) | varied, rel=1e-9, abs=1e-9)
    assert picture.design_at(*ray_to(picture, np.array([*(0.499 * picture.size), 0.0]))) is None  # beside the planes
    assert picture.design_at((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)) is None  # along the picture


def test_the_picture_is_over_a_high_machine(result):
    """Seen from the first camera, which looks down, the platform covered its lower side: axis and key."""
    designs = nd.admissible(result, ("a2", "b1"), resolution=0.5)
    low, high = (DesignPicture(designs, top) for top in (0.5, 3.0))
    for picture, bottom in ((low, 1.1), (high, 2.5)):
        assert picture.centre[2] - 0.5 * picture.size[1] == pytest.approx(bottom)


def test_the_picture_has_the_colours_of_the_figure_where_marks_say(result):
    """At the middle of the largest box inside the picture has the colour of what is inside."""
    designs = nd.admissible(result, VARY["two"], resolution=0.1)
    picture = DesignPicture(designs)
    box = designs.inside[np.prod(np.ptp(designs.inside, axis=2), axis=1).argmax()]
    variables = dict(designs.of.at) | dict(zip(designs.vary, box.mean(axis=1).tolist(), strict=True))
    (mark,) = picture.marks(variables)
    column, row = ((mark[:2] / picture.size + 0.5) * picture.pixels.shape[1::-1]).astype(int)
    near = picture.pixels[row - 3 : row + 4, column - 3 : column + 4].reshape(-1, 3)
    assert (near == list(bytes.fromhex(INSIDE[1:]))).all(axis=1).any()


def test_a_click_moves_the_design_and_the_numbers(result, designs):
    pytest.importorskip("viser", reason="the viewer needs viser")
    with nd.view(result, port=0, designs=designs) as viewer:
        picture, node = viewer.designs, viewer.scene.nodes["/designs"]
        wanted = dict(designs.of.at) | {
            name: 0.5 * sum(ends) for name, ends in zip(designs.vary[:2], designs.of.ranges[:2], strict=True)
        }
        held = next(name for name in ("b1", "zs") if name not in designs.vary)
        viewer.submit("held", lambda: viewer.state.set_variables({held: 1.05 * designs.of.at[held]}))
        words = viewer.panel.widgets["admissible"]
        until(lambda: f"another {held}: the set is at {held} = " in words.content)
        origin, way = ray_to(picture, picture.marks(wanted)[0])
        (clicked,) = (one.callback for one in node._impl.click_cb)
        asyncio.run(clicked(SimpleNamespace(ray_origin=origin, ray_direction=way)))
        until(lambda: viewer.state.variables == pytest.approx(wanted))
        expected = STUDY.evaluate(wanted).condition_number
        until(lambda: math.isclose(viewer.panel.numbers.condition_number, expected, rel_tol=1e-6))
        assert np.allclose(viewer.scene.nodes["/designs/0"].position, picture.marks(wanted)[0])
        state = designs.state_of([[wanted[name] for name in designs.vary]])[0]
        told = {"inside": "keeps every limit", "outside": "breaks a limit", "undecided": "nothing is proved"}
        until(lambda: told[state] in words.content)
        asyncio.run(clicked(SimpleNamespace(ray_origin=origin, ray_direction=(0.0, 0.0, 1.0))))  # past it: nothing
        viewer.submit("hide", lambda: viewer.state.display.show("designs", False))
        until(lambda: not node.visible)


def test_a_design_out_of_the_ranges_has_no_mark(result):
    designs = nd.admissible(result, {"a2": (3.0, 4.0), "b1": (2.0, 3.0)}, resolution=0.5)
    picture = DesignPicture(designs)
    assert picture.marks(dict(designs.of.at) | {"a2": 5.0}) == [None]
    assert "not in the ranges" in picture.words(dict(designs.of.at) | {"a2": 5.0})


def test_the_set_written_last_beside_a_run_is_shown(run, result, tmp_path):
    pytest.importorskip("viser", reason="the viewer needs viser")
    record = nd.save(result, tmp_path / "run")
    folder = record.parent
    with nd.view(folder, port=0) as viewer:
        assert viewer.designs is None
    assert run(f"admissible {record} --vary a2 --vary zp --resolution 0.2 --condition 9")[0] == 0
    with nd.view(str(folder), port=0) as viewer:
        designs = viewer.designs.designs
        assert designs.vary == ("a2", "zp")
        assert designs.of.condition_number == 9.0
        assert designs.of.at == pytest.approx(result.variables)
    other = nd.admissible(nd.Study(variables=STUDY.variables), ("a2", "b1"), at=result.variables, resolution=0.5)
    other.save(admissible_file(folder, other.of))
    assert latest_admissible(folder, result.study).vary == ("a2", "zp")  # the newer one is of another study


def test_what_is_refused(result):
    pytest.importorskip("viser", reason="the viewer needs viser")
    one = nd.admissible(result, ("a2",), resolution=0.5)
    other = nd.admissible(nd.Study(variables=STUDY.variables), ("a2", "b1"), at=result.variables, resolution=0.5)
    for design, designs, words in (
        (result, one, "designs: got a set of a2 alone, expected two to four variables"),
        (result, other, "designs: got a set of another study"),
        (None, other, "designs: got a set of another study"),
        (result, "a2", "designs: got str, expected an AdmissibleSet"),
    ):
        with pytest.raises(ValueError, match=words):
            nd.view(design, port=0, designs=designs)


@pytest.mark.slow
@pytest.mark.skipif(chromium.PROGRAM is None, reason="needs the program chromium")
def test_a_browser_clicks_in_the_picture(result, tmp_path):
    pytest.importorskip("viser", reason="the viewer needs viser")
    designs = nd.admissible(result, ("a2", "b1"), resolution=0.2)
    with (
        nd.view(result, port=0, designs=designs) as viewer,
        chromium.page(f"{viewer.url}/?fixedDpr=0.5", tmp_path / "profile", 1000, 700) as page,
    ):
        page.wait_for("document.getElementById('ninedof-condition-number')?.textContent")
        begun, (mark,) = dict(viewer.state.variables), viewer.designs.marks(designs.of.at)
        place = {"x": 0.0, "y": 0.0}

        def click():
            place.update(seen_at(page, viewer, mark + np.array([0.3, -0.3, 0.0])))  # beside the note of the browser
            for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
                page.call("Input.dispatchMouseEvent", type=kind, **place, button="left", clickCount=1)
                time.sleep(0.3)
            return viewer.state.variables != begun

        until(click, 60.0)
        until(lambda: viewer.panel.numbers.condition_number > 0.0)
        moved = viewer.designs.marks(viewer.state.variables)[0] - mark
        np.testing.assert_allclose(moved, [0.3, -0.3, 0.0], atol=0.08)


def seen_at(page, viewer, mark):
    """Where a browser sees a point of the picture, by the camera that it tells the server of."""
    (client,) = viewer._server.get_clients().values()
    camera, picture = client.camera, viewer.designs
    turn = Rotation.from_quat(np.roll(picture.turn, -1)).as_matrix()
    x, y, z = Rotation.from_quat(np.roll(camera.wxyz, -1)).inv().apply(picture.centre + turn @ mark - camera.position)
    size = page.run(
        "(r => [r.left, r.top, r.width, r.height])(document.querySelector('canvas').getBoundingClientRect())"
    )
    scale = 0.5 * size[3] / math.tan(0.5 * camera.fov) / z
    return {"x": size[0] + 0.5 * size[2] + scale * x, "y": size[1] + 0.5 * size[3] + scale * y}
