"""DXF: ezdxf reads the file without a complaint, and finds joints, outlines and dimensions where they belong."""

import functools
import io
import re
import sys

import ezdxf
import numpy as np
import pytest
from written_designs import HEXAGON, PAPER, general, text_of

import ninedof as nd
from ninedof.export import dxf
from ninedof.export.model import model_of
from ninedof.robot.plates import plates_of
from ninedof.support.extras import MissingExtra

ANGULAR = 5  # kind of a dimension
THREEFOLD = nd.Geometry.symmetric(
    base_external=(500.0, 0.0, 0.0),
    base_internal=(300.0, 2.6, 0.0),
    platform_external=(150.0, -0.75, 0.0),
    platform_internal=(90.0, 0.25, -20.0),
)
CASES = {
    "paper": (PAPER, 0),
    "hexagon": (HEXAGON, 4),
    "general": (general(1), 1),
    "threefold": (nd.Design(THREEFOLD, HEXAGON.configuration, 1.0, "m"), 6),
    "feet": (general(2, "ft"), 2),
    "centimetres": (general(3, "cm"), 5),
}


@functools.cache
def drawn(name):
    """The drawing of a case; tests look and do not touch."""
    return drawing(CASES[name][0])


def drawing(design):
    return ezdxf.read(io.StringIO(text_of(dxf, design)))


def on(document, layer, kind):
    return list(document.modelspace().query(f'{kind}[layer=="{layer}"]'))


def shift(document):
    """The place of the origin of the platform: it is written in the title of its table."""
    titles = [text.dxf.text for text in on(document, "TEXT", "TEXT")]
    (title,) = [words for words in titles if words.startswith("Platform")]
    return np.array([float(title.partition("x = ")[2].split()[0]), 0.0])


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", CASES)
def test_joints_where_they_are_and_no_complaint(name):
    design, code = CASES[name]
    document = drawn(name)
    audit = document.audit()
    assert (audit.errors, audit.fixes) == ([], [])
    assert document.header["$INSUNITS"] == code
    circles = np.array([circle.dxf.center for circle in on(document, "JOINTS", "CIRCLE")])[:, :2]
    g, away = design.geometry, shift(document)
    joints = np.vstack([g.base_external, g.base_internal])[:, :2]
    above = np.vstack([g.platform_external, g.platform_internal])[:, :2] + away
    target = np.vstack([joints, above])
    apart = np.linalg.norm(target[:, None] - circles, axis=2)
    tolerance = 1e-12 * np.abs(target).max()
    assert np.all(apart.min(axis=0) <= tolerance)
    assert np.all(apart.min(axis=1) <= tolerance)
    assert joints[:, 0].max() < above[:, 0].min()
    words = " ".join(text.dxf.text for text in on(document, "TEXT", "TEXT"))
    labels = sorted(re.findall(r"\b[EI][123]\b", words))
    assert labels == sorted(4 * ["E1", "E2", "E3", "I1", "I2", "I3"])  # beside its circle and in the table


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", CASES)
def test_the_outline_goes_around_all_joints(name):
    document = drawn(name)
    circles = np.array([circle.dxf.center for circle in on(document, "JOINTS", "CIRCLE")])[:, :2]
    outlines = on(document, "OUTLINE", "LWPOLYLINE")
    assert len(outlines) == 2
    inside = 0
    for outline in outlines:
        assert outline.closed
        corners = np.array(outline.get_points("xy"))
        ahead = np.roll(corners, -1, axis=0) - corners
        from_corner = circles[:, None] - corners
        turn = ahead[:, 0] * from_corner[..., 1] - ahead[:, 1] * from_corner[..., 0]
        slack = 1e-9 * np.abs(corners).max() ** 2
        inside += int(np.sum(np.all(turn >= -slack, axis=1) | np.all(turn <= slack, axis=1)))
    assert inside == len(circles)


def dimensions(name):
    result = {}
    for one in on(drawn(name), "DIMENSIONS", "DIMENSION"):
        if one.dimtype == ANGULAR:
            continue
        result.setdefault(one.dxf.text.partition(" =")[0], []).append(one.get_measurement())
    return result


