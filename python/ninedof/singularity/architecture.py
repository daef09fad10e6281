"""Designs that are singular at every pose, or at every position of one orientation."""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

from ninedof import _core
from ninedof.robot.configuration import single
from ninedof.robot.designs import HasRobot, robot_of, takes_designs
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import instance
from ninedof.support.arrays import Floats
from ninedof.support.text import short_repr
from ninedof.support.units import amount

NEAR = 0.01  # relative: what is nearer to a class is mentioned
EQUAL = 1e-9  # relative: triangles that differ by less are similar


class ArchitectureClass(StrEnum):
    """Causes that make a design singular at every pose; there are no others."""

    LOWER_ON_LINE = "lower_on_line"
    """The lower internal joints are on one line: det B is 0."""
    UPPER_ON_LINE = "upper_on_line"
    """The upper internal joints are on one line: det C is 0."""
    BASE_IN_POINT = "base_in_point"
    """The external joints on the base are in one point: det N is 0."""
    PLATFORM_IN_POINT = "platform_in_point"
    """The external joints on the platform are in one point: det N is 0."""
    LEGS_COINCIDE = "legs_coincide"
    """Two external legs have the same joints: det N is 0."""


WORDS = {
    ArchitectureClass.LOWER_ON_LINE: "its lower internal joints on one line (det B = 0)",
    ArchitectureClass.UPPER_ON_LINE: "its upper internal joints on one line (det C = 0)",
    ArchitectureClass.BASE_IN_POINT: "its external joints on the base in one point (det N = 0)",
    ArchitectureClass.PLATFORM_IN_POINT: "its external joints on the platform in one point (det N = 0)",
    ArchitectureClass.LEGS_COINCIDE: "external legs {0} and {1} with the same joints (det N = 0)",
}


@short_repr
class ArchitectureSingularity(NamedTuple):
    """The nearest design that is singular at every pose, and the orientations at which every position is nearly so."""

    kind: ArchitectureClass
    """The class of that design."""
    legs: tuple[int, ...]
    """The two external legs of `LEGS_COINCIDE`, from 1; else empty."""
    distance: float
    """Length by which at least one joint must move to get there, if none moves farther; above 0."""
    relative: float
    """The same over the longest side of the four triangles of joints."""
    dissimilarity: float
    """The distance of the two external triangles from similar ones, 0 to 1."""
    rotations: Floats
    """Rotations of the platform that make them as parallel as they can be, half a turn apart, shape (2, 3, 3)."""


@takes_designs
def architecture_singularity(geometry: Geometry) -> ArchitectureSingularity:
    """Return how far a design is from one that is singular at every pose.

    A `Geometry` that is singular at every pose cannot be made: the error names its class. Nor is any machine singular
    at every pose whose joints are all nearer than `distance` to those drawn. Theory of singularities, section
    Architecture singularities.

    Parameters
    ----------
    geometry : Geometry, Result or Design

    Returns
    -------
    ArchitectureSingularity
        With a `dissimilarity` of 0 the external triangles are similar, as those of every design with threefold symmetry
        are. At the two `rotations` they are parallel and det N is 0 at every position p, wherever O is.

    Examples
    --------
    >>> import ninedof as nd
    >>> nearest = nd.architecture_singularity(nd.Geometry.hexagonal(a1=0.0, a2=6.0, b1=3.0, b2=0.0))
    >>> nearest.kind, round(nearest.distance, 6)
    (<ArchitectureClass.UPPER_ON_LINE: 'upper_on_line'>, 1.299038)
    >>> nearest.dissimilarity < 1e-12
    True

    """
    instance("geometry", geometry, Geometry)
    nearest, similar = _core.nearest_architecture_singularity(geometry), _core.similar_triangles(geometry)
    kind = ArchitectureClass(nearest.kind)
    legs = (nearest.leg + 1, nearest.other + 1) if kind is ArchitectureClass.LEGS_COINCIDE else ()
    return ArchitectureSingularity(
        kind, legs, nearest.distance, nearest.relative, similar.dissimilarity, similar.rotations
    )


def architecture_sentences(design: HasRobot, unit: str) -> list[str]:
    """Return what is said of a design near one that is singular at every pose, or at every position as it is turned."""
    out, geometry = [], robot_of(design)
    near = architecture_singularity(geometry)
    if near.relative < NEAR:
        out.append(
            f"Nearly singular at every pose: joints moved by {amount(f'{near.distance:.3g}', unit)} give a machine "
            f"with {WORDS[near.kind].format(*near.legs)}."
        )
    residual = _core.homothety_residual(*single(geometry, design.configuration))
    if residual < NEAR:
        within, lost = (
            (f", to {EQUAL:g}", "0") if residual <= EQUAL else (f" within {100.0 * residual:.2g} %", "nearly 0")
        )
        out.append(
            f"The external triangles of base and platform are similar and parallel{within}: at this orientation det N "
            f"is {lost} at every position, wherever O is. Turned about z, the platform leaves it."
        )
    return out
