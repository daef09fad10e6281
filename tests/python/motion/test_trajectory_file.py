"""Files of poses over time: every way to give the rotation, and what is wrong in a bad one."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import ninedof as nd

HOME = nd.Configuration.neutral(4.0, 2.0, theta_z=0.3)
TIMES = np.linspace(0.0, 1.0, 7)
TURNS = Rotation.from_rotvec(np.random.default_rng(0).normal(size=(7, 3)) * 0.4)
PLACES = np.random.default_rng(1).normal(size=(7, 3))


def written(path, names, columns):
    rows = [",".join(names), *(",".join(map(repr, row)) for row in np.column_stack(columns).tolist())]
    path.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("names", "turns"),
    [
        ("qw qx qy qz", TURNS.as_quat()[:, [3, 0, 1, 2]]),
        ("rx ry rz", TURNS.as_rotvec()),
        ("rx_deg ry_deg rz_deg", np.degrees(TURNS.as_rotvec())),
        ("yaw pitch roll", TURNS.as_euler("ZYX")),
        ("yaw_deg pitch_deg roll_deg", TURNS.as_euler("ZYX", degrees=True)),
        ("Q11 Q12 Q13 Q21 Q22 Q23 Q31 Q32 Q33", TURNS.as_matrix().reshape(-1, 9)),
    ],
)
def test_every_way_to_give_a_rotation(tmp_path, names, turns):
    path = written(tmp_path / "path.csv", ["t", "x", "y", "z", *names.split()], [TIMES, PLACES, turns])
    result = nd.Trajectory.load(path, HOME)
    assert (result.time == TIMES).all()
    assert (result.position == PLACES).all()
    assert result.rotation == pytest.approx(TURNS.as_matrix(), abs=1e-14)


NINE = ["t", "x", "y", "z", *"Q11 Q12 Q13 Q21 Q22 Q23 Q31 Q32 Q33".split()]


@pytest.mark.parametrize("decimals", [4, 6, 9, 12])
def test_matrices_of_few_digits_are_rotations(tmp_path, decimals):
    turns = TURNS.as_matrix().reshape(-1, 9).round(decimals)
    result = nd.Trajectory.load(written(tmp_path / "path.csv", NINE, [TIMES, PLACES, turns]), HOME)
    assert result.rotation == pytest.approx(TURNS.as_matrix(), abs=2.0 * 10.0**-decimals)
    assert np.swapaxes(result.rotation, 1, 2) @ result.rotation == pytest.approx(
        np.broadcast_to(np.eye(3), (len(turns), 3, 3)), abs=1e-9
    )


@pytest.mark.parametrize("change", [np.diag([1.0, 1.0, -1.0]), np.diag([1.0, 1.01, 1.0])], ids=["mirror", "stretch"])
def test_a_matrix_that_turns_nothing_names_its_line(tmp_path, change):
    turns = TURNS.as_matrix()
    turns[1] = turns[1] @ change
    with pytest.raises(ValueError, match=r"line 3, column Q11: got no rotation in Q11 to Q33, expected one"):
        nd.Trajectory.load(written(tmp_path / "path.csv", NINE, [TIMES, PLACES, turns.reshape(-1, 9)]), HOME)


def test_columns_in_any_order_comments_and_no_rotation(tmp_path):
    path = tmp_path / "path.csv"
    path.write_bytes(b"\xef\xbb\xbf# made by hand\r\nz, t ,y,x\r\n4,0,0,1\r\n\r\n4,1,0,2\r\n# here\r\n4,2,0,3\r\n")
    result = nd.Trajectory.load(path, HOME)
    assert result.position.tolist() == [[1, 0, 4], [2, 0, 4], [3, 0, 4]]
    assert (result.rotation == HOME.rotation).all()
    assert result.rotation[0, 1, 0] == pytest.approx(math.sin(0.3))


@pytest.mark.parametrize("end", ["", " (mm)"])
def test_positions_from_that_of_home(tmp_path, end):
    home = nd.Configuration([1.0, -2.0, 4.0], HOME.rotation, [0.0, 0.0, 2.0])
    turns = np.degrees(TURNS.as_rotvec())  # rotations stay in the base frame
    names = ["t", *(name + end for name in ("x_rel", "y_rel", "z_rel")), "rx_deg", "ry_deg", "rz_deg"]
    path = written(tmp_path / "path.csv", names, [TIMES, PLACES, turns])
    result = nd.Trajectory.load(path, home, "mm")
    assert result.position == pytest.approx(PLACES + home.position, abs=1e-15)
    assert result.rotation == pytest.approx(TURNS.as_matrix(), abs=1e-14)
    if end:
        with pytest.raises(ValueError, match="column x_rel: got mm, expected m as in the design"):
            nd.Trajectory.load(path, home, "m")


@pytest.mark.parametrize(("end", "size"), [("", 1.0), ("_deg", 180.0 / math.pi)])
def test_turns_from_that_of_home(tmp_path, end, size):
    names = ["t", "x", "y", "z", *(name + end for name in ("rx_rel", "ry_rel", "rz_rel"))]
    path = written(tmp_path / "path.csv", names, [TIMES, PLACES, size * TURNS.as_rotvec()])
    result = nd.Trajectory.load(path, HOME)
    assert result.rotation == pytest.approx(TURNS.as_matrix() @ HOME.rotation, abs=1e-14)


GOOD = "t,x,y,z\n0,0,0,4\n1,0,0,4\n2,0,0,4\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "path.csv: got an empty file"),
        ("t,x,y\n0,0,0\n", "path.csv: line 1: got columns t, x, y, no z; expected t, x, y, z"),
        ("t,x,y,z\n0,0,0,4\n", "path.csv: got 1 poses, expected at least 3"),
        ("0,0,0,4\n1,0,0,4\n", "path.csv: line 1: got the number 0, expected the names of the columns"),
        (GOOD.replace("1,0,0,4", "1,0,wide,4"), "path.csv: line 3, column y: got 'wide', expected a finite number"),
        (GOOD.replace("1,0,0,4", "1,0,nan,4"), "path.csv: line 3, column y: got 'nan', expected a finite number"),
        (GOOD.replace("1,0,0,4", "1,0,,4"), "path.csv: line 3, column y: got '', expected a finite number"),
        (GOOD.replace("1,0,0,4", "1,0,4"), "path.csv: line 3: got 3 entries, expected 4 (t, x, y, z)"),
        (GOOD.replace("2,0,0,4", "1,0,0,4"), "path.csv: line 4, column t: got 1 after 1, expected more"),
        (GOOD.replace("t,x,y,z", "t,x,y,z,x"), "path.csv: line 1, column x: got it twice"),
        (GOOD.replace("t,x,y,z", "t,x,y,z,rol"), "path.csv: line 1, column 'rol': not known"),
        (GOOD.replace("t,x,y,z", "t,x,y,z,yaw_deg,pitch"), "path.csv: line 1: got yaw_deg pitch as rotation"),
        (GOOD.replace("t,x,y,z", "t,x,y_rel,z"), "line 1: got columns t, x, y_rel, z, no y; expected t, x, y, z"),
        (
            GOOD.replace("t,x,y,z", "t,x,y,z,z_rel"),
            "line 1, column z_rel: got it beside x y z, expected x y z or x_rel",
        ),
        (GOOD.replace("t,x,y,z", "t,x_rel,y_rel,z_re"), "no z_rel; expected t, x_rel, y_rel, z_rel"),
        (
            "# from a spreadsheet\n" + GOOD.replace(",", ";"),
            "line 2: got columns separated by semicolons, expected commas",
        ),
        (GOOD.replace(",", "\t"), "path.csv: line 1: got columns separated by tabs, expected commas between columns"),
        (
            "t,x,y,z,rx,ry,rz\n0,0,0,4,0,6.28319,0\n1,0,0,4,0,0,-6.4\n2,0,0,4,0,0,45\n",
            "line 3, column rz: got -6.4, expected radians, at most a full turn; degrees are in columns rx_deg ry_deg",
        ),
        (
            "t,x,y,z,yaw,pitch,roll\n0,0,0,4,0,0,30\n1,0,0,4,0,0,0\n2,0,0,4,0,0,0\n",
            "line 2, column roll: got 30, expected radians, at most a full turn; degrees are in columns yaw_deg",
        ),
        (
            "t,x,y,z,qw,qx,qy,qz\n0,0,0,4,1,0,0,0\n1,0,0,4,2,0,0,0\n2,0,0,4,1,0,0,0\n",
            "path.csv: line 3, column qw: got a quaternion of length 2, expected 1",
        ),
    ],
)
def test_bad_files(tmp_path, text, words):
    path = tmp_path / "path.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError) as error:  # noqa: PT011 - the whole message is compared
        nd.Trajectory.load(path, HOME)
    message = str(error.value)
    assert words in message
    assert "\n" not in message


def test_a_missing_file_and_a_binary_one(tmp_path):
    with pytest.raises(ValueError, match="cannot be read"):
        nd.Trajectory.load(tmp_path / "none.csv", HOME)
    (tmp_path / "image.csv").write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(ValueError, match="cannot be read"):
        nd.Trajectory.load(tmp_path / "image.csv", HOME)


def test_a_file_may_name_the_unit_of_lengths(tmp_path):
    path = tmp_path / "path.csv"
    path.write_text("t,x (mm),y (mm),z (mm)\n0,0,0,1\n1,1,0,1\n2,2,0,1\n")
    home = nd.Configuration([0.0, 0.0, 1.0], internal_point=[0.0, 0.0, 0.5])
    for unit in ("", "mm"):
        assert nd.Trajectory.load(path, home, unit).position[1].tolist() == [1.0, 0.0, 1.0]
    with pytest.raises(ValueError, match="column x: got mm, expected m as in the design"):
        nd.Trajectory.load(path, home, "m")


def test_the_poses_that_a_path_wrote_are_a_path(tmp_path):
    """Whatever was computed, as margins without limits, which are infinite."""
    g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    path = nd.Trajectory(TIMES, 0.1 * PLACES + HOME.position, HOME.rotation, "mm")
    nd.save(nd.follow(g, path, HOME), tmp_path / "run")
    again = nd.Trajectory.load(tmp_path / "run" / "poses.csv", HOME, "mm")
    for name in ("time", "position", "rotation"):
        assert (getattr(again, name) == getattr(path, name)).all()
    text = (tmp_path / "run" / "poses.csv").read_text()
    broken = tmp_path / "broken.csv"
    broken.write_text(text.replace("Q33", "Q34"))
    with pytest.raises(ValueError, match="column 'Q34': not known"):
        nd.Trajectory.load(broken, HOME)
    broken.write_text(text.replace(text.splitlines()[1].split(",")[4], "2.0", 1))
    with pytest.raises(ValueError, match="rotation"):
        nd.Trajectory.load(broken, HOME, "mm")
