"""The geometry of the robot. The class is defined in the compiled core."""

from ninedof._core import Geometry

Geometry.__module__ = "ninedof"

__all__ = ["Geometry"]
