"""Geometry and configuration: what is built, and where it stands."""
