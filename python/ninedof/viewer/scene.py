"""The machine as a scene of viser. Each part remembers what it drew, and is sent again only where that has changed."""

from __future__ import annotations

from collections.abc import Set
from typing import Any

import numpy as np

from ninedof.design.region import Region
from ninedof.design.region_outline import region_lines
from ninedof.motion.rotations import to_quaternions
from ninedof.plot import style
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.robot.leg_names import LEGS
from ninedof.support.arrays import Floats
from ninedof.viewer import shapes
from ninedof.viewer.html import RED
from ninedof.viewer.numbers import Numbers
from ninedof.viewer.parts import EXTENT, light, nodes, rgb
from ninedof.viewer.subject import robot_points

SLEEVE = 0.42  # share of a leg that is the wider cylinder
RADIUS = {"l": 0.030, "q": 0.023, "r": 0.023}  # of a rod, in the scene
LABEL_AT = {"l": 0.5, "q": 0.4, "r": 0.5}  # of the length of a leg
THICK = 0.045  # of a plate
EDGES_DARK = "#C8D0D8"


class Scene:
    """Draws a machine into a viser server. Lengths are scaled, so that machines of any unit fill the view."""

    def __init__(self, server: Any, size: float, dark: bool) -> None:
        self.scale = EXTENT / size
        self._server, self._api = server, server.scene
        self._sent: dict[Any, Any] = {}
        self._hidden: set[str] = set()
        light(self._api)
        self._nodes = nodes(self._api)
        self.set_dark(dark)

    # --- what changes ---------------------------------------------------------------------------------------------

    def draw(self, g: Geometry, c: Configuration, found: Numbers, held: Set[str]) -> None:
        """Show a machine in a pose; nodes that are held stay where they are."""
        pose = self.scale * c.position, to_quaternions(c.rotation[None])[0]
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

    def draw_region(self, region: Region | None, home: Configuration) -> None:
        """Show the positions of a region about the neutral pose as lines, again where that has changed."""
        key = home.position.tobytes()
        if region is not None and self._sent.get("/region") != key:
            self._sent["/region"] = key
            lines = region_lines(region, home)  # none of turns alone
            segments = [np.stack([line[:-1], line[1:]], axis=1) for line in lines]
            self.draw_lines("/region", np.concatenate([np.empty((0, 2, 3)), *segments]), style.REGION)

    def draw_lines(self, name: str, segments: Floats, colour: str) -> None:
        """Show segments of shape (n, 2, 3) in the unit of the machine, such as a path; none where n is 0."""
        if name in self._nodes:
            self._nodes.pop(name).remove()
        if len(segments):
            self._nodes[name] = self._api.add_line_segments(
                name,
                (self.scale * segments).astype(np.float32),
                colors=rgb(colour),
                thickness=0.012,
                visible=name[1:] not in self._hidden,
            )

    def show(self, part: str, visible: bool) -> None:
        """Show or hide "labels", "handles", "axes" or "region"."""
        (self._hidden.discard if visible else self._hidden.add)(part)
        for name in self._nodes:
            kind = {"labels": "/labels" in name, "handles": "gizmo" in name, "axes": "axes" in name}
            if kind.get(part, name == f"/{part}"):
                self._set(name, visible=visible)

    def set_dark(self, dark: bool) -> None:
        """Choose the colours of the ground."""
        self._nodes["/ground"].colors = np.array((64, 71, 80) if dark else (205, 210, 216), dtype=np.uint8)
        for name in ("/base/edges", "/platform/edges"):
            if name in self._nodes:
                self._nodes[name].colors = np.array(rgb(EDGES_DARK if dark else style.INK), dtype=np.uint8)
        self._dark = dark

    # --- parts ----------------------------------------------------------------------------------------------------

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
            cast_shadow=False,
            receive_shadow=False,
        )
        edge = rgb(EDGES_DARK if self._dark else style.INK)
        self._nodes[outline] = self._api.add_line_segments(
            outline, lines.astype(np.float32), colors=edge, thickness=0.009
        )

    def _legs(self, g: Geometry, c: Configuration, found: Numbers) -> None:
        start, end = (self.scale * ends for ends in _leg_ends(g, c))
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

    def forget(self, name: str) -> None:
        """Let a node take its place again with the next picture, such as a handle that was let go."""
        for key in ("position", "wxyz"):
            self._sent.pop((name, key), None)


def _leg_ends(g: Geometry, c: Configuration) -> tuple[Floats, Floats]:
    """Return where the nine legs start and end, shape (..., 9, 3), base frame: base to platform, platform or base to O.

    External legs go from base to platform, upper internal ones from the platform to O, lower ones from the base to O.
    """
    turned, p = np.swapaxes(c.rotation, -1, -2), c.position[..., None, :]
    external, internal = p + g.platform_external @ turned, p + g.platform_internal @ turned
    o = np.broadcast_to(c.internal_point[..., None, :], external.shape)
    low, inner = (np.broadcast_to(triple, external.shape) for triple in (g.base_external, g.base_internal))
    return np.concatenate([low, internal, inner], axis=-2), np.concatenate([external, o, o], axis=-2)