def test_sides_of_hexagons_are_dimensioned():
    result = dimensions("hexagon")
    assert {name: result[name][0] for name in ("a1", "a2", "b1", "b2")} == pytest.approx(
        {"a1": 120.0, "a2": 480.0, "b1": 300.0, "b2": 30.0}, rel=1e-12
    )
    radii = [np.sqrt((a * a + a * b + b * b) / 3.0) for a, b in ((120.0, 480.0), (300.0, 30.0))]
    assert result["<>"] == pytest.approx(radii, rel=1e-12)
    assert {name for name in dimensions("paper") if name != "<>"} == {"a2", "b1"}  # the others are 0


def test_other_plates_have_the_radii_that_they_have():
    assert dimensions("threefold")["<>"] == pytest.approx([500.0, 300.0, 150.0, 90.0], rel=1e-12)
    assert dimensions("general") == {}


def test_a_dimension_shows_what_it_measures():
    document = drawn("hexagon")
    shown = []
    for one in on(document, "DIMENSIONS", "DIMENSION"):
        shown += [text.text for text in document.blocks.get(one.dxf.geometry).query("MTEXT")]
    assert any("a2 = 480.000" in words for words in shown)


def box(centre, width, height, angle):
    """Corners of a rectangle, from its definition."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    corners = 0.5 * np.array([[-width, -height], [width, -height], [width, height], [-width, height]])
    return corners @ turn.T + centre


def separate(one, other):
    """Whether a line through an edge of one has the other outline on its far side."""
    for a, b in ((one, other), (other, one)):
        for k, corner in enumerate(a):
            x, y = a[(k + 1) % len(a)] - corner
            sides = (b - corner) @ [y, -x]
            own = (a - corner) @ [y, -x]
            if sides.min() >= own.max() - 1e-12 or sides.max() <= own.min() + 1e-12:
                return True
    return False


DIGIT = 0.62  # advance of letters in heights of capitals, narrower than any that programs use


def texts(document):
    """Words of dimensions and of names with their rectangles, those of tables too."""
    found = []
    for one in on(document, "DIMENSIONS", "DIMENSION"):
        for text in document.blocks.get(one.dxf.geometry).query("MTEXT"):
            words, height = text.plain_text(), text.dxf.char_height
            angle = np.radians(text.get_rotation())
            found.append((words, box(np.array(text.dxf.insert)[:2], DIGIT * height * len(words), height, angle)))
    for text in on(document, "TEXT", "TEXT"):
        words, height = text.dxf.text, text.dxf.height
        width = DIGIT * height * len(words)
        align, first, _ = text.get_placement()
        left = {"LEFT": 0.5, "RIGHT": -0.5, "MIDDLE_CENTER": 0.0}[align.name]
        up = 0.0 if align.name == "MIDDLE_CENTER" else 0.5
        found.append((words, box(np.array([first[0] + left * width, first[1] + up * height]), width, height, 0.0)))
    return found


SMALL = nd.Geometry.symmetric((1440.0, 0.0, 0.0), (344.7, 0.19, 0.0), (90.0, 1.19, 0.0), (121.7, -0.046, 0.0))
CROWDED = {"small platform": nd.Design(SMALL, nd.Configuration.neutral(557.0, 310.0), 1.0, "mm")}


@pytest.mark.slow(sanitized=True)
@pytest.mark.parametrize("name", [*CASES, *CROWDED])
def test_no_words_cross_and_no_line_of_a_dimension_crosses_a_name(name):
    document = drawing(CROWDED[name]) if name in CROWDED else drawn(name)
    found = texts(document)
    assert len(found) > 50
    for k, (words, one) in enumerate(found):
        for other_words, other in found[:k]:
            assert separate(one, other), (words, other_words)
    names = [(words, one) for words, one in found if re.fullmatch(r"([EI][123] ?)+|[xy]", words)]
    assert len(names) >= 8
    for dimension in on(document, "DIMENSIONS", "DIMENSION"):
        for line in document.blocks.get(dimension.dxf.geometry).query("LINE"):
            ends = np.array([line.dxf.start, line.dxf.end])[:, :2]
            for words, one in names:
                assert separate(one, ends), (words, dimension.dxf.text)


@pytest.mark.parametrize("name", ["paper", "hexagon", "general", "threefold"])
def test_cone_axes_are_drawn_and_listed_along_the_legs(name):
    document, design = drawn(name), CASES[name][0]
    g, c = design.geometry, design.configuration
    up = g.platform_external @ c.rotation.T + c.position, g.platform_internal @ c.rotation.T + c.position
    legs = [
        up[0] - g.base_external,
        c.internal_point - g.base_internal,
        g.base_external - up[0],
        c.internal_point - up[1],
    ]
    axes = np.vstack(legs) / np.linalg.norm(np.vstack(legs), axis=1)[:, None]
    axes[6:] = axes[6:] @ c.rotation  # in the frame of the platform
    words = [text.dxf.text for text in on(document, "TEXT", "TEXT")]
    rows = [words[k + 6 : k + 9] for k, word in enumerate(words) if re.fullmatch(r"[EI]\d  (ex|in)ternal \d", word)]
    listed = np.array(rows, dtype=float)
    assert listed == pytest.approx(axes, abs=2e-5)
    for line in on(document, "CONES", "LINE"):
        way = np.array(line.dxf.end - line.dxf.start)[:2]
        cosines = axes[:, :2] @ way / np.linalg.norm(axes[:, :2], axis=1) / np.linalg.norm(way)
        assert cosines.max() == pytest.approx(1.0, abs=1e-9)


def test_the_axis_of_a_limit_is_drawn_in_the_place_of_the_leg():
    limits = {"base_cone": {"max_deg": 60, "axis": [0.0, 0.6, 0.8]}, "radius_ratio": {"max": 2.0}}
    model = model_of(nd.optimize(nd.Study(constraints=limits), starts=2))
    for joint, axis in model.cone_axes.items():
        assert joint.startswith("platform") or axis == pytest.approx([0.0, 0.6, 0.8])
        assert np.linalg.norm(axis) == pytest.approx(1.0)


def test_the_axis_of_a_kind_of_joint_comes_before_that_of_its_body():
    own = {"max_deg": 80, "axis": [0.0, 0.6, 0.8]}
    limits = {"base_cone_external": own, "base_cone": {"max_deg": 85, "axis": [0.0, 0.0, 1.0]}}
    result = nd.optimize(nd.Study(constraints=limits), starts=2)
    axes, of_sheet = model_of(result).cone_axes, nd.sheet(result).cone_axes
    for kind in ("external", "internal"):
        assert axes[f"base_{kind}_1"] == pytest.approx(of_sheet[f"base_cone_{kind}"])


def test_angles_are_dimensioned_and_listed():
    document = drawn("threefold")
    angles = [one.get_measurement() for one in on(document, "DIMENSIONS", "DIMENSION") if one.dimtype == ANGULAR]
    base = sorted(np.degrees(np.array([0.0, 2.6])) % 120.0)
    platform = sorted(np.degrees(np.array([-0.75, 0.25])) % 120.0)
    assert angles == pytest.approx([base[1], platform[0], platform[1] - platform[0]], rel=1e-9)
    words = [text.dxf.text for text in on(document, "TEXT", "TEXT")]
    assert f"{np.degrees(2.6):.4f}" in words
    assert f"{np.degrees(-0.75):.4f}" in words


@pytest.mark.slow(sanitized=True)
def test_the_neutral_pose_and_the_tool_are_written():
    turned, tool = nd.Configuration.neutral(320.0, 180.0, 0.3), nd.Tool((0.0, 0.0, -40.0))
    g, c = tool.robot(HEXAGON.geometry, turned)
    document = drawing(nd.Design(g, c, 1.0, "mm", tool))
    notes = {text.dxf.text for text in on(document, "TEXT", "TEXT")}
    height = r"neutral pose: zp = 320\.0+ mm, zs = 180\.0+ mm, theta_z = 17\.189°, tool at \(0, 0, -40\) mm"
    assert any(re.fullmatch(height, words) for words in notes)


def test_a_plate_on_edge_has_no_outline():
    upright = np.array([[0.0, 1.0, 0.0], [0.0, -1.0, 1.0], [0.0, -1.0, -1.0]])
    design = PAPER._replace(geometry=nd.Geometry(upright, 2.0 * upright, *plates_of_paper()))
    document = drawing(design)
    assert len(on(document, "OUTLINE", "LWPOLYLINE")) == 1
    assert not len(plates_of(design.geometry)[0].outline)


def plates_of_paper():
    return PAPER.geometry.platform_external, PAPER.geometry.platform_internal


def test_the_missing_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(MissingExtra, match=r"pip install 'ninedof\[cad\]'"):
        text_of(dxf, PAPER)
