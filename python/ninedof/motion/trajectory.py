"""Poses of the platform over time."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from ninedof.motion.trajectory_file import FEWEST, read_trajectory
from ninedof.robot.configuration import Configuration, require_single
from ninedof.support.arguments import finite, shown, vector, whole
from ninedof.support.arrays import Floats, as_floats, frozen
from ninedof.support.units import unit_argument

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
        Name of the length unit, for screens, figures and the head of legs.csv: "mm", "cm", "m", "in" or "ft". None by
        default. With one, times are in seconds: rates are labelled mm/s.

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
        wrong = np.flatnonzero(~(np.diff(t) > 0.0))
        if len(wrong):
            k = int(wrong[0]) + 1
            raise ValueError(f"time: got {t[k]:g} after {t[k - 1]:g}, expected increasing times")
        poses = Configuration(self.position, self.rotation, np.zeros((len(t), 3)))
        if poses.shape != t.shape:
            raise ValueError(f"position: got poses of shape {poses.shape}, expected one for each of {len(t)} times")
        if not (np.isfinite(poses.position).all() and np.isfinite(poses.rotation).all()):
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
            Columns, in any order: t, x, y, z, and for the rotation none, qw qx qy qz, rx ry rz (a rotation vector) or
            yaw pitch roll (Euler angles, R_z R_y R_x); angles in radians, or in degrees with names such as rx_deg and
            yaw_deg. Positions and rotations are those of the platform in the base frame. A line that begins with #
            is a comment.
        home : Configuration
            Its rotation is taken where the file has none.
        unit : str
            Name of the length unit of the robot. A file may name its own behind a column, "x (mm)"; another one is an
            error.

        Raises
        ------
        ValueError
            Naming file, line and column.

        """
        require_single("home", home)
        time, position, rotation = read_trajectory(path, unit)
        try:
            return cls(time, position, home.rotation if rotation is None else rotation, unit)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from None

    @classmethod
    def circle(
        cls, home: Configuration, radius: float, duration: float = 1.0, points: int = 1001, unit: str = ""
    ) -> Self:
        """Return a horizontal circle about the position of `home`, at constant speed and with its rotation."""
        r, t, u = finite("radius", radius), *_times(duration, points)
        around = r * _turning(2.0 * math.pi * u)
        around[-1] = around[0]
        return cls._from(home, unit, t, around)

    @classmethod
    def line(cls, home: Configuration, step: Any, duration: float = 1.0, points: int = 1001, unit: str = "") -> Self:
        """Return a straight line from `home` by `step` (x, y, z), from rest to rest (polynomial of degree five)."""
        along, t, u = np.array(vector("step", step)), *_times(duration, points)
        return cls._from(home, unit, t, _rest_to_rest(u)[:, None] * along)

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
        r, h, (t, u) = finite("radius", radius), finite("height", height), _times(duration, points)
        v = _rest_to_rest(u)
        return cls._from(
            home, unit, t, (r * v)[:, None] * _turning(2.0 * math.pi * TURNS * v) + np.outer(v, [0.0, 0.0, h])
        )

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
        near = 1e-12 * float(np.abs(self.position).max())
        return bool(
            (np.abs(self.position[-1] - self.position[0]) <= near).all()
            and (np.abs(self.rotation[-1] - self.rotation[0]) <= 1e-12).all()
        )

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


def trajectory_argument(value: Any) -> Trajectory:
    """Return `value`, or raise unless it is a Trajectory."""
    if not isinstance(value, Trajectory):
        raise ValueError(f"trajectory: got {shown(value)}, expected a Trajectory")
    return value
