"""Plates: the convex hull of their six joints, flat or solid, and in plan as drawings have them."""

from __future__ import annotations

import math
from itertools import combinations, pairwise
from typing import NamedTuple

import numpy as np

from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats
from ninedof.support.units import amount

_TOLERANCE = 1e-9  # relative to the size of the plate


def points_of(g: Geometry, c: Configuration) -> Floats:
    """Return the joints of the base, those of the platform in the base frame, each external first, and O: (13, 3)."""
    carried = c.position + np.vstack([g.platform_external, g.platform_internal]) @ c.rotation.T
    return np.vstack([g.base_external, g.base_internal, carried, c.internal_point])


def distinct(points: Floats) -> Floats:
    """Return the points without those that coincide with an earlier one, such as coupled joints."""
    size = float(np.ptp(points, axis=0).max())
    out: list[Floats] = []
    for point in points:
        if all(np.linalg.norm(point - other) > _TOLERANCE * size for other in out):
            out.append(point)
    return np.array(out)


def outlines(joints: Floats) -> list[Floats]:
    """Return the faces of the convex hull of a few points, each as an ordered outline (m, 3).

    One polygon if the points (n, 3) lie in a plane (joints inside it are left out), else the faces of a solid; they may
    not all lie on one line. All planes through three points are tested: twenty for six joints.
    """
    points = distinct(joints)
    size = float(np.ptp(points, axis=0).max())
    faces: dict[tuple[int, ...], Floats] = {}
    for triple in combinations(range(len(points)), 3):
        a, b, c = points[list(triple)]
        normal = np.cross(b - a, c - a)
        length = float(np.linalg.norm(normal))
        if length <= _TOLERANCE * size**2:
            continue
        normal /= length
        heights = (points - a) @ normal
        in_plane = np.abs(heights) <= _TOLERANCE * size
        above, below = bool(np.any(heights[~in_plane] > 0)), bool(np.any(heights[~in_plane] < 0))
        if not (above and below):
            faces.setdefault(tuple(np.flatnonzero(in_plane).tolist()), _outline(points[in_plane], normal))
    return list(faces.values())


def _outline(points: Floats, normal: Floats) -> Floats:
    """Return the corners of the convex hull of points in a plane, in order (Andrew's monotone chain)."""
    across = points[1] - points[0]
    across = across / np.linalg.norm(across)
    flat = np.column_stack([points @ across, points @ np.cross(normal, across)])
    slack = _TOLERANCE * float(np.ptp(flat, axis=0).max()) ** 2
    order = np.lexsort((flat[:, 1], flat[:, 0])).tolist()

    def chain(indices: list[int]) -> list[int]:
        out: list[int] = []
        for index in indices:
            while len(out) > 1:
                (ax, ay), (bx, by) = flat[out[-1]] - flat[out[-2]], flat[index] - flat[out[-2]]
                if ax * by - ay * bx > slack:  # a turn to the left
                    break
                out.pop()
            out.append(index)
        return out[:-1]

    return points[chain(order) + chain(order[::-1])]


ROUNDED = 1e-9  # radians: directions that differ by less are one
SAME = 1e-9
"""Lengths that differ by less, relative to the plate, are equal."""


