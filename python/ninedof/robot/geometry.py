"""What is fixed once the robot is built. The class lives in the compiled core; this is its public place."""

from ninedof._core import Geometry

Geometry.__module__ = "ninedof"

__all__ = ["Geometry"]
