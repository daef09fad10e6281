"""Leg forces, stiffness, ellipsoids and accuracy."""