class Plate(NamedTuple):
    """One plate, seen from +z of its frame."""

    title: str
    joints: dict[str, Floats]
    """E1 E2 E3, the external ones, and I1 I2 I3, the internal ones; shape (3,)."""
    outline: Floats
    """Corners of the convex hull of the joints in plan, shape (n, 2); none where they lie on a line in plan."""
    sides: dict[str, tuple[Floats, Floats]]
    """The ends of a1 and a2, or b1 and b2, where the plate is a hexagon of the paper; without those of length 0."""
    radii: list[float]
    """Of the circles about the origin on which the external and the internal joints lie, where they do; each once."""

    @property
    def size(self) -> float:
        """The largest distance of a joint from the origin, in plan."""
        return float(max(np.linalg.norm(joint[:2]) for joint in self.joints.values()))

    @property
    def angles(self) -> list[tuple[float, float]]:
        """The angles that tell directions of joints on a circle: from +x to the first joint, from that to the next.

        From start to end against the clock, in radians; without those of 0, none of a plate without a circle.
        """
        angles = _directions(self)
        ends = list(pairwise([0.0, *angles[:2]])) if self.radii else []
        return [(start, end) for start, end in ends if end - start > ROUNDED]

    def heights(self, unit: str) -> list[str]:
        """Return the heights of each triple of joints, in words; none where all are 0."""
        if max(abs(joint[2]) for joint in self.joints.values()) <= SAME * self.size:
            return []
        out = []
        for kind in "EI":
            values = [joint[2] for name, joint in self.joints.items() if name[0] == kind]
            one = max(values) - min(values) <= SAME * self.size
            numbers = (f"{round(z / self.size, 9) * self.size + 0.0:.5g}" for z in values[: 1 if one else 3])
            out.append(f"{kind}1 to {kind}3 at z = {amount(', '.join(numbers), unit)}")
        return out

    def centres(self) -> dict[tuple[float, ...], list[str]]:
        """Return the joints by their place, one place where some coincide."""
        places: dict[tuple[float, ...], list[str]] = {}
        for name, joint in self.joints.items():
            near = next((at for at in places if np.linalg.norm(joint - at) <= SAME * self.size), None)
            places.setdefault(near or tuple(joint.tolist()), []).append(name)
        return places


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
    radii: list[float] = []
    for circle in np.linalg.norm(flat.reshape(2, 3, 3)[..., :2], axis=2):
        same = SAME * float(circle.max())
        if np.ptp(circle) <= same and not any(abs(circle[0] - other) <= same for other in radii):
            radii.append(float(circle[0]))
    return Plate(
        title, joints, faces[0][:, :2] if faces else np.empty((0, 2)), _sides(external, internal, names), radii
    )


def _sides(external: Floats, internal: Floats, names: tuple[str, str]) -> dict[str, tuple[Floats, Floats]]:
    """Return the sides of a hexagon: the first to the internal joint of the same number, the second to the one before.

    The joints lie on one circle about the origin in one plane z = constant, and each of the two sides has one length.
    """
    others, joints = (internal, np.roll(internal, 1, axis=0)), np.vstack([external, internal])
    lengths = [np.linalg.norm(external - other, axis=1) for other in others]
    scale = SAME * float(np.abs(joints).max())
    if any(np.ptp(values) > scale for values in (np.linalg.norm(joints[:, :2], axis=1), joints[:, 2], *lengths)):
        return {}
    sides = zip(names, others, lengths, strict=True)
    return {name: (external[0], other[0]) for name, other, length in sides if length[0] > scale}


def turn_words(configuration: Configuration) -> list[str]:
    """Return how the platform is turned about z, in words; none where it is tilted too."""
    q = configuration.rotation
    if q[2, 2] < 1.0 - SAME:
        return []
    return [f"theta_z = {round(math.degrees(math.atan2(q[1, 0], q[0, 0])), 9) + 0.0:.5g}°"]


def free_angles(plate: Plate) -> Floats:
    """Return the middles of the gaps between the directions of the joints, the widest first, dimensioned sides last."""
    angles = np.array(_directions(plate))
    gaps = np.diff(np.append(angles, angles[0] + math.tau))
    middles = angles + 0.5 * gaps
    outward = [(start + end)[:2] for start, end in plate.sides.values()]
    beside_sides = [any(np.cos(angle - math.atan2(y, x)) > 0.99 for x, y in outward) for angle in middles]
    beside_axes = -np.abs(np.sin(2.0 * middles)).round(6)
    return np.asarray(middles[np.lexsort((beside_axes, -gaps.round(6), np.array(beside_sides)))])


def _directions(plate: Plate) -> list[float]:
    """Return the directions of the joints from the origin, each once, from 0 to a full turn."""
    angles = sorted(math.atan2(y, x) % math.tau for x, y, _ in plate.joints.values())
    angles = [0.0 if math.tau - angle < ROUNDED else angle for angle in angles]
    return sorted(angle for k, angle in enumerate(angles) if all(abs(angle - one) > ROUNDED for one in angles[:k]))
