"""The geometry of the robot. The class is defined in the compiled core."""

from ninedof._core import Geometry
from ninedof.support.arrays import Floats

Geometry.__module__ = "ninedof"

__all__ = ["TRIPLES", "Geometry", "triples"]

TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")


def triples(geometry: Geometry) -> dict[str, Floats]:
    """Return the four joint triples by name."""
    return {name: getattr(geometry, name) for name in TRIPLES}
