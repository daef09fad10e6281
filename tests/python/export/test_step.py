"""STEP: OpenCASCADE, inside gmsh, reads the points and lines where the joints are, whatever the unit."""

import re

import numpy as np
import pytest
from written_designs import HEXAGON, PAPER, general, text_of

import ninedof as nd
from ninedof.export import step

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8, "": 1.0}


@pytest.fixture(scope="module")
def gmsh():
    try:
        import gmsh
    except (ImportError, OSError) as error:  # its library needs those of a screen
        pytest.skip(f"gmsh cannot be loaded: {error}")
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    yield gmsh
    gmsh.finalize()


def expected(design):
    """The twelve joints, p and O, and the ends of the nine legs, in millimetres; nothing of the package but arrays."""
    g, c = design.geometry, design.configuration
    upper = [c.position + joints @ c.rotation.T for joints in (g.platform_external, g.platform_internal)]
    o = np.tile(c.internal_point, (3, 1))
    points = np.vstack([g.base_external, g.base_internal, *upper, c.position, c.internal_point])
    legs = [(g.base_external, upper[0]), (upper[1], o), (g.base_internal, o)]
    lines = np.array([pair for a, b in legs for pair in zip(a, b, strict=True)])
    return points * MILLIMETRES[design.unit], lines * MILLIMETRES[design.unit]


@pytest.mark.parametrize("unit", MILLIMETRES)
@pytest.mark.parametrize("name", ["paper", "general"])
def test_points_and_lines_as_opencascade_reads_them(name, unit, gmsh, tmp_path):
    design = (PAPER if name == "paper" else general(4))._replace(unit=unit)
    file = tmp_path / "robot.step"
    file.write_text(text_of(step, design))
    gmsh.clear()
    gmsh.model.occ.importShapes(str(file), highestDimOnly=False)
    gmsh.model.occ.synchronize()
    at = {tag: gmsh.model.getValue(0, tag, []) for _, tag in gmsh.model.getEntities(0)}
    curves = [tag for _, tag in gmsh.model.getEntities(1)]
    assert {gmsh.model.getType(1, tag) for tag in curves} == {"Line"}
    ends = {tag: [end for _, end in gmsh.model.getBoundary([(1, tag)])] for tag in curves}
    free = np.array([at[tag] for tag in at if not any(tag in pair for pair in ends.values())])
    lines = np.array([[at[a], at[b]] for a, b in ends.values()])
    points, legs = expected(design)
    close = {"rtol": 0.0, "atol": 1e-9 * np.abs(points).max()}
    assert lines.shape == (9, 2, 3)
    np.testing.assert_allclose(lines, legs, **close)
    assert free.shape == (14, 3)
    np.testing.assert_allclose(free, points, **close)
    assert not gmsh.model.getEntities(2)


def test_every_reference_is_to_an_entity_of_the_file():
    data = text_of(step, HEXAGON).partition("DATA;\n")[2].partition("ENDSEC;")[0]
    defined = re.findall(r"^(#\d+)=", data, re.MULTILINE)
    used = re.findall(r"[(,](#\d+)", data)
    assert len(set(defined)) == len(defined) == data.count("\n")
    assert set(used) <= set(defined)
    assert set(defined) - set(used) == {
        line.partition("=")[0]
        for line in data.splitlines()
        if re.search("LAYER|PROTOCOL_DEF|CATEGORY|SHAPE_DEFINITION_REP", line)
    }


def test_names_and_reals():
    text = text_of(step, HEXAGON._replace(configuration=nd.Configuration([1e-7, 0, 3e22], None, [0.0, 0.0, 1.0])))
    assert "CARTESIAN_POINT('p',(1.E-07,0.0,3.E+22))" in text
    for name in ("base_external_1", "platform_internal_3", "O", "l1", "q2", "r3", "external legs"):
        assert f"'{name}'" in text


def test_a_unit_that_is_assumed_is_said():
    assert "mm is assumed" in text_of(step, PAPER)
    assert "assumed" not in text_of(step, HEXAGON)


def test_a_leg_without_length_has_no_line():
    folded = PAPER._replace(configuration=nd.Configuration([0, 0, 4.0], None, PAPER.geometry.base_internal[0]))
    assert text_of(step, folded).count("TRIMMED_CURVE") == 8
