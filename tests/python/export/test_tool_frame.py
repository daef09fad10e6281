"""Files of other programs: plates in their own frames, and the frame of the tool by its name where there is one."""

import shutil
import subprocess
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import ninedof as nd

COMPILER = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
needs_compiler = pytest.mark.skipif(COMPILER is None, reason="no C compiler (cc, gcc or clang)")
TOOL = {"position": (10.0, -20.0, -100.0), "rotation_deg": (0.0, 20.0, 30.0)}
VALUES = {"a1": 0.0, "a2": 871.9, "b1": 435.9, "b2": 0.0, "zp": 597.4, "zs": 366.5}


SUFFIX = {"mjcf": "xml", "c": "h", "latex": "tex"}


@pytest.fixture(scope="module")
def designs():
    how = {"variables": VALUES, "unit": "mm", "characteristic_length": 150.0}
    return [nd.optimize(nd.Study(**how, tool=tool)) for tool in (TOOL, {})]


@pytest.fixture(scope="module")
def files(designs, tmp_path_factory):
    folder = tmp_path_factory.mktemp("files")

    def write(form, k=0):
        return nd.export(designs[k], form, folder / f"machine{k}.{SUFFIX.get(form, form)}")

    return write


def axes():
    return Rotation.from_rotvec(np.radians(TOOL["rotation_deg"])).as_matrix()


def test_plates_are_in_their_own_frames(designs, files):
    g = nd.Geometry.hexagonal(*(VALUES[name] for name in ("a1", "a2", "b1", "b2")))
    for form in ("csv", "mjcf"):
        back = nd.load(files(form))
        assert np.allclose(back.geometry.platform_external, g.platform_external, atol=1e-9)
        assert back.configuration.position == pytest.approx([0.0, 0.0, 597.4], abs=1e-9)


def test_the_site_of_the_tool_stands_at_the_point_that_poses_are_about(designs, files):
    mujoco = pytest.importorskip("mujoco")
    model = mujoco.MjModel.from_xml_path(str(files("mjcf")))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    home = designs[0].configuration
    assert data.site("tool").xpos * 1000 == pytest.approx(home.position, abs=1e-9)
    assert np.allclose(data.site("tool").xmat.reshape(3, 3), home.rotation, atol=1e-12)
    without = mujoco.MjModel.from_xml_path(str(files("mjcf", 1)))
    assert mujoco.mj_name2id(without, mujoco.mjtObj.mjOBJ_SITE, "tool") == -1


def test_urdf_and_sdf_name_the_frame(files):
    root = ElementTree.parse(files("urdf")).getroot()
    joint = next(one for one in root.iter("joint") if one.get("name") == "tool_frame")
    assert joint.find("parent").get("link") == "platform"
    origin = joint.find("origin")
    sdf = ElementTree.parse(files("sdf")).getroot()
    frame = next(one for one in sdf.iter("frame") if one.get("name") == "tool")
    assert frame.get("attached_to") == "platform"
    texts = [f"{origin.get('xyz')} {origin.get('rpy')}", frame.find("pose").text]
    for values in (np.array([float(x) for x in text.split()]) for text in texts):
        assert values[:3] * 1000 == pytest.approx(TOOL["position"])
        assert np.allclose(Rotation.from_euler("xyz", values[3:]).as_matrix(), axes(), atol=1e-12)


@needs_compiler
def test_the_c_header_takes_poses_of_the_tool(designs, files, tmp_path):
    header, home = files("c"), designs[0].configuration
    name = f"ninedof_{header.stem.replace('-', '_')}"
    assert "The platform frame is that of the tool" in header.read_text()
    (tmp_path / "main.c").write_text(
        f'#include <stdio.h>\n#include "{header}"\nint main(void) {{ double x[9]; int k;\n'
        f'{name}_leg_lengths(&{name}_neutral, x); for (k = 0; k < 9; ++k) printf("%.17g ", x[k]);\n'
        f'printf("%.17g", {name}_neutral.p[2]); return 0; }}\n'
    )
    subprocess.run([COMPILER, "-o", tmp_path / "main", tmp_path / "main.c", "-lm"], check=True)
    *lengths, height = map(float, subprocess.check_output([tmp_path / "main"], text=True).split())
    assert lengths == pytest.approx(nd.leg_lengths(designs[1].geometry, designs[1].configuration).tolist(), rel=1e-13)
    assert height == home.position[2]


def test_tables_name_the_tool(files):
    assert "\ntool,x,y,z\npoint,10.0,-20.0,-100.0\n" in files("csv").read_text()
    assert "point of the tool" in files("latex").read_text()
    assert "tool" not in files("csv", 1).read_text()
