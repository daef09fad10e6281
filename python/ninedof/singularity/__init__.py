"""Singular configurations: mechanisms, margins and the distance to the nearest."""
