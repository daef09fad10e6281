"""The lights and the nodes of the scene that are there from the beginning."""

from __future__ import annotations

from typing import Any

import numpy as np

from ninedof.robot.leg_names import LEGS
from ninedof.viewer import shapes

EXTENT = 4.0  # of any machine in the scene, whose lights and clipping planes are made for such sizes
O_COLOUR = "#FFC22E"
GIZMO = 0.62
GROUND, CELL = 8.0, 0.5  # sides of the ground


def rgb(colour: str) -> tuple[int, int, int]:
    """Return the three bytes of a colour such as "#0072B2"."""
    r, g, b = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return r, g, b


def light(api: Any) -> None:
    """Set the lights. Those of viser make pale colours white."""
    api.set_up_direction("+z")
    api.configure_environment_map(None)
    api.configure_default_lights(enabled=False)
    api.add_light_hemisphere("/lights/sky", sky_color=(255, 255, 255), ground_color=(150, 155, 165), intensity=1.9)
    # Nothing casts a shadow: a light that could would cost three maps of them in every picture.
    turn = shapes.along(np.array([[-0.35, -0.55, 0.75]]))[0]
    api.add_light_directional("/lights/sun", intensity=2.0, wxyz=turn, cast_shadow=False)


def nodes(api: Any) -> dict[str, Any]:
    """Make the nodes, by name; they are put in their places later."""
    rods, balls = shapes.rod(), shapes.ball()
    still = {"batched_wxyzs": np.tile([1.0, 0.0, 0.0, 0.0], (18, 1)), "batched_positions": np.zeros((18, 3))}
    some = {name: values[:12] for name, values in still.items()}
    plain = {"cast_shadow": False, "receive_shadow": False}  # shadows here are a few large triangles
    grey = np.zeros((18, 3), dtype=np.uint8)
    made: dict[str, Any] = {
        "/legs": api.add_batched_meshes_simple(
            "/legs", *rods, **still, batched_scales=np.ones((18, 3)), batched_colors=grey, lod="off", **plain
        ),
        "/joints": api.add_batched_meshes_simple(
            "/joints", *balls, **some, batched_scales=np.ones((12, 3)), batched_colors=grey[:12], lod="off", **plain
        ),
        "/O": api.add_mesh_simple("/O", 0.062 * balls[0], balls[1], color=rgb(O_COLOUR), **plain),
        "/ellipsoid": api.add_mesh_simple(
            "/ellipsoid", *shapes.ball(14), color=rgb(O_COLOUR), opacity=0.45, visible=False, **plain
        ),
        # Lines, not the grid of viser, whose program runs for every pixel of the ground.
        "/ground": api.add_line_segments(
            "/ground", _ground(), colors=(0, 0, 0), thickness=1.0, thickness_units="screen"
        ),
        "/base axes": api.add_frame("/base axes", axes_length=0.4, axes_radius=0.012, origin_radius=0.018),
        "/platform axes": api.add_frame("/platform axes", axes_length=0.25, axes_radius=0.007, origin_radius=0.01),
        "/platform gizmo": api.add_transform_controls(
            "/platform gizmo", scale=GIZMO, line_width=2.0, depth_test=False, opacity=0.85
        ),
        "/O gizmo": api.add_transform_controls(
            "/O gizmo", scale=0.6 * GIZMO, line_width=2.0, disable_rotations=True, depth_test=False, opacity=0.85
        ),
    }
    for name in (*LEGS, "O"):
        size, anchor = (1.3, "bottom-left") if name == "O" else (1.1, "center-center")
        made[f"/labels/{name}"] = api.add_label(f"/labels/{name}", name, anchor=anchor, font_screen_scale=size)
    return made


def _ground() -> np.ndarray[Any, np.dtype[np.float32]]:
    """Return the lines of a grid as segments."""
    half = 0.5 * GROUND
    at = np.arange(-half, half + 0.5 * CELL, CELL)
    ends = np.array([-half, half])
    along = np.stack([np.stack([np.full(2, x), ends, np.zeros(2)], axis=1) for x in at])
    return np.concatenate([along, along[:, :, [1, 0, 2]]]).astype(np.float32)
