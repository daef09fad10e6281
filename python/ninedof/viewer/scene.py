"""The machine as a scene of viser, which sends a value again only where it has changed."""

from __future__ import annotations

from collections.abc import Sequence, Set
from typing import Any

import numpy as np

from ninedof.design.domains.region import region_lines
from ninedof.motion.rotations import to_quaternions
from ninedof.plot import style
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import LEGS
from ninedof.robot.plates import points_of
from ninedof.statics.statics import Ellipsoid
from ninedof.support.arrays import Floats
from ninedof.viewer import shapes
from ninedof.viewer.body import Body
from ninedof.viewer.designs import DesignPicture, add_picture
from ninedof.viewer.numbers import Numbers
from ninedof.viewer.panel import RED
from ninedof.viewer.state import State

STARTS, ENDS = [0, 1, 2, 9, 10, 11, 3, 4, 5], [6, 7, 8, 12, 12, 12, 12, 12, 12]  # of legs, in `points_of`
EXTENT = 4.0  # of any machine in the scene, whose lights and clipping planes are made for such sizes
GROUND, CELL = 8.0, 0.5  # sides of the ground
GIZMOS = {"platform": 0.62, "O": 0.37}  # lengths of the arrows of the handles
LEAST = 0.12  # of handles that would be on each other
SLEEVE = 0.42  # share of a leg that is the wider cylinder
RADIUS = {"l": 0.030, "q": 0.023, "r": 0.023}  # of a rod
LABEL_AT = {"l": 0.5, "q": 0.4, "r": 0.5}  # of the length of a leg
THICK = 0.045  # of a plate
O_COLOUR, PATH_COLOUR, EDGES_DARK = "#FFC22E", "#AA3377", "#C8D0D8"
PARTS = {
    "labels": {f"/labels/{name}" for name in (*LEGS, "O", "tool")},
    "handles": {"/platform gizmo", "/O gizmo"},
    "axes": {"/base axes", "/platform axes"},
    "region": {"/region"},
    "designs": {"/designs"},
}
"""Nodes that can be hidden."""
PLAIN = {"cast_shadow": False, "receive_shadow": False}  # shadows here are a few large triangles


def rgb(colour: str) -> tuple[int, int, int]:
    """Return the three bytes of a colour such as "#0072B2"."""
    r, g, b = bytes.fromhex(colour[1:])
    return r, g, b


