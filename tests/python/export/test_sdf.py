"""The SDFormat file: read here from its text alone, its joints leave nine degrees of freedom, which move as J' says."""

import shutil
import subprocess
from xml.etree import ElementTree

import exported
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation
from sizes import size

import ninedof as nd

DESIGNS = {"machine in mm": (exported.machine, 1e-3), "general, no unit": (exported.general, 1.0)}


@pytest.fixture(params=DESIGNS)
def robot(request, tmp_path):
    make, metre = DESIGNS[request.param]
    return make(), metre, nd.export(make(), "sdf", tmp_path / "robot.sdf")


def frames(model):
    """Place and rotation of each link in the model."""
    out = {"world": (np.zeros(3), np.eye(3))}
    for link in model.iterfind("link"):
        pose = np.fromstring(link.findtext("pose", "0 0 0 0 0 0"), sep=" ")
        out[link.get("name")] = pose[:3], Rotation.from_euler("xyz", pose[3:]).as_matrix()
    return out


def cross(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def rows_of(joint, place, column, count):
    """The velocities (omega, v of the origin) of all links that a joint forbids; its frame is that of its child."""
    parent, child = joint.findtext("parent"), joint.findtext("child")
    at, turned = place[child]
    linear, angular = np.zeros((2, 3, count))
    for link, sign in ((child, 1.0), (parent, -1.0)):
        if link != "world":
            k = 6 * column[link]
            angular[:, k : k + 3] = sign * np.eye(3)
            linear[:, k : k + 3] = -sign * cross(at - place[link][0])  # omega x arm
            linear[:, k + 3 : k + 6] = sign * np.eye(3)

    def axis(name):
        return turned @ np.fromstring(joint.find(name).findtext("xyz"), sep=" ")

    match joint.get("type"):
        case "fixed":
            return np.concatenate([linear, angular])
        case "ball":
            return linear
        case "universal":  # the two axes stay at a right angle
            return np.concatenate([linear, [np.cross(axis("axis"), axis("axis2")) @ angular]])
        case "prismatic":
            along = axis("axis")
            across = np.linalg.svd(along[None])[2][1:]
            return np.concatenate([across @ linear, angular])
    raise AssertionError(joint.get("type"))


def test_the_joints_leave_the_nine_motions_of_the_robot(robot):
    design, metre, file = robot
    model = ElementTree.parse(file).getroot().find("model")
    place = frames(model)
    links = [link.get("name") for link in model.iterfind("link")]
    column = {name: k for k, name in enumerate(links)}
    count = 6 * len(links)
    joints = {joint.get("name"): joint for joint in model.iterfind("joint")}
    forbidden = np.concatenate([rows_of(joint, place, column, count) for joint in joints.values()])
    _, sigma, vectors = np.linalg.svd(forbidden)
    rank = int(np.sum(sigma > 1e-10 * sigma[0]))
    assert (count - rank, rank) == (9, len(forbidden))  # no equation too many
    assert sigma[rank - 1] > 1e-3 * sigma[0]
    allowed = vectors[rank:].T

    rates = []
    for leg in exported.LEGS:
        rod, cylinder = (6 * column[f"{leg}_{part}"] for part in ("rod", "cylinder"))
        (start, turned), (end, _) = place[f"{leg}_cylinder"], place[f"{leg}_rod"]
        along = turned[:, 2]
        carried = allowed[cylinder + 3 : cylinder + 6] - cross(end - start) @ allowed[cylinder : cylinder + 3]
        rates.append(along @ (allowed[rod + 3 : rod + 6] - carried))
    lc = float(np.linalg.norm(design.geometry.platform_external, axis=-1).mean())
    k = 6 * column["platform"]
    twist = np.concatenate([lc * metre * allowed[k : k + 3], allowed[k + 3 : k + 6]])
    expected = nd.jacobian(design.geometry, design.configuration, lc)
    assert_allclose(twist @ np.linalg.inv(rates), expected, rtol=0.0, atol=1e-11 * np.abs(expected).max())


def test_links_stand_where_the_robot_is(robot):
    design, metre, file = robot
    g, c = design.geometry, design.configuration
    place = frames(ElementTree.parse(file).getroot().find("model"))
    assert_allclose(place["platform"][0], c.position * metre, rtol=0.0, atol=1e-15)
    assert_allclose(place["platform"][1], c.rotation, rtol=0.0, atol=1e-14)
    ends = [(place[f"{leg}_cylinder"][0], place[f"{leg}_rod"][0]) for leg in exported.LEGS]
    lengths = [np.linalg.norm(b - a) for a, b in ends]
    assert_allclose(lengths, nd.leg_lengths(g, c) * metre, rtol=1e-14)
    for (a, b), leg in zip(ends, exported.LEGS, strict=True):
        assert_allclose(place[f"{leg}_rod"][1][:, 2], (b - a) / np.linalg.norm(b - a), rtol=0.0, atol=1e-14)
        assert_allclose(place[f"{leg}_cylinder"][1], place[f"{leg}_rod"][1], rtol=0.0, atol=0.0)


def test_the_library_of_the_format_takes_it(tmp_path):
    """`gz sdf` or `ign sdf` is libsdformat: it reads the file whole, resolves every frame and checks inertias."""
    tool = next((tool for tool in ("gz", "ign") if shutil.which(tool)), None)
    if tool is None:
        pytest.skip("needs gz or ign, the tools of libsdformat")

    def run_program(*words):
        return subprocess.run([tool, "sdf", *words], capture_output=True, text=True, check=False, timeout=60)

    names = list(DESIGNS)[: size(1, 2)]
    for name in names:
        checked = run_program("--check", str(nd.export(DESIGNS[name][0](), "sdf", tmp_path / "robot.sdf")))
        if checked.returncode and not run_program("--versions").stdout.strip():
            pytest.skip(f"{tool} has no command sdf here")
        assert checked.stdout == "Valid.\n", checked.stdout + checked.stderr
