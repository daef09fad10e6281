"""The two plates in plan, each in its own frame: joints, outline, and the sides or radii that describe them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ninedof.robot.geometry import Geometry
from ninedof.robot.plates import outlines
from ninedof.support.arrays import Floats

SAME = 1e-9
"""Lengths that differ by less, relative to the plate, are equal."""


class Side(NamedTuple):
    """A side of a hexagonal plate, and the two joints that it connects."""

    name: str
    start: Floats
    end: Floats


class Plate(NamedTuple):
    """One plate, seen from +z of its frame."""

    title: str
    joints: dict[str, Floats]
    """E1 E2 E3, the external ones, and I1 I2 I3, the internal ones; shape (3,)."""
    outline: Floats
    """Corners of the convex hull of the joints in plan, shape (n, 2); none where they lie on a line in plan."""
    sides: list[Side]
    """a1 and a2, or b1 and b2, where the plate is a hexagon of the paper; without those of length 0."""
    radii: list[float]
    """Of the circles about the origin on which the external and the internal joints lie, where they do; each once."""

    @property
    def size(self) -> float:
        """The largest distance of a joint from the origin, in plan."""
        return float(max(np.linalg.norm(joint[:2]) for joint in self.joints.values()))


def plates_of(geometry: Geometry) -> tuple[Plate, Plate]:
    """Return the base and the platform."""
    return (
        _plate("Base", geometry.base_external, geometry.base_internal, ("a1", "a2")),
        _plate("Platform", geometry.platform_external, geometry.platform_internal, ("b1", "b2")),
    )


def _plate(title: str, external: Floats, internal: Floats, names: tuple[str, str]) -> Plate:
    joints = {f"{kind}{i + 1}": row for kind, rows in (("E", external), ("I", internal)) for i, row in enumerate(rows)}
    flat = np.vstack([external, internal]) * [1.0, 1.0, 0.0]
    faces = outlines(flat) if np.ptp(flat) > 0.0 else []
    outline = faces[0][:, :2] if faces else np.empty((0, 2))
    return Plate(title, joints, outline, _sides(external, internal, names), _radii(external, internal))


def _sides(external: Floats, internal: Floats, names: tuple[str, str]) -> list[Side]:
    """Return the sides of a hexagon: the first to the internal joint of the same number, the second to the one before.

    The joints lie on one circle about the origin in one plane z = constant, and each of the two sides has one length.
    """
    before = np.roll(internal, 1, axis=0)
    all_joints = np.vstack([external, internal])
    distances = [np.linalg.norm(external - other, axis=1) for other in (internal, before)]
    scale = SAME * float(np.abs(all_joints).max())
    on_one = [np.linalg.norm(all_joints[:, :2], axis=1), all_joints[:, 2], *distances]
    if any(np.ptp(values) > scale for values in on_one):
        return []
    ends = (internal[0], before[0])
    return [
        Side(name, external[0], end)
        for name, length, end in zip(names, distances, ends, strict=True)
        if length[0] > scale
    ]


def _radii(external: Floats, internal: Floats) -> list[float]:
    found: list[float] = []
    for joints in (external, internal):
        radii = np.linalg.norm(joints[:, :2], axis=1)
        limit = SAME * float(radii.max())
        if np.ptp(radii) <= limit and not any(abs(radii[0] - other) <= limit for other in found):
            found.append(float(radii[0]))
    return found
