"""Design files: a geometry and a configuration written by hand."""

import numpy as np
import pytest

import ninedof as nd
from ninedof.records.design_file import indices, load_design

HEXAGON = "[geometry]\na1 = 0.0\na2 = 5.8124\nb1 = 2.9062\nb2 = 0\n"
NEUTRAL = "[configuration]\nzp = 3.9828\nzs = 2.3745\n"


def load(tmp_path, text):
    file = tmp_path / "design.toml"
    file.write_text(text)
    return load_design(file)


def test_hexagonal_design(tmp_path):
    design = load(tmp_path, HEXAGON + NEUTRAL)
    assert indices(design)["condition_number"] == pytest.approx(3.9110, abs=5e-5)


def test_any_joints_and_any_pose(tmp_path, published):
    triples = "".join(
        f"{name} = {getattr(published, name).tolist()}\n"
        for name in ("base_external", "base_internal", "platform_external", "platform_internal")
    )
    pose = "position = [0.1, 0.2, 4]\ninternal_point = [0, 0, 2.0]\nrotation = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]\n"
    design = load(tmp_path, f'characteristic_length = "optimal"\n[geometry]\n{triples}[configuration]\n{pose}')
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    c = nd.Configuration([0.1, 0.2, 4.0], quarter, [0.0, 0.0, 2.0])
    assert design.geometry == published
    assert design.configuration == c
    assert indices(design)["condition_number"] == nd.condition_number(published, c, "optimal")


BAD = {
    "empty": ("", "geometry: got nothing"),
    "no configuration": (HEXAGON, "configuration: got nothing"),
    "side missing": (HEXAGON.replace("b2 = 0", "") + NEUTRAL, "geometry.b2"),
    "side as text": (HEXAGON.replace("b2 = 0", 'b2 = "0"') + NEUTRAL, "geometry.b2: got '0'"),
    "side as truth": (HEXAGON.replace("b2 = 0", "b2 = true") + NEUTRAL, "geometry.b2: got True"),
    "zs missing": (HEXAGON + "[configuration]\nzp = 1.0\n", "configuration.zs"),
    "zs as text": (HEXAGON + '[configuration]\nzp = 1.0\nzs = "low"\n', "zs: got 'low'"),
    "unknown entry": (HEXAGON + NEUTRAL + "zq = 1.0\n", "'zq'"),
    "unknown table": (HEXAGON + NEUTRAL + "[study]\n", "'study'"),
    "wrong shape": (
        "[geometry]\nbase_external = [1, 2]\nbase_internal = [[1]]\nplatform_external = 1\nplatform_internal = 2\n"
        + NEUTRAL,
        "base_external",
    ),
    "reflection": (
        HEXAGON
        + "[configuration]\nposition = [0, 0, 2]\ninternal_point = [0, 0, 1]\nrotation = [[1,0,0],[0,1,0],[0,0,-1]]",
        "rotation",
    ),
    "table for a number": ("geometry = 3\n", "geometry: got 3"),
    "broken": ("[geometry\n", "not a TOML file"),
    "angle twice": (
        HEXAGON + NEUTRAL + "theta_z = 0.1\ntheta_z_deg = 9.0\n",
        "theta_z: got both theta_z and theta_z_deg",
    ),
    "no unit of lengths": ('unit = "zp"\n' + HEXAGON + NEUTRAL, "unit: got 'zp'"),
    "unit in a table": (HEXAGON + NEUTRAL + 'unit = "mm"\n', "configuration.unit: got 'mm', expected no unit here"),
}


@pytest.mark.parametrize(("text", "words"), BAD.values(), ids=BAD.keys())
def test_bad_files_are_named_with_the_entry(tmp_path, text, words):
    with pytest.raises(ValueError, match=r"design\.toml: ") as caught:
        load(tmp_path, text)
    assert words in str(caught.value)
