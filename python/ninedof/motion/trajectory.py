"""Poses of the platform over time, from a shape or a CSV file."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from ninedof.motion.rotations import from_euler, from_quaternions, from_vectors, to_quaternions
from ninedof.robot.configuration import Configuration, require_single
from ninedof.support.arguments import cleaned, finite, path_argument, shown, vector, whole
from ninedof.support.arrays import Floats, as_floats, frozen
from ninedof.support.kept.files import csv_table, finite_or_nan, read_text, require_entries
from ninedof.support.structs import within
from ninedof.support.units import DEG, unit_argument

PLACE = ("x", "y", "z")
RELATIVE = ("x_rel", "y_rel", "z_rel")
QUATERNION = ("qw", "qx", "qy", "qz")
TURNS_REL = ("rx_rel", "ry_rel", "rz_rel")
TURNS_REL_DEG = tuple(name + DEG for name in TURNS_REL)
MATRIX = tuple(f"Q{i}{j}" for i in range(1, 4) for j in range(1, 4))
ROTATIONS: dict[tuple[str, ...], Callable[[Floats], Floats]] = {
    QUATERNION: from_quaternions,
    ("rx", "ry", "rz"): from_vectors,
    ("rx_deg", "ry_deg", "rz_deg"): lambda turns: from_vectors(np.radians(turns)),
    TURNS_REL: from_vectors,
    TURNS_REL_DEG: lambda turns: from_vectors(np.radians(turns)),
    ("yaw", "pitch", "roll"): lambda turns: from_euler(*turns.T),
    ("yaw_deg", "pitch_deg", "roll_deg"): lambda turns: from_euler(*np.radians(turns).T),
    MATRIX: lambda entries: entries.reshape(-1, 3, 3),
}
"""The columns that a file may have for the rotation, and their matrices (n, 3, 3)."""
COMPUTED = ("o_", "condition_number", "det_", "leg_margin", "margin_")  # other columns of `ninedof path`: not read
RADIANS = {"rx", "ry", "rz", *TURNS_REL, "yaw", "pitch", "roll"}
ONE_OF = "one of " + ", ".join(map(" ".join, ROTATIONS))
FEWEST = 3  # poses: accelerations need three
UNIT = 1e-3  # a quaternion may differ from unit length by rounding, not by more; a full turn too, relative
EXACT = 1e-9  # a matrix with more digits is taken as it is
TURNS = 3  # of a spiral
SHORTEST, LONGEST = 1e-300, 1e100  # of a motion: its times must differ, and their squares be numbers
MOST_POINTS = 10_000_000


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory:
    """Poses of the platform over time. Immutable.

    Parameters
    ----------
    time : array_like, shape (n,)
        Increasing, at least three. Unit of time of all rates.
    position : array_like, shape (n, 3)
        Origin p of the platform, length units, base frame.
    rotation : array_like, shape (n, 3, 3) or (3, 3), or scipy.spatial.transform.Rotation
        Q, platform frame to base frame. The identity by default.
    unit : str
        Name of the length unit, for screens, figures and the head of legs.csv: "mm", "cm", "m", "in" or "ft". "", none,
        by default. With one, times are in seconds: rates are labelled mm/s.

    Raises
    ------
    ValueError
        If a shape does not fit, a number is not finite, the time does not increase, or a matrix is no rotation.

    Examples
    --------
    >>> import ninedof as nd
    >>> home = nd.Configuration.neutral(3.9828, 2.4432)
    >>> nd.Trajectory.circle(home, radius=0.5, duration=2.0, points=201)
    <Trajectory of 201 poses, 0 to 2, closed>

    """

    time: Any
    """Shape (n,)."""
    position: Any
    """Shape (n, 3)."""
    rotation: Any = None
    """Shape (n, 3, 3)."""
    unit: str = ""
    """Name of the length unit; "" without one."""

    def __post_init__(self) -> None:
        """Check and freeze the arrays."""
        t = as_floats("time", self.time, ())
        if t.ndim != 1 or len(t) < FEWEST or not np.isfinite(t).all():
            raise ValueError(f"time: got {shown(self.time)}, expected at least {FEWEST} finite numbers")
        for k in np.flatnonzero(np.diff(t) <= 0.0)[:1]:
            raise ValueError(f"time: got {t[k + 1]:g} after {t[k]:g}, expected increasing times")
        poses = Configuration(self.position, self.rotation, np.zeros((len(t), 3)))
        if poses.shape != t.shape:
            raise ValueError(f"position: got poses of shape {poses.shape}, expected one for each of {len(t)} times")
        if np.isnan(poses.position).any() or np.isnan(poses.rotation).any():
            raise ValueError("position, rotation: got NaN, expected finite numbers")
        object.__setattr__(self, "unit", unit_argument(self.unit))
        for name, array in (("time", frozen(t)), ("position", poses.position), ("rotation", poses.rotation)):
            object.__setattr__(self, name, array)

    @classmethod
    def load(cls, path: str | os.PathLike[str], home: Configuration, unit: str = "") -> Self:
        """Read a CSV file whose first line names the columns.

        Parameters
        ----------
        path : path
            Columns, in any order, separated by commas: t, x, y, z, and for the rotation none, qw qx qy qz, rx ry rz (a
            rotation vector), yaw pitch roll (Euler angles, R_z R_y R_x) or Q11 to Q33 (the matrix by rows); angles in
            radians, at most a full turn, or in degrees with names such as rx_deg and yaw_deg. Positions and rotations
            are those of the platform in the base frame; x_rel y_rel z_rel are positions from that of `home`, along the
            base axes, and rx_rel ry_rel rz_rel the rotation vector from that of `home`, as regions have it. A line that
            begins with # is a comment. poses.csv of a run of `ninedof path` is such a file: its poses are read, O and
            all that was computed are not.
        home : Configuration
            Its rotation is taken where the file has none; the origin of what is relative.
        unit : str
            Name of the length unit of the robot. A file may name its own behind a column, "x (mm)"; another one is an
            error.

        Raises
        ------
        ValueError
            Naming file, line and column.

        """
        require_single("home", home)
        file = path_argument("path", path)
        text = read_text(file)
        with within(file, ": "):
            time, position, rotation = _poses(text, home, unit)
            return cls(time, position, home.rotation if rotation is None else rotation, unit)

    @classmethod
    def circle(
        cls, home: Configuration, radius: float, duration: float = 1.0, points: int = 1001, unit: str = ""
    ) -> Self:
        """Return a horizontal circle about the position of `home`, at constant speed and with its rotation."""
        t, u = _times(duration, points)
        around = finite("radius", radius) * _turning(2.0 * math.pi * u)
        around[-1] = around[0]
        return cls._from(home, unit, t, around)

    @classmethod
    def line(cls, home: Configuration, step: Any, duration: float = 1.0, points: int = 1001, unit: str = "") -> Self:
        """Return a straight line from `home` by `step` (x, y, z), from rest to rest (polynomial of degree five)."""
        t, u = _times(duration, points)
        return cls._from(home, unit, t, np.outer(_rest_to_rest(u), vector("step", step)))

    @classmethod
    def spiral(
        cls,
        home: Configuration,
        radius: float,
        height: float,
        duration: float = 1.0,
        points: int = 1001,
        unit: str = "",
    ) -> Self:
        """Return three turns from `home` outwards to `radius` and up by `height`, from rest to rest."""
        t, u = _times(duration, points)
        v, top = _rest_to_rest(u), [0.0, 0.0, finite("height", height)]
        turns = (finite("radius", radius) * v)[:, None] * _turning(2.0 * math.pi * TURNS * v)
        return cls._from(home, unit, t, turns + np.outer(v, top))

    @classmethod
    def _from(cls, home: Configuration, unit: str, time: Floats, shift: Floats) -> Self:
        require_single("home", home)
        return cls(time, home.position + shift, home.rotation, unit)

    def __len__(self) -> int:
        """Return the number of poses."""
        return len(self.time)

    @property
    def closed(self) -> bool:
        """Whether the last pose is the first, to 1e-12."""
        p, q = self.position, self.rotation
        same_place = np.allclose(p[0], p[-1], rtol=0.0, atol=1e-12 * np.abs(p).max())
        return same_place and np.allclose(q[0], q[-1], rtol=0.0, atol=1e-12)

    def __repr__(self) -> str:
        """Show the number of poses and the times."""
        ends = f"{self.time[0]:g} to {self.time[-1]:g}"
        return f"<Trajectory of {len(self)} poses, {ends}{', closed' if self.closed else ''}>"


def _times(duration: Any, points: Any) -> tuple[Floats, Floats]:
    """Return evenly spaced times from 0 to the duration, and the same from 0 to 1."""
    length = finite("duration", duration)
    if not SHORTEST < length <= LONGEST:
        expected = f"expected a number above {SHORTEST:g} and at most {LONGEST:g}"
        raise ValueError(f"duration: got {shown(duration)}, {expected}")
    t = np.linspace(0.0, length, whole("points", points, FEWEST, MOST_POINTS))
    return t, t / t[-1]


def _turning(angle: Floats) -> Floats:
    """Return horizontal unit vectors, shape (n, 3)."""
    return np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)


def _rest_to_rest(u: Floats) -> Floats:
    """Return the polynomial of degree five from 0 to 1 whose speed and acceleration are zero at both ends."""
    return np.asarray(u**3 * (10.0 + u * (6.0 * u - 15.0)))


def _poses(text: str, home: Configuration, unit: str) -> tuple[Floats, Floats, Floats | None]:
    """Return time (n,), position (n, 3) and rotation (n, 3, 3) of a file, None where it has no rotation.

    Columns that are relative are from `home`. ValueError names line and column, also where the file names another unit
    of lengths.
    """
    line, heads, body = csv_table(text)
    names = [name for name, _ in heads]
    for name, own in heads:
        if name in PLACE + RELATIVE and own and unit and own != unit:
            raise ValueError(f"line {line}, column {name}: got {own}, expected {unit} as in the design")
    place, turns = _pose_columns(f"line {line}", names)
    if len(body) < FEWEST:
        raise ValueError(f"got {len(body)} poses, expected at least {FEWEST}")
    require_entries(body, names)
    used = ("t", *place, *turns)
    columns = [names.index(name) for name in used]
    table = np.array([[finite_or_nan(row[column]) for column in columns] for _, row in body])
    for k, j in np.argwhere(np.isnan(table))[:1]:
        got = shown(body[k][1][columns[j]])
        raise ValueError(f"line {body[k][0]}, column {used[j]}: got {got}, expected a finite number")
    time, position, turn = table[:, 0], table[:, 1:4], np.ascontiguousarray(table[:, 4:])
    for k in np.flatnonzero(np.diff(time) <= 0.0)[:1]:
        got = f"got {time[k + 1]:g} after {time[k]:g}"
        raise ValueError(f"line {body[k + 1][0]}, column t: {got}, expected more")
    if turns == QUATERNION:
        size = np.linalg.norm(turn, axis=1)
        for k in np.flatnonzero(np.abs(size - 1.0) > UNIT)[:1]:
            raise ValueError(f"line {body[k][0]}, column qw: got a quaternion of length {size[k]:g}, expected 1")
    if turns and RADIANS.issuperset(turns):
        for k, j in np.argwhere(np.abs(turn) > 2.0 * math.pi * (1.0 + UNIT))[:1]:
            degrees = " ".join(name + DEG for name in turns)
            expected = f"expected radians, at most a full turn; degrees are in columns {degrees}"
            raise ValueError(f"line {body[k][0]}, column {turns[j]}: got {turn[k, j]:g}, {expected}")
    rotation = ROTATIONS[turns](turn) if turns else None
    if turns == MATRIX and rotation is not None:
        off = np.abs(np.swapaxes(rotation, 1, 2) @ rotation - np.eye(3)).max(axis=(1, 2))
        for k in np.flatnonzero((off > UNIT) | (np.linalg.det(rotation) < 0.0))[:1]:
            raise ValueError(f"line {body[k][0]}, column Q11: got no rotation in Q11 to Q33, expected one, to {UNIT:g}")
        if off.max() > EXACT:  # few digits
            rotation = from_quaternions(to_quaternions(rotation))
    if rotation is not None and turns in (TURNS_REL, TURNS_REL_DEG):
        rotation = rotation @ home.rotation
    return time, position + (home.position if place == RELATIVE else 0.0), rotation


def _pose_columns(where: str, names: Sequence[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the columns of position and rotation, none if it has none, or raise for missing and unknown columns."""
    place = RELATIVE if set(RELATIVE) & set(names) and not set(PLACE) & set(names) else PLACE
    needed = ("t", *place)
    if missing := [name for name in needed if name not in names]:
        got = cleaned(", ".join(names))
        raise ValueError(f"{where}: got columns {got}, no {', '.join(missing)}; expected {', '.join(needed)}")
    written = set(MATRIX) <= set(names)  # poses.csv of `ninedof path`, which has what was computed too
    others = [name for name in names if name not in needed and not (written and name.startswith(COMPUTED))]
    for columns in ((), *ROTATIONS):
        if set(others) == set(columns):
            return place, columns
    for name in others:
        if name in RELATIVE:
            raise ValueError(f"{where}, column {name}: got it beside x y z, expected x y z or x_rel y_rel z_rel")
        if not any(name in columns for columns in ROTATIONS):
            raise ValueError(f"{where}, column {shown(name)}: not known, expected t {' '.join(place)} and {ONE_OF}")
    raise ValueError(f"{where}: got {cleaned(' '.join(others))} as rotation, expected {ONE_OF}")
