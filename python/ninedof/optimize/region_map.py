"""The worst condition number and the least margin of the limits at each place of a region of poses."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.design.limit_numbers import SPREADS
from ninedof.design.limits import kind_of
from ninedof.design.pose import Pose
from ninedof.design.region import Region
from ninedof.design.region_outline import section_outline
from ninedof.design.region_poses import Placing, configurations_at, places_o
from ninedof.motion.rotations import from_vectors
from ninedof.optimize.result import Result
from ninedof.robot.configuration import Configuration
from ninedof.sheet.pose_limits import pose_limits
from ninedof.support.arguments import instance
from ninedof.support.arrays import Floats

NAMES = ("x", "y", "z", "tilt about x", "tilt about y", "yaw")
SIDE, RINGS, TURNS = 33, 16, 72  # of the raster: points along a side of a box; rings of a round one, and points of each
COARSE, COARSE_RINGS, COARSE_TURNS = (
    7,
    3,
    12,
)  # where O is placed anew at every pose, which takes a thousand times as long
TILTS, ALONG = 16, 41  # directions of the greatest tilt; places along a path


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
    """The least margin of a limit at a pose, negative where it is passed; None if the study has no such limit."""
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
    i, j = plane
    neutral, placing = best.configuration, result._placing()
    places = _places(region, plane, placing is not None)
    at, words = _others(region, plane, places)
    count = int(np.prod(at.shape[:-1]))
    c = _configurations(region, neutral, placing, at.reshape(count, 6))
    length = best.characteristic_length
    kappa = np.asarray(condition_number(best.geometry, c, length)).reshape(at.shape[:-1]).max(axis=-1)
    rows = [one for one in pose_limits(study, best.geometry, c, neutral, length) if one.name not in SPREADS]
    shares = [one.margin for one in rows if kind_of(one.name) != "sign"]
    margin = np.min(shares, axis=0).reshape(at.shape[:-1]).min(axis=-1) if shares else None
    unit = _scale(region, neutral) if i < 3 else 1.0
    home = neutral.position[[i, j]] if i < 3 else np.zeros(2)
    ruled = [
        _in_plane(pose, plane, region.size_at(neutral))
        for pose in (() if result.region is None else result.region.poses)
    ]
    return RegionMap(
        axes=(NAMES[i], NAMES[j]),
        over=words,
        horizontal=home[0] + unit * places[..., 0],
        vertical=home[1] + unit * places[..., 1],
        condition_number=kappa,
        margin=margin,
        outline=_outline(region, plane, neutral),
        home=home,
        ruled=home + np.array(ruled).reshape(-1, 2),
        worst=max(float(kappa.max()), *best.conditions),
        unit=study.unit,
        poses=count,
    )


def _scale(region: Region, neutral: Configuration) -> float:
    return region.size_at(neutral)


def _plane(region: Region) -> tuple[int, int] | None:
    """Return the two coordinates of a map: x and y, the two with the largest extents, the tilts, or None."""
    reach = region.reach
    free = [k for k in range(3) if reach[k] > 0.0 and region.path is None]
    if len(free) >= 2:
        i, j = (0, 1) if {0, 1} <= set(free) else sorted(free)
        return i, j
    return (3, 4) if region.tilt > 0.0 else None


def _places(region: Region, plane: tuple[int, int], coarse: bool) -> Floats:
    """Return the places of the plane, shape (m, n, 2), in the unit of the region: a raster, or rings of a disc."""
    reach = [region.reach[k] for k in plane]
    if plane == (3, 4) or region.box is None:
        rings, turns = (COARSE_RINGS, COARSE_TURNS) if coarse else (RINGS, TURNS)
        radius, turn = np.meshgrid(np.linspace(0.0, reach[0], rings + 1), np.linspace(0.0, 2.0 * np.pi, turns + 1))
        return np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=-1)
    side = COARSE if coarse else SIDE
    return np.stack(np.meshgrid(*(np.linspace(-r, r, side) for r in reach), indexing="ij"), axis=-1)


def _others(region: Region, plane: tuple[int, int], places: Floats) -> tuple[Floats, str]:
    """Return coordinates of poses (m, n, k, 6) at each place, and the other coordinates in words."""
    reach, on_map = region.reach, plane != (3, 4)
    height = np.full(places.shape[:2], reach[3 - sum(plane)] if on_map else 0.0)
    if region.ball is not None and on_map:
        height = np.sqrt(np.maximum(region.ball**2 - (places**2).sum(axis=-1), 0.0))
    free = [k for k in range(3) if reach[k] > 0.0 and k not in plane]
    shifts = [-1.0, 0.0, 1.0] if free else [0.0]
    if region.path is not None:
        free, shifts, height = [0], np.linspace(-1.0, 1.0, ALONG).tolist(), np.ones(places.shape[:2])
    elif not on_map and free:
        height = np.full(places.shape[:2], reach[free[0]])
    turn = np.linspace(0.0, 2.0 * np.pi, TILTS + 1)[:-1]
    tilted = on_map and region.tilt > 0.0
    tilts = [(0.0, 0.0), *zip(np.cos(turn), np.sin(turn), strict=True)] if tilted else [(0.0, 0.0)]
    yaws = [-1.0, 0.0, 1.0] if region.yaw > 0.0 else [0.0]
    rows = [(s, *t, y) for s in shifts for t in tilts for y in yaws]
    share = np.array(rows)
    at = np.zeros((*places.shape[:2], len(rows), 6))
    for k in free:
        at[..., k] = height[..., None] * share[:, 0]
    at[..., 3:5] = region.tilt * share[:, 1:3]
    at[..., 5] = region.yaw * share[:, 3]
    at[..., list(plane)] = places[:, :, None]
    names = [("the path" if region.path else "heights" if free == [2] else "positions") * bool(free)]
    names += ["tilts" * tilted, "yaws" * (region.yaw > 0.0)]
    names = [name for name in names if name]
    return at, " and ".join([", ".join(names[:-1])] * (len(names) > 1) + names[-1:])


def _configurations(region: Region, neutral: Configuration, placing: Placing | None, at: Floats) -> Configuration:
    if placing is None or places_o(region):
        return configurations_at(region, neutral, at)[1]
    return placing(np.ascontiguousarray(at))[0]


def _in_plane(pose: Pose, plane: tuple[int, int], unit: float) -> list[float]:
    """Return the shift of a pose in the plane of a map, or its tilt: the rest of its rotation is about z."""
    if plane != (3, 4):
        return [unit * pose.position[k] for k in plane]
    x, y, z = from_vectors(np.array([pose.rotation]))[0, :, 2].tolist()
    angle = math.atan2(math.hypot(x, y), z)
    return [-y * angle / max(math.hypot(x, y), 1e-300), x * angle / max(math.hypot(x, y), 1e-300)]


def _outline(region: Region, plane: tuple[int, int], neutral: Configuration) -> Floats:
    if plane == (3, 4):
        turn = np.linspace(0.0, 2.0 * math.pi, 97)
        return region.tilt * np.column_stack([np.cos(turn), np.sin(turn)])
    fixed = 3 - sum(plane)
    lines = section_outline(region, neutral, fixed, float(neutral.position[fixed]))
    assert lines is not None  # the plane of the neutral pose
    return lines
