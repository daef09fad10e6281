"""The joints by name, in their own frames and at the neutral pose, and the legs between them."""

from __future__ import annotations

from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import TRIPLES, Geometry, triples
from ninedof.support.arrays import Floats

P, O = "p", "O"
"""Origin of the platform frame, and the internal point."""

LEGS = (
    *((f"l{i}", f"base_external_{i}", f"platform_external_{i}") for i in (1, 2, 3)),
    *((f"q{i}", f"platform_internal_{i}", O) for i in (1, 2, 3)),
    *((f"r{i}", f"base_internal_{i}", O) for i in (1, 2, 3)),
)
"""Name, first and second end of each leg, in the order of `leg_lengths`."""

JOINTS = tuple(f"{name}_{i}" for name in TRIPLES for i in (1, 2, 3))


def own_frame(geometry: Geometry) -> dict[str, Floats]:
    """Return the twelve joints in the frame of their plate, by name."""
    rows = [point for points in triples(geometry).values() for point in points]
    return dict(zip(JOINTS, rows, strict=True))


def base_frame(geometry: Geometry, configuration: Configuration) -> dict[str, Floats]:
    """Return the twelve joints, p and O in the base frame."""
    p, q = configuration.position, configuration.rotation
    joints = {
        name: p + q @ point if name.startswith("platform") else point for name, point in own_frame(geometry).items()
    }
    return {**joints, P: p, O: configuration.internal_point}
