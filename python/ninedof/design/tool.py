"""The tool's frame on the platform, as a study file states it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ninedof.motion.rotations import from_vectors
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry, triples
from ninedof.support.arguments import Vector, instance, shown, vector
from ninedof.support.arrays import Floats, as_floats
from ninedof.support.structs import StudyTable, entry
from ninedof.support.text import short_repr
from ninedof.support.units import amount, degrees_of, unit_argument


@short_repr
@dataclass(frozen=True)
class Tool(StudyTable):
    """The frame in which the machine is used: its origin is the tool's point, p of every pose.

    Region, poses, paths, twists, loads, errors and the condition number belong to it. Limits of the design alone, such
    as the height zp, and O at home belong to the plates.

    Parameters
    ----------
    position : (3,) floats
        The tool's point in the platform's frame, in the unit of lengths. Zero by default: the plate's origin.
    rotation : (3,) floats
        Rotation vector from the platform's axes to the tool's, in radians. Zero by default.

    Examples
    --------
    >>> import ninedof as nd
    >>> tool = nd.Tool(position=(0.0, 0.0, -100.0))
    >>> tool.seen((0.0, 0.0, 20.0))  # a point of the platform
    (0.0, 0.0, 120.0)

    """

    position: Vector = entry(vector, (0.0, 0.0, 0.0))
    rotation: Vector = entry(vector, (0.0, 0.0, 0.0), angle=True)

    def __bool__(self) -> bool:
        """Whether it is another frame than the plate's."""
        return any(self.position) or any(self.rotation)

    @property
    def axes(self) -> Floats:
        """The tool's axes in the platform's frame: the columns of a rotation."""
        return np.asarray(from_vectors(np.array([self.rotation]))[0])

    def words(self, unit: str = "") -> list[str]:
        """Return where it is on the plate and how it is turned, a line each; none where it is the plate's frame."""
        at, turn = (", ".join(f"{x:.5g}" for x in three) for three in (self.position, map(degrees_of, self.rotation)))
        where = amount(f"({at})", unit_argument(unit))
        return [f"tool at {where}"] * bool(self) + [f"tool turned ({turn})°"] * any(self.rotation)

    def remark(self, unit: str = "") -> list[str]:
        """Return that p is the tool's point, a sentence; none where it is the plate's origin."""
        at = amount(f"({', '.join(f'{x:.5g}' for x in self.position)})", unit_argument(unit))
        of = "p, poses, speeds, moments and errors are of the tool's point"
        return [f"{of}, {at}, in the frame of the plate"] * bool(self)

    def seen(self, point: Vector) -> Vector:
        """Return a point of the platform's frame in the tool's frame."""
        return self.turned(np.subtract(vector("point", point), self.position))

    def turned(self, direction: Vector | Floats) -> Vector:
        """Return a direction of the platform's frame in the tool's frame."""
        x, y, z = (self.axes.T @ np.array(vector("direction", direction))).tolist()
        return x, y, z

    def own(self, points: ArrayLike) -> Floats:
        """Return points of the tool's frame, shape (..., 3), in the platform's frame."""
        own = as_floats("points", points, (3,))
        if not np.isfinite(own).all():
            raise ValueError(f"points: got {shown(points)}, expected finite coordinates")
        return np.asarray(own @ self.axes.T + np.array(self.position))

    def robot(self, geometry: Geometry, configuration: Configuration) -> tuple[Geometry, Configuration]:
        """Return a robot in the frame of its plate, and configurations of the plate, as the tool sees them."""
        c = instance("configuration", configuration, Configuration)
        seen = self._with_platform(geometry, lambda joints: (joints - np.array(self.position)) @ self.axes)
        if not self:
            return seen, c
        at = c.position + c.rotation @ np.array(self.position)
        return seen, Configuration(at, c.rotation @ self.axes, c.internal_point)

    def plates(self, geometry: Geometry) -> Geometry:
        """Return a robot as the tool sees it with each joint in the frame of its plate."""
        return self._with_platform(geometry, self.own)

    def _with_platform(self, geometry: Geometry, moved: Callable[[Floats], Floats]) -> Geometry:
        """Return a robot with other joints of the platform, where the tool has a frame of its own."""
        joints = triples(instance("geometry", geometry, Geometry))
        platform = {name: moved(points) for name, points in joints.items() if name.startswith("platform") and self}
        return Geometry(**(joints | platform)) if platform else geometry

    def plate(self, configuration: Configuration) -> Configuration:
        """Return where the plate's own frame is for configurations of the tool's; O as it is."""
        c = instance("configuration", configuration, Configuration)
        rotation = c.rotation @ self.axes.T if any(self.rotation) else c.rotation
        return Configuration(c.position - rotation @ np.array(self.position), rotation, c.internal_point)