class Scene:
    """Draws a machine into a viser server. Lengths are scaled, so that machines of any unit fill the view."""

    def __init__(self, server: Any, size: float, designs: DesignPicture | None = None) -> None:
        self.scale = EXTENT / size
        self._api = server.scene
        self._keys: dict[str, Any] = {}
        self.nodes: dict[str, Any] = {}
        """Of viser, by name."""
        self._designs = designs
        self._light()
        self._make_nodes()
        if designs is not None:
            self.nodes |= add_picture(self._api, designs, shapes.ball())

    def draw(self, state: State, numbers: Numbers, held: Set[str]) -> None:
        """Show a state; nodes that are held stay where they are."""
        g, c, home, dark = state.variant.geometry, state.configuration, state.variant.home, state.display.dark
        self._plate("/base", np.vstack([g.base_external, g.base_internal]), THICK, style.MUTED)
        self._plate("/platform", np.vstack([g.platform_external, g.platform_internal]), -THICK, style.PLATFORM)
        turn = to_quaternions(c.rotation[None])[0]
        for name in {"/platform", "/platform edges", "/platform gizmo", "/platform axes"} - held:
            self._set(name, position=self.scale * c.position, wxyz=turn)
        points = self.scale * points_of(g, c)
        for name in {"/O gizmo", "/O", "/labels/O"} - held:
            self._set(name, position=points[12])
        apart = float(np.linalg.norm(self.scale * c.position - points[12]))
        for name, size in GIZMOS.items():  # apart from each other, so that either can be taken
            if f"/{name} gizmo" not in held:
                self._set(f"/{name} gizmo", scale=max(size * min(1.0, apart / sum(GIZMOS.values())), LEAST))
        if tool := state.machine.design.tool:
            plate = tool.plate(c).position
            line = np.array([plate, c.position])
            self._lines("/tool", line.tobytes(), [line], style.REGION)
            if self._outdated("", "/labels/tool"):
                self.nodes["/labels/tool"] = self._api.add_label("/labels/tool", "tool", anchor="top-left")
            self._set("/labels/tool", position=self.scale * c.position)
        self._legs(points, numbers.legs_out)
        self._joints(points[:12], numbers.cones_passed)
        self._ellipsoid(state.ellipsoid(), c)
        self._body(state.body)
        if (player := state.player) is not None:
            self._lines("/path", player.trajectory, [player.trajectory.position], PATH_COLOUR)
        if (region := state.machine.region) is not None:  # one of turns alone has no lines
            self._lines("/region", home.position.tobytes(), region_lines(region, home), style.REGION)
        for k, at in enumerate([] if self._designs is None else self._designs.marks(state.variables)):
            self._set(f"/designs/{k}", visible=at is not None, **({} if at is None else {"position": at}))
        self._set("/ground", colors=np.array((64, 71, 80) if dark else (205, 210, 216), dtype=np.uint8))
        for name in ("/base edges", "/platform edges"):
            self._set(name, colors=np.array(rgb(EDGES_DARK if dark else style.INK), dtype=np.uint8))
        for part, names in PARTS.items():
            for name in names & self.nodes.keys():
                self._set(name, visible=part not in state.display.hidden)

    # --- nodes --------------------------------------------------------------------------------------------------------

    def _light(self) -> None:
        """Set the lights. Those of viser make pale colours white."""
        api = self._api
        api.set_up_direction("+z")
        api.configure_environment_map(None)
        api.configure_default_lights(enabled=False)
        api.add_light_hemisphere("/lights/sky", sky_color=(255, 255, 255), ground_color=(150, 155, 165), intensity=1.9)
        # Nothing casts a shadow: a light that could would cost three maps of them in every picture.
        turn = shapes.along(np.array([[-0.35, -0.55, 0.75]]))[0]
        api.add_light_directional("/lights/sun", intensity=2.0, wxyz=turn, cast_shadow=False)

    def _make_nodes(self) -> None:
        """Make the nodes that are there from the beginning; they are put in their places later."""
        api, nodes = self._api, self.nodes
        for name, count, mesh in (("/legs", 18, shapes.rod()), ("/joints", 12, shapes.ball())):
            still = {"batched_wxyzs": np.tile([1.0, 0.0, 0.0, 0.0], (count, 1)), "batched_scales": np.ones((count, 3))}
            still |= {"batched_positions": np.zeros((count, 3)), "batched_colors": np.zeros((count, 3), dtype=np.uint8)}
            nodes[name] = api.add_batched_meshes_simple(name, *mesh, **still, lod="off", **PLAIN)
        vertices, faces = shapes.ball()
        yellow = rgb(O_COLOUR)
        nodes["/O"] = api.add_mesh_simple("/O", 0.062 * vertices, faces, color=yellow, **PLAIN)
        nodes["/ellipsoid"] = api.add_mesh_simple(
            "/ellipsoid", *shapes.ball(14), color=yellow, opacity=0.45, visible=False, **PLAIN
        )
        for name, size, thin in (("base", 0.4, 0.012), ("platform", 0.25, 0.007)):
            nodes[f"/{name} axes"] = api.add_frame(
                f"/{name} axes", axes_length=size, axes_radius=thin, origin_radius=1.5 * thin
            )
        for name, size in GIZMOS.items():
            nodes[f"/{name} gizmo"] = api.add_transform_controls(
                f"/{name} gizmo",
                scale=size,
                line_width=2.0,
                disable_rotations=name == "O",
                depth_test=False,
                opacity=0.85,
            )
        for name in (*LEGS, "O"):
            size, anchor = (1.3, "bottom-left") if name == "O" else (1.1, "center-center")
            nodes[f"/labels/{name}"] = api.add_label(f"/labels/{name}", name, anchor=anchor, font_screen_scale=size)
        # Lines, not the grid of viser, whose program runs for every pixel of the ground.
        at, ends = np.arange(-0.5 * GROUND, 0.5 * GROUND + 0.5 * CELL, CELL), 0.5 * GROUND * np.array([-1.0, 1.0])
        lines = np.stack([np.stack([np.full(2, x), ends, np.zeros(2)], axis=1) for x in at])
        lines = np.concatenate([lines, lines[:, :, [1, 0, 2]]]).astype(np.float32)
        nodes["/ground"] = api.add_line_segments(
            "/ground", lines, colors=(0, 0, 0), thickness=1.0, thickness_units="screen"
        )

    def _set(self, name: str, **values: Any) -> None:
        for key, value in values.items():
            setattr(self.nodes[name], key, value)

    def _outdated(self, key: Any, *names: str) -> bool:
        """Return whether nodes are to be made for a key that has changed; those of the key before are removed."""
        if self._keys.get(names[0]) == key:
            return False
        for name in names:
            if name in self.nodes:
                self.nodes.pop(name).remove()
        self._keys[names[0]] = key
        return True

    # --- parts --------------------------------------------------------------------------------------------------------

    def _plate(self, name: str, joints: Floats, thickness: float, fill: str) -> None:
        edges = f"{name} edges"
        if self._outdated(joints.tobytes(), name, edges):
            vertices, faces, lines = shapes.plate(self.scale * joints, thickness)
            self.nodes[name] = self._api.add_mesh_simple(
                name, vertices.astype(np.float32), faces, color=rgb(fill), flat_shading=True, side="double", **PLAIN
            )
            self.nodes[edges] = self._api.add_line_segments(
                edges, lines.astype(np.float32), colors=(0, 0, 0), thickness=0.009
            )
            if name == "/base":
                self._set("/ground", position=np.array([0.0, 0.0, vertices[:, 2].min() - 0.01]))

    def _legs(self, points: Floats, out: tuple[bool, ...]) -> None:
        start = points[STARTS]
        arms = points[ENDS] - start
        lengths = np.maximum(np.linalg.norm(arms, axis=1), 1e-9)
        thin = np.array([RADIUS[name[0]] for name in LEGS])
        # The sleeve of an upper leg sits on the platform, those of the others on the base.
        sizes = [np.column_stack([1.6 * thin, 1.6 * thin, SLEEVE * lengths]), np.column_stack([thin, thin, lengths])]
        colours = [RED if red else style.LEG_COLOURS[name[0]] for name, red in zip(LEGS, out, strict=True)]
        sleeves = np.array([rgb(colour) for colour in colours])
        rods = np.where(np.array(out)[:, None], sleeves, 0.45 * sleeves + 0.55 * 235.0)
        self._set(
            "/legs",
            batched_positions=np.tile(start, (2, 1)).astype(np.float32),
            batched_wxyzs=np.tile(shapes.along(arms / lengths[:, None]), (2, 1)).astype(np.float32),
            batched_scales=np.concatenate(sizes).astype(np.float32),
            batched_colors=np.concatenate([sleeves, rods]).astype(np.uint8),
        )
        for name, a, arm in zip(LEGS, start, arms, strict=True):
            self._set(f"/labels/{name}", position=a + LABEL_AT[name[0]] * arm)

    def _joints(self, points: Floats, cones_passed: Set[tuple[str, int]]) -> None:
        colours = np.tile(rgb(style.INK), (12, 1))
        for body, leg in cones_passed:
            kind, i = divmod(leg, 3)  # l q r; joints are l and r of the base, l and q of the platform
            colours[(0 if body == "base" else 6) + (0 if kind == 0 else 3) + i] = rgb(RED)
        self._set(
            "/joints",
            batched_positions=points.astype(np.float32),
            batched_scales=np.full((12, 3), 0.052, dtype=np.float32),
            batched_colors=colours.astype(np.uint8),
        )

    def _ellipsoid(self, shape: Ellipsoid | None, c: Configuration) -> None:
        """Show an ellipsoid about the platform, its longest axis an eighth of the machine; none if infinite."""
        longest = 0.0 if shape is None else shape.semi_axes.max()
        self._set("/ellipsoid", visible=0.0 < longest < np.inf)
        if shape is not None and 0.0 < longest < np.inf:
            turn = to_quaternions((shape.directions * np.sign(np.linalg.det(shape.directions)))[None])[0]
            size = 0.125 * EXTENT * np.maximum(shape.semi_axes / longest, 1e-3)
            self._set("/ellipsoid", position=self.scale * c.position, wxyz=turn)
            self._set("/ellipsoid", scale=tuple(size.tolist()))

    def _body(self, body: Body) -> None:
        """Show the workspace found last; none without a mesh."""
        if self._outdated(body, "/workspace") and body.mesh is not None:
            vertices, faces = body.mesh
            self.nodes["/workspace"] = self._api.add_mesh_simple(
                "/workspace",
                (self.scale * vertices).astype(np.float32),
                faces,
                color=rgb(style.SERIES[1]),
                opacity=0.32,
                side="double",
                **PLAIN,
            )

    def _lines(self, name: str, key: Any, lines: Sequence[Floats], colour: str) -> None:
        """Show lines of shape (n, 3) in the unit of the machine."""
        if self._outdated(key, name) and lines:
            segments = [np.stack([line[:-1], line[1:]], axis=1) for line in lines]
            points = (self.scale * np.concatenate(segments)).astype(np.float32)
            self.nodes[name] = self._api.add_line_segments(name, points, colors=rgb(colour), thickness=0.012)
