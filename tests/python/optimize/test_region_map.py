"""The map of a region: at each place the worst of poses that are made here in numpy, by the definition of a region."""

from functools import cache
from itertools import product

import numpy as np
import numpy_model
import pytest
from limit_oracle import limits_of, margins, robot_of
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof.design.domains.region_poses import posed

LIMITS = {"radius_ratio": (None, 2.0), "base_cone": {"max_deg": 60}, "platform_cone": {"max_deg": 60}}
REGIONS = {
    "box": {"box": [0.1, 0.08, 0.05], "tilt_deg": 8, "unit": "zp"},
    "upright box": {"box": [0.1, 0.0, 0.05], "yaw_deg": 9, "unit": "zp"},
    "ball": {"ball": 0.4, "tilt_deg": 6, "internal_point": "held"},
    "cylinder": {"cylinder": [0.5, 0.2], "tilt_deg": 5, "yaw_deg": 5},
    "turns": {"tilt_deg": 15, "yaw_deg": 10},
    "path": {"path": [[-0.5, 0, 0], [0, 0.2, 0], [0.5, 0, 0]], "tilt_deg": 8},
}
AXES = {"upright box": ("x", "z"), "turns": ("tilt about x", "tilt about y"), "path": ("tilt about x", "tilt about y")}


@cache
def solved(name):
    study = nd.Study("symmetric", constraints=LIMITS, objective={"region": REGIONS[name]}, starts=2)
    return nd.optimize(study)


def nodes(region, at, axes):
    """Shifts of p, tilts and yaws (k, 3), (k, 2), (k,) of the poses at a place, in the unit of the region."""
    sixteen = np.arange(16) * np.pi / 8.0
    rim = [(0.0, 0.0), *zip(region.tilt * np.cos(sixteen), region.tilt * np.sin(sixteen), strict=True)]
    yaws = [-region.yaw, 0.0, region.yaw] if region.yaw else [0.0]
    if axes == ("tilt about x", "tilt about y"):
        corners = np.array(region.path or [(0.0, 0.0, 0.0)])
        far = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1))])
        along = np.linspace(0.0, far[-1], 41) if region.path else [0.0]
        shifts, tilts = [[np.interp(x, far, corners[:, k]) for k in range(3)] for x in along], [tuple(at)]
    else:
        high = region.box[2] if region.box else region.cylinder[1] if region.cylinder else 0.0
        high = np.sqrt(max(region.ball**2 - at @ at, 0.0)) if region.ball else high
        free = axes == ("x", "y")
        shifts = [(at[0], at[1], z) if free else (at[0], 0.0, at[1]) for z in ((-high, 0.0, high) if free else (0.0,))]
        tilts = rim if region.tilt else [(0.0, 0.0)]
    return tuple(map(np.array, zip(*product(shifts, tilts, yaws), strict=True)))


def poses_of(region, shifts, tilts, yaws):
    turns = Rotation.from_rotvec(np.pad(tilts, ((0, 0), (0, 1)))) * Rotation.from_euler("z", yaws[:, None])
    internal = shifts if region.internal_point == "shifted" else 0.0 * shifts
    rows = zip(shifts.tolist(), turns.as_rotvec().tolist(), internal.tolist(), strict=True)
    return tuple(nd.Pose(tuple(p), tuple(t), tuple(s), region.unit) for p, t, s in rows)


@pytest.mark.slow
@pytest.mark.parametrize("name", REGIONS)
def test_every_place_has_the_worst_of_its_poses(name):
    result = solved(name)
    best, region, found = result.best, result.study.objective.region, nd.region_map(result)
    assert found.axes == AXES.get(name, ("x", "y"))
    unit = best.configuration.position[2] if region.unit == "zp" and not found.of_angles else 1.0
    rng = np.random.default_rng(5)
    for i, j in rng.integers(0, found.horizontal.shape, (6, 2)):
        at = (np.array([found.horizontal[i, j], found.vertical[i, j]]) - found.home) / unit
        poses = poses_of(region, *nodes(region, at, found.axes))
        robot = robot_of(posed(result.study, poses), best.variables)
        kappa = numpy_model.condition_number(numpy_model.robot(robot.geometry, robot.poses), robot.length)
        assert found.condition_number[i, j] == pytest.approx(kappa.max(), rel=1e-7)
        shares = [margins(limit, robot).min() for limit in limits_of(result.study) if limit.name.endswith("cone")]
        assert found.margin[i, j] == pytest.approx(min(shares), abs=1e-6)
    assert found.worst == pytest.approx(best.objective, rel=1e-3)
    assert found.worst >= best.objective * (1.0 - 1e-9)


@pytest.mark.slow
def test_the_map_covers_the_region_and_its_ruling_poses():
    for name in REGIONS:
        found = nd.region_map(solved(name))
        low, high = found.outline.min(axis=0), found.outline.max(axis=0)
        for k, values in enumerate((found.horizontal, found.vertical)):
            assert [values.min(), values.max()] == pytest.approx([low[k], high[k]], abs=1e-9)
            assert (found.ruled[:, k] >= low[k] - 1e-9).all()
            assert (found.ruled[:, k] <= high[k] + 1e-9).all()
    assert found.over == "the path"
    assert nd.region_map(solved("cylinder")).over == "heights, tilts and yaws"


@pytest.mark.slow
def test_o_placed_anew_is_no_worse_than_shifted():
    region = {"box": [0.3, 0.3, 0.0], "tilt_deg": 5}
    maps = []
    for rule in ("shifted", "best"):
        study = nd.Study(
            variables={"a1": 0.0, "a2": 6.0, "b1": 3.0, "b2": 0.0, "zp": 5.0, "zs": 3.2},
            objective={"region": region | {"internal_point": rule}},
        )
        maps.append(nd.region_map(nd.optimize(study, starts=1)))
    shifted, best = maps
    assert best.horizontal.shape == (7, 7)
    assert (best.condition_number <= shifted.condition_number[::4, ::4].max()).all()


@pytest.mark.slow
@pytest.mark.parametrize("rule", ["shifted", "best"])
def test_limits_that_compare_poses_are_named_with_their_margin_over_the_region(rule):
    study = nd.Study(
        variables={"a1": 0.0, "a2": 6.0, "b1": 3.0, "b2": 0.0, "zp": 5.0, "zs": 3.2},
        constraints={"stroke_ratio": (None, 1.9), "stroke": (None, 3.0), "base_cone": {"max_deg": 60}},
        objective={"region": {"box": [0.3, 0.3, 0.1], "tilt_deg": 5, "internal_point": rule}},
    )
    result = nd.optimize(study)
    compared = nd.region_map(result).compared
    assert set(compared) == {"stroke_ratio", "stroke"}
    if rule == "best":
        assert all(np.isnan(margin) for margin in compared.values())
    else:
        of_sheet = {row.name: row.margin for row in nd.sheet(result).limits}
        assert compared == pytest.approx({name: of_sheet[name] for name in compared}, rel=1e-7)


def test_there_is_no_map_without_a_plane():
    assert nd.region_map(nd.optimize(nd.Study.paper(), starts=2)) is None
    line = nd.Study(variables={"a1": 0.0, "b2": 0.0}, objective={"region": {"box": [0.3, 0.0, 0.0]}})
    assert nd.region_map(nd.optimize(line, starts=2)) is None
    with pytest.raises(ValueError, match=r"^result: got"):
        nd.region_map(nd.Study.paper())
