"""The geometry of the robot, whose class is defined in the compiled core, and the names of its nine legs."""

from __future__ import annotations

from ninedof._core import Geometry
from ninedof.support.arrays import Floats

Geometry.__module__ = "ninedof"

__all__ = ["TRIPLES", "Geometry", "triples"]

TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")


def triples(geometry: Geometry) -> dict[str, Floats]:
    """Return the four joint triples by name."""
    return {name: getattr(geometry, name) for name in TRIPLES}


LEGS = tuple(f"{kind}{i}" for kind in "lqr" for i in (1, 2, 3))
"""External, upper and lower internal: the order of `leg_lengths`."""
