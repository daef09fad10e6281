"""`nd.load` of an MJCF file gives the design that was written."""

import exported
import numpy as np
import pytest
from numpy.testing import assert_allclose

import ninedof as nd
from ninedof.robot.geometry import triples
from ninedof.support.units import UNITS


def assert_same(outcome, design, tolerance):
    own = {name: np.asarray(values) for name, values in triples(design.geometry).items()}
    for name, values in triples(outcome.geometry).items():
        assert_allclose(values, own[name], rtol=tolerance, atol=0.0)
    for name in ("position", "internal_point"):
        assert_allclose(getattr(outcome.configuration, name), getattr(design.configuration, name), rtol=tolerance)
    assert_allclose(outcome.configuration.rotation, design.configuration.rotation, rtol=0.0, atol=max(tolerance, 1e-15))


@pytest.mark.parametrize("unit", ["", *UNITS])
def test_what_was_exported_is_loaded_to_rounding(unit, tmp_path):
    design = exported.general()._replace(unit=unit)
    outcome = nd.load(nd.export(design, "mjcf", tmp_path / "robot.xml"))
    assert isinstance(outcome, nd.Design)
    assert_same(outcome, design, 5e-16)
    assert (outcome.unit, outcome.characteristic_length) == (unit, "optimal")


def test_a_machine_and_its_sides_in_millimetres_come_back(tmp_path):
    result = exported.machine()
    outcome = nd.load(nd.export(result, "mjcf", tmp_path / "robot.xml"))
    assert_same(outcome, result, 5e-16)
    assert (outcome.unit, outcome.characteristic_length) == ("mm", 150.0)
    assert nd.condition_number(*outcome[:2], 150.0) == pytest.approx(result.neutral_condition_number, rel=1e-13)


def test_what_mujoco_saves_is_read_too(tmp_path):
    mujoco = pytest.importorskip("mujoco")
    design = exported.general()
    engine = mujoco.MjModel.from_xml_path(str(nd.export(design, "mjcf", tmp_path / "robot.xml")))
    mujoco.mj_saveLastXML(str(tmp_path / "saved.xml"), engine)
    assert_same(nd.load(tmp_path / "saved.xml"), design, 1e-4)  # MuJoCo writes six digits


def test_a_site_that_was_moved_moves_the_joint(tmp_path):
    design = nd.Design(nd.Geometry.hexagonal(0.0, 5.0, 2.5, 0.0), nd.Configuration.neutral(4.0, 2.0), 1.0, "m")
    file = nd.export(design, "mjcf", tmp_path / "robot.xml")
    text = file.read_text()
    assert text.count('name="platform_internal1" pos="') == 1
    head, tail = text.split('name="platform_internal1" pos="')
    file.write_text(f'{head}name="platform_internal1" pos="0.5 -1 0.25"{tail[tail.index(chr(34)) + 1 :]}')
    assert nd.load(file).geometry.platform_internal[0].tolist() == [0.5, -1.0, 0.25]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<mujoco", "not an XML file"),
        ("<mujoco/>", "expected an MJCF file written by `ninedof export --to mjcf`"),
        ("<robot/>", "got no 'ninedof-mjcf-1' mark"),
    ],
)
def test_other_files_are_refused_by_name(text, message, tmp_path):
    file = tmp_path / "other.xml"
    file.write_text(text)
    with pytest.raises(ValueError, match=message) as error:
        nd.load(file)
    assert str(error.value).startswith(str(file))
    with pytest.raises(ValueError, match=r"none\.xml: cannot be read"):
        nd.load(tmp_path / "none.xml")
    with pytest.raises(ValueError, match="got a point of a design file"):
        nd.load(f"{file}#1".replace("other", "another"))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('name="platform_external2"', 'name="other"', "got no body or site 'platform_external2'"),
        ('<body name="platform"', '<body name="other"', "got no body or site 'platform'"),
        ('data="m"', 'data="mile"', "unit: got 'mile'"),
        ('data="1.0"', 'data="-1"', "characteristic_length: got"),
        ('xyaxes="1 0 0', 'xyaxes="1 0', "got xyaxes="),
        ('xyaxes="1 0 0', 'xyaxes="2 0 0', "rotation"),
    ],
)
def test_damage_is_named(old, new, message, tmp_path):
    design = nd.Design(nd.Geometry.hexagonal(0.0, 5.0, 2.5, 0.0), nd.Configuration.neutral(4.0, 2.0), 1.0, "m")
    file = nd.export(design, "mjcf", tmp_path / "robot.xml")
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))
    with pytest.raises(ValueError, match=message):
        nd.load(file)
