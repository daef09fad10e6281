"""Figures in space: the manipulator, ellipsoids, the body of a workspace."""
