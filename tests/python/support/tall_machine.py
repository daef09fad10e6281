"""Bounds of a tall machine with a plate for a tool, millimetres."""

VARIABLES = {
    "base_external_radius": (100.0, 500.0),
    "base_internal_radius": (100.0, 500.0),
    "platform_external_radius": (180.0, 220.0),
    "platform_internal_radius": (50.0, 220.0),
    "zp": (300.0, 700.0),
    "zs": (50.0, 650.0),
}
