"""The worst condition number and the least margin of the limits at each place of a region of poses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ninedof import _core
from ninedof.conditioning.conditioning import condition_number
from ninedof.design.domains.poses import Pose
from ninedof.design.domains.region import Region, circle, section_outline
from ninedof.design.domains.region_poses import configurations_at, o_is_placed, placing_of
from ninedof.design.limit_numbers import SPREADS, compared
from ninedof.design.limits import kind_of
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.motion.rotations import from_vectors
from ninedof.optimize.result import Result
from ninedof.proof.point_rule import tilt_and_yaw
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.path_limits import limits_at_poses
from ninedof.support.arguments import instance
from ninedof.support.arrays import Floats

NAMES = ("x", "y", "z", "tilt about x", "tilt about y", "yaw")
FINE, COARSE = (33, 16, 72), (7, 3, 12)
"""Of the raster: points along a side of a box; rings of a round one, and points of each. Coarse where O is placed anew
at every pose, which takes a thousand times as long."""
TILTS = (3, 4)  # the plane of the tilts
DIRECTIONS, ALONG = 16, 41  # of the greatest tilt; places along a path
SAMPLES = 10_000  # poses at which the lengths of the legs are looked at before descents


@dataclass(frozen=True, eq=False)
class RegionMap:
    """The worst of a region at each place of a plane, over all other coordinates of its poses.

    Lengths in the unit of the study, in base axes; angles in radians.
    """

    axes: tuple[str, str]
    """Names of the two coordinates: "x" and "y", or "tilt about x" and "tilt about y"."""
    over: str
    """The other coordinates of the region, in words: "heights and tilts"; "" if there are none."""
    horizontal: Floats
    """First coordinate of each place, shape (m, n)."""
    vertical: Floats
    """Second coordinate."""
    condition_number: Floats
    """The worst at each place, infinite where singular."""
    margin: Floats | None
    """The least margin of a limit at a pose, negative where it is violated; None if the study has no such limit."""
    compared: dict[str, float]
    """The limits that compare poses, which no place of the map has: the least margin of each over the region, NaN where
    O is placed anew at every pose."""
    outline: Floats
    """Of the region in this plane, points (k, 2)."""
    home: Floats
    """The neutral pose in this plane, shape (2,)."""
    ruled: Floats
    """The poses that ruled the study in this plane, shape (r, 2)."""
    worst: float
    """The worst condition number, of the map and of the poses that ruled."""
    unit: str
    """Of the lengths."""
    poses: int
    """Poses evaluated."""

    def __repr__(self) -> str:
        """Show its plane and its worst value."""
        kappa = f"{float(self.condition_number.max()):.6f}"
        return f"<RegionMap: {' and '.join(self.axes)}, worst condition number {kappa} of {self.poses} poses>"

    @property
    def of_angles(self) -> bool:
        """Whether the coordinates are angles."""
        return self.axes[0] not in "xyz"


def region_map(result: Result) -> RegionMap | None:
    """Return a map of the worst condition number over the region of a study, of its best design.

    Of a region with positions in a plane the map is over x and y, or over its two largest extents: at each place the
    worst over the third coordinate, the tilts and the yaws of a sample: the ends and the middle of heights and yaws, no
    tilt and 16 directions of the greatest one. Of other regions with tilts it is over the tilt. Where O is placed anew
    at every pose, the raster is coarse.

    Parameters
    ----------
    result : Result
        Of a study with a region.

    Returns
    -------
    RegionMap or None
        None without a region or a design, and for a region that has neither a plane of positions nor tilts.

    Examples
    --------
    >>> import ninedof as nd
    >>> region = nd.Region(box=(0.4, 0.4, 0.2), tilt=0.1)
    >>> study = nd.Study(variables={"a1": 0.0, "b2": 0.0}, objective={"region": region})
    >>> nd.region_map(nd.optimize(study, starts=4)).axes
    ('x', 'y')

    """
    study, best = instance("result", result, Result).study, result.best
    region = study.objective.region
    if region is None or best is None or (plane := _plane(region)) is None:
        return None
    g, neutral, length = best.geometry, best.configuration, best.characteristic_length
    placing = placing_of(result, neutral)
    places = _places(region, plane, placing is not None)
    at, words = _poses_at(region, plane, places)
    shape, rows = at.shape[:-1], at.reshape(-1, 6)
    c = configurations_at(region, neutral, rows) if placing is None else placing(rows)[0]
    kappa = np.asarray(condition_number(g, c, length)).reshape(shape).max(axis=-1)
    limits = [one for one in limits_at_poses(study, g, c, neutral, length) if one.name not in SPREADS]
    shares = [one.margin for one in limits if kind_of(one.name) != "sign"]
    size = region.size_at(neutral)
    unit, home = (1.0, np.zeros(2)) if plane == TILTS else (size, neutral.position[list(plane)])
    ruled = () if result.region is None else result.region.poses
    listed = leg_lengths(g, best.configurations[1 : 1 + len(study.objective.poses)])
    return RegionMap(
        axes=(NAMES[plane[0]], NAMES[plane[1]]),
        over=words,
        horizontal=home[0] + unit * places[..., 0],
        vertical=home[1] + unit * places[..., 1],
        condition_number=kappa,
        margin=np.min(shares, axis=0).reshape(shape).min(axis=-1) if shares else None,
        compared=_compared(study, g, neutral, length, listed),
        outline=_outline(region, plane, neutral),
        home=home,
        ruled=home + _in_plane(ruled, plane, size),
        worst=max(float(kappa.max()), *best.conditions),
        unit=study.unit,
        poses=len(rows),
    )


def _compared(study: Study, g: Geometry, neutral: Configuration, length: float, listed: Floats) -> dict[str, float]:
    """Return the least margin of each limit that compares poses, over the region and with lengths at listed ones."""
    region, out = study.objective.region, dict[str, float]()
    assert region is not None
    if o_is_placed(study):
        return dict.fromkeys(compared(study), math.nan)
    if not compared(study):
        return {}
    ends = np.concatenate([_core.leg_lengths_over(g, neutral, region.for_core(), SAMPLES), listed])
    middle = configurations_at(region, neutral, np.zeros((1, 6)))
    for one in limits_at_poses(study, g, middle, neutral, length, ends):
        if one.name in SPREADS:
            out[one.name] = min(float(one.margin[0]), out.get(one.name, math.inf))
    return out


def _plane(region: Region) -> tuple[int, int] | None:
    """Return the two coordinates of a map: x and y, the two with the largest extents, the tilts, or None."""
    free = [k for k in range(3) if region.reach[k] > 0.0 and region.path is None]
    if len(free) >= 2:
        return free[0], free[1]
    return TILTS if region.tilt > 0.0 else None


def _places(region: Region, plane: tuple[int, int], coarse: bool) -> Floats:
    """Return the places of the plane, shape (m, n, 2), in the unit of the region: a raster, or rings of a disc."""
    side, rings, turns = COARSE if coarse else FINE
    reach = [region.reach[k] for k in plane]
    if plane == TILTS or region.box is None:
        radius, turn = np.meshgrid(np.linspace(0.0, reach[0], rings + 1), np.linspace(0.0, 2.0 * np.pi, turns + 1))
        return np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=-1)
    return np.stack(np.meshgrid(*(np.linspace(-r, r, side) for r in reach), indexing="ij"), axis=-1)


def _poses_at(region: Region, plane: tuple[int, int], places: Floats) -> tuple[Floats, str]:
    """Return coordinates of poses (m, n, k, 6) at each place, and in words those beside the two of the plane."""
    on_map, path = plane != TILTS, region.path is not None
    free = [0] if path else [k for k in range(3) if region.reach[k] > 0.0 and k not in plane]  # one at most
    extent = np.full(places.shape[:2], 1.0 if path or not free else region.reach[free[0]])
    if region.ball is not None and on_map:
        extent = np.sqrt(np.maximum(region.ball**2 - (places**2).sum(axis=-1), 0.0))
    turn = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS + 1)[:-1]
    tilted = on_map and region.tilt > 0.0
    shares = [
        (shift, *tilt, yaw)
        for shift in (np.linspace(-1.0, 1.0, ALONG if path else 3) if free else [0.0])
        for tilt in [(0.0, 0.0), *zip(np.cos(turn), np.sin(turn), strict=True)][: None if tilted else 1]
        for yaw in ([-1.0, 0.0, 1.0] if region.yaw > 0.0 else [0.0])
    ]
    share = np.array(shares)
    at = np.zeros((*places.shape[:2], len(share), 6))
    for k in free:
        at[..., k] = extent[..., None] * share[:, 0]
    at[..., 3:5] = region.tilt * share[:, 1:3]
    at[..., 5] = region.yaw * share[:, 3]
    at[..., list(plane)] = places[:, :, None]
    names = ["the path" if path else "heights" if free == [2] else "positions"] * len(free)
    names += ["tilts"] * tilted + ["yaws"] * (region.yaw > 0.0)
    return at, " and ".join([", ".join(names[:-1])] * (len(names) > 1) + names[-1:])


def _in_plane(poses: Sequence[Pose], plane: tuple[int, int], unit: float) -> Floats:
    """Return the shifts of poses in the plane of a map, or their tilts, shape (n, 2)."""
    if plane == TILTS:
        return tilt_and_yaw(from_vectors(np.reshape([pose.rotation for pose in poses], (-1, 3))))[0]
    return unit * np.reshape([pose.position for pose in poses], (-1, 3))[:, plane]


def _outline(region: Region, plane: tuple[int, int], neutral: Configuration) -> Floats:
    if plane == TILTS:
        return region.tilt * circle()[:, :2]
    fixed = 3 - sum(plane)
    lines = section_outline(region, neutral, fixed, float(neutral.position[fixed]))
    assert lines is not None  # the plane of the neutral pose
    return lines
