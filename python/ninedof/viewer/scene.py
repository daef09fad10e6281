"""The machine as a scene of viser. Each part remembers what it drew, and is sent again only where that has changed."""

from __future__ import annotations

from typing import Any

import numpy as np

from ninedof.design.indices import LEGS
from ninedof.motion.rotations import to_quaternions
from ninedof.plot import style
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.sheet.clearance import leg_ends
from ninedof.support.arrays import Floats
from ninedof.viewer import shapes
from ninedof.viewer.numbers import Numbers
from ninedof.viewer.subject import robot_points

EXTENT = 4.0  # of any machine in the scene, whose lights and clipping planes are made for such sizes
RED = "#E0202F"
SLEEVE = 0.42  # share of a leg that is the wider cylinder
RADIUS = {"l": 0.030, "q": 0.023, "r": 0.023}  # of a rod, in the scene
LABEL_AT = {"l": 0.5, "q": 0.4, "r": 0.5}  # of the length of a leg
THICK = 0.045  # of a plate
O_COLOUR = "#FFC22E"
EDGES_DARK = "#C8D0D8"
GIZMO = 0.62


def rgb(colour: str) -> tuple[int, int, int]:
    """Return the three bytes of a colour such as "#0072B2"."""
    r, g, b = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return r, g, b


