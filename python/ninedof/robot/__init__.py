"""Geometry and configuration of the robot."""
