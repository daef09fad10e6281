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
from ninedof.export.dxf import plates_of
from ninedof.support.extras import MissingExtra

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