class Scene:
    """Draws a machine into a viser server. Lengths are scaled, so that machines of any unit fill the view."""

    def __init__(self, server: Any, size: float, dark: bool) -> None:
        self.scale = EXTENT / size
        self._server, self._api = server, server.scene
        self._sent: dict[Any, Any] = {}
        self._dark = dark
        self.held: set[tuple[str, int]] = set()
        """Handles in the hand of a user, with the client: that browser knows best where they are."""
        self._make()
        self.set_dark(dark)

    # --- what changes ---------------------------------------------------------------------------------------------

    def draw(self, g: Geometry, c: Configuration, found: Numbers) -> None:
        """Show a machine in a pose."""
        pose = self.scale * c.position, to_quaternions(c.rotation[None])[0]
        held = {name for name, _ in self.held}
        self._plate("/base", self.scale * np.vstack([g.base_external, g.base_internal]))
        self._plate("/platform", self.scale * np.vstack([g.platform_external, g.platform_internal]))
        for name in ("/platform", "/platform gizmo", "/platform axes"):
            if name not in held:
                self._set(name, position=pose[0], wxyz=pose[1])
        points = self.scale * robot_points(g, c)
        self._legs(g, c, found)
        self._joints(points, found)
        for name in ("/O gizmo", "/O", "/labels/O"):
            if name not in held:
                self._set(name, position=points[12])

    def draw_ellipsoid(self, c: Configuration, directions: Floats, semi_axes: Floats) -> None:
        """Show an ellipsoid about the platform, its longest axis an eighth of the machine; none if infinite."""
        longest = float(semi_axes.max())
        if not np.isfinite(longest) or longest <= 0.0:
            self._set("/ellipsoid", visible=False)
            return
        turn = directions * np.sign(np.linalg.det(directions))
        size = 0.125 * EXTENT * np.maximum(semi_axes / longest, 1e-3)
        quaternion = to_quaternions(turn[None])[0]
        self._set("/ellipsoid", position=self.scale * c.position, wxyz=quaternion, scale=tuple(size.tolist()))
        self._set("/ellipsoid", visible=True)

    def hide_ellipsoid(self) -> None:
        """Show no ellipsoid."""
        self._set("/ellipsoid", visible=False)

    def draw_body(self, vertices: Floats, faces: shapes.Faces) -> None:
        """Show a workspace, in the unit of the machine; none without faces."""
        self.remove_body()
        if len(faces):
            self._nodes["/workspace"] = self._api.add_mesh_simple(
                "/workspace",
                (self.scale * vertices).astype(np.float32),
                faces,
                color=rgb(style.SERIES[1]),
                opacity=0.32,
                side="double",
                cast_shadow=False,
                receive_shadow=False,
            )

    def remove_body(self) -> None:
        """Show no workspace."""
        if "/workspace" in self._nodes:
            self._nodes.pop("/workspace").remove()

    def draw_line(self, name: str, segments: Floats, colour: str) -> None:
        """Show segments of shape (n, 2, 3) in the unit of the machine, such as a path; none where n is 0."""
        if name in self._nodes:
            self._nodes.pop(name).remove()
        if len(segments):
            self._nodes[name] = self._api.add_line_segments(
                name, (self.scale * segments).astype(np.float32), colors=rgb(colour), thickness=0.012
            )

    def show(self, part: str, visible: bool) -> None:
        """Show or hide "labels", "handles" or "axes"."""
        for name in self._nodes:
            kind = {"labels": name.startswith("/labels"), "handles": "gizmo" in name, "axes": "axes" in name}
            if kind[part]:
                self._set(name, visible=visible)

    def set_dark(self, dark: bool) -> None:
        """Choose the colours of the ground."""
        cells, sections = ((62, 68, 76), (88, 96, 106)) if dark else ((222, 226, 230), (188, 195, 202))
        self._set("/ground", cell_color=cells, section_color=sections)
        for name in ("/base/edges", "/platform/edges"):
            if name in self._nodes:
                self._nodes[name].colors = np.array(rgb(EDGES_DARK if dark else style.INK), dtype=np.uint8)
        self._dark = dark

    # --- parts ----------------------------------------------------------------------------------------------------

    def _make(self) -> None:
        api = self._api
        api.set_up_direction("+z")
        # The lights of viser make pale colours white.
        api.configure_environment_map(None)
        api.configure_default_lights(enabled=False)
        api.add_light_hemisphere("/lights/sky", sky_color=(255, 255, 255), ground_color=(150, 155, 165), intensity=1.9)
        api.add_light_directional(
            "/lights/sun", intensity=2.0, wxyz=shapes.along(np.array([[-0.35, -0.55, 0.75]]))[0], cast_shadow=True
        )
        rods, balls = shapes.rod(), shapes.ball()
        still = {"batched_wxyzs": np.tile([1.0, 0.0, 0.0, 0.0], (18, 1)), "batched_positions": np.zeros((18, 3))}
        some = {name: values[:12] for name, values in still.items()}
        plain = {"cast_shadow": False, "receive_shadow": False}  # shadows here are a few large triangles
        grey = np.zeros((18, 3), dtype=np.uint8)
        self._nodes: dict[str, Any] = {
            "/legs": api.add_batched_meshes_simple(
                "/legs", *rods, **still, batched_scales=np.ones((18, 3)), batched_colors=grey, lod="off", **plain
            ),
            "/joints": api.add_batched_meshes_simple(
                "/joints", *balls, **some, batched_scales=np.ones((12, 3)), batched_colors=grey[:12], lod="off", **plain
            ),
            "/O": api.add_mesh_simple("/O", 0.062 * balls[0], balls[1], color=rgb(O_COLOUR), **plain),
            "/ellipsoid": api.add_mesh_simple(
                "/ellipsoid", *balls, color=rgb(O_COLOUR), opacity=0.45, visible=False, **plain
            ),
            "/ground": api.add_grid("/ground", 3.0 * EXTENT, 3.0 * EXTENT, cell_size=0.25, section_size=1.0),
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
            size = 1.3 if name == "O" else 1.1
            anchor = "bottom-left" if name == "O" else "center-center"
            self._nodes[f"/labels/{name}"] = api.add_label(
                f"/labels/{name}", name, anchor=anchor, font_screen_scale=size
            )

    def _plate(self, name: str, joints: Floats) -> None:
        key = joints.tobytes()
        if self._sent.get((name, "joints")) == key:
            return
        self._sent[name, "joints"] = key
        thickness, colour = (THICK, style.MUTED) if name == "/base" else (-THICK, style.PLATFORM)
        vertices, faces = shapes.plate(joints, thickness)
        lines = shapes.edges(joints, thickness)
        if name == "/base":
            self._set("/ground", position=np.array([0.0, 0.0, float(vertices[:, 2].min()) - 0.01]))
        outline = f"{name}/edges"  # a child: it moves with its plate
        if name in self._nodes and len(self._nodes[name].vertices) == len(vertices):
            self._nodes[name].vertices = vertices.astype(np.float32)
            self._nodes[name].faces = faces
            self._nodes[outline].points = lines.astype(np.float32)
            return
        for old in (outline, name):
            if old in self._nodes:
                self._nodes.pop(old).remove()
        self._sent = {k: v for k, v in self._sent.items() if k[0] != name or k[1] == "joints"}
        self._nodes[name] = self._api.add_mesh_simple(
            name,
            vertices.astype(np.float32),
            faces,
            color=rgb(colour),
            flat_shading=True,
            side="double",
            opacity=0.93,
            cast_shadow=False,
            receive_shadow=False,
        )
        edge = rgb(EDGES_DARK if self._dark else style.INK)
        self._nodes[outline] = self._api.add_line_segments(
            outline, lines.astype(np.float32), colors=edge, thickness=0.009
        )

    def _legs(self, g: Geometry, c: Configuration, found: Numbers) -> None:
        start, end = (self.scale * ends for ends in leg_ends(g, c))
        arms = end - start
        lengths = np.linalg.norm(arms, axis=1)
        safe = np.maximum(lengths, 1e-9)
        turn = shapes.along(arms / safe[:, None])
        thin = np.array([RADIUS[name[0]] for name in LEGS])
        # The sleeve of an upper leg sits on the platform, those of the others on the base.
        sizes = np.concatenate(
            [np.column_stack([1.6 * thin, 1.6 * thin, SLEEVE * safe]), np.column_stack([thin, thin, safe])]
        )
        colours = [RED if out else style.LEG_COLOURS[name[0]] for name, out in zip(LEGS, found.legs_out, strict=True)]
        rods = np.array([rgb(colour) for colour in colours])
        light = (0.45 * rods + 0.55 * 235.0).astype(np.uint8)
        red = np.array(found.legs_out)
        light[red] = rgb(RED)
        self._set(
            "/legs",
            batched_positions=np.tile(start, (2, 1)).astype(np.float32),
            batched_wxyzs=np.tile(turn, (2, 1)).astype(np.float32),
            batched_scales=sizes.astype(np.float32),
            batched_colors=np.concatenate([rods, light]).astype(np.uint8),
        )
        for name, a, arm in zip(LEGS, start, arms, strict=True):
            self._set(f"/labels/{name}", position=a + LABEL_AT[name[0]] * arm)

    def _joints(self, points: Floats, found: Numbers) -> None:
        colours = np.tile(rgb(style.INK), (12, 1))
        for body, leg in found.cones_passed:
            kind, i = divmod(leg, 3)  # l q r; joints are l and r of the base, l and q of the platform
            colours[(0 if body == "base" else 6) + (0 if kind == 0 else 3) + i] = rgb(RED)
        sizes = np.full((12, 3), 0.052)
        self._set(
            "/joints",
            batched_positions=points[:12].astype(np.float32),
            batched_scales=sizes.astype(np.float32),
            batched_colors=colours.astype(np.uint8),
        )

    def _set(self, name: str, **values: Any) -> None:
        """Send the values of a node that differ from those sent last."""
        for key, value in values.items():
            now = value.tobytes() if isinstance(value, np.ndarray) else value
            if self._sent.get((name, key)) != now:
                self._sent[name, key] = now
                setattr(self._nodes[name], key, value)

    def gizmo(self, name: str) -> Any:
        """Return the handle that moves "platform" or "O"."""
        return self._nodes[f"/{name} gizmo"]

    def hold(self, name: str, client: int, is_held: bool) -> None:
        """Note that the user of a client has taken or released a handle."""
        hand = (f"/{name} gizmo", client)
        if is_held:
            self.held.add(hand)
        else:
            self._release({hand})

    def release_all(self, client: int) -> None:
        """Release what a client holds, such as one that has left in the middle of a drag."""
        self._release({hand for hand in self.held if hand[1] == client})

    def _release(self, hands: set[tuple[str, int]]) -> None:
        self.held -= hands
        for node, _ in hands:
            for key in ("position", "wxyz"):
                self._sent.pop((node, key), None)
