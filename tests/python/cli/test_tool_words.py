"""Every command about a machine with a tool says that p is the tool's point."""

import re
from dataclasses import replace

import pytest
from tooled import solved_in, tooled

import ninedof as nd

pytestmark = pytest.mark.usefixtures("few_samples")

STUDY = tooled(
    constraints={"leg_length": (1.0, 900.0)},
    loads={"wrenches": [[0.0, 0.0, 0.0, 0.0, 0.0, -90.0]]},
    tolerances={"legs": 0.01},
)
COMMANDS = {
    "optimize {0}/study.toml --no-figures --no-report --out {0}/again",
    "evaluate {0}/run",
    "path {0}/run --line 0.5 0 0 --points 51 --no-figures --no-report --out {0}/path",
    "workspace {0}/run --tolerance 0.5 --resolution 6 --points 500 --no-figures --out {0}/space",
    "forces {0}/run",
    "accuracy {0}/run",
    "stiffness {0}/run --leg-stiffness 100",
    "best {0}/run",
    "singularity {0}/run",
    "modes {0}/run",
    "modes {0}/run --lengths 500,500,500,300,300,300,300,300,300",
    "certify {0}/run --time 0.1",
    "failure {0}/run --no-pairs",
    "payload {0}/run --force 900",
    "sheet {0}/run",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return solved_in(tmp_path_factory.mktemp("tool"), STUDY)


@pytest.mark.parametrize("command", sorted(COMMANDS))
def test_p_is_the_tools_point(folder, run, command):
    """Silent, and a page said "position p of the platform": a moment was about which point?"""
    status, out, errors = run(command.format(folder))
    assert status in (0, 3), errors
    assert " ".join(out.split()).count("are of the tool's point, (0, 0, -10) mm, in the frame of the plate") == 1
    if command.startswith("workspace"):
        assert run(f"report {folder}/space")[0] == 0
        assert "positions of the tool" in (folder / "space" / "report.html").read_text()
    if command.startswith("evaluate"):  # the answer of the study first, and the other numbers say where they are
        assert out.index("Over the region") < out.index("At the neutral pose") < out.index("manipulability")


def test_all_poses_of_a_region_study_are_said_to_be_those_that_ruled(folder, run):
    """They were "poses of the study", and two that differ by a thousandth of the region had two numbers."""
    result = nd.load(folder / "run")
    ruled = result.region.poses
    assert len(ruled) > 0
    near = replace(ruled[0], position=tuple(x + 1e-4 for x in ruled[0].position))
    doubled = replace(result, region=replace(result.region, poses=(*ruled, near)))
    nd.save(doubled, folder / "doubled")
    assert len(nd.load(folder / "doubled").best.configurations) == len(ruled) + 2
    for name in ("run", "doubled"):
        out = " ".join(run(f"accuracy {folder / name} --all-poses")[1].split())
        count = (
            f"{len(ruled) + 1} poses" if name == "run" else f"{len(ruled) + 2} poses, {len(ruled) + 1} of them distinct"
        )
        assert out.startswith(f"{count}: the neutral one, pose 0, and those of the region that ruled its")
        last = max(int(number) for number in re.findall(r"pose (\d+): p = ", out))
        assert last < int(count.split()[0])
        assert "extremes over the region: ninedof sheet" in out


def test_axes_of_cones_are_in_the_frame_of_the_plate(run, tmp_path):
    """The study had (0, 0, -1), the workspace (0.258819, 0, -0.965926), which is the same in the frame of the tool."""
    cones = {"platform_cone": {"max_deg": 70.0, "axis": [0.0, 0.0, -1.0]}}
    turned = replace(STUDY, constraints=cones, tool={"position": [0.0, 0.0, -10.0], "rotation_deg": [0.0, 15.0, 0.0]})
    folder = solved_in(tmp_path, turned)
    line = f"workspace {folder}/run --tolerance 0.5 --resolution 6 --points 500 --no-figures"
    of_study = run(f"{line} --out {folder}/a")[1]
    assert "limit: platform cone 70 degrees about the axis (0, 0, -1), of the study" in " ".join(of_study.split())
    assert run(f"report {folder}/a")[0] == 0
    assert "platform cone 70 degrees about the axis (0, 0, -1)" in (folder / "a" / "report.html").read_text()
    given = run(f"{line} --platform-cone-deg 70 --platform-cone-axis 0 0 -1 --out {folder}/b")[1]
    assert "limit: platform cone 70 degrees about the axis (0, 0, -1)" in " ".join(given.split())
    a, b = (nd.load(folder / name) for name in "ab")
    assert b.volume == pytest.approx(a.volume, rel=1e-4)


def test_a_path_that_begins_turned_from_a_turned_neutral_pose_is_told(run, tmp_path):
    turned = replace(STUDY, tool={"position": [0.0, 0.0, -10.0], "rotation_deg": [0.0, 15.0, 0.0]})
    folder = solved_in(tmp_path, turned)
    rows = "".join(f"{t},{t},0,0,0,0,0\n" for t in range(3))
    for name in ("rx_rel_deg", "rx_deg"):
        heads = f"t,x_rel,y_rel,z_rel,{','.join(name.replace('x', axis, 1) for axis in 'xyz')}\n"
        (folder / f"{name}.csv").write_text(heads + rows)
        out = run(f"path {folder}/run {folder}/{name}.csv --no-figures --no-report --out {folder}/{name}")[1]
        told = "the path begins turned (0, -15, 0)° from the neutral pose" in " ".join(out.split())
        assert told == (name == "rx_deg")
