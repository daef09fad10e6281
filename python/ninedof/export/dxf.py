"""DXF: the two plates side by side in plan, each in its own frame, with joints, outlines, sides and coordinates.

ezdxf writes the file. A dimension that a CAD program can edit is an entity, a style, a block and references between
them; a maintained library that also audits them is worth the extra `cad`.
"""

from __future__ import annotations

import io
import math
from typing import Any, NamedTuple

import numpy as np

from ninedof.export.model import Format, Model
from ninedof.robot.geometry import Geometry
from ninedof.robot.plates import outlines
from ninedof.support.arrays import Floats
from ninedof.support.extras import optional
from ninedof.support.units import with_unit

INSUNITS = {"": 0, "in": 1, "ft": 2, "mm": 4, "cm": 5, "m": 6}
IMPERIAL = ("in", "ft")
LAYERS = {"OUTLINE": (7, 50), "JOINTS": (1, 25), "CENTRE": (8, 13), "DIMENSIONS": (5, 18), "TEXT": (7, 25)}
"""Names, colour numbers (black on white, red, grey, blue) and line widths in 0.01 mm."""
STYLE = "NINEDOF"
BY_LAYER = -1  # width of lines
FONT = "arial.ttf"
DIGITS = 6  # of the largest length in dimensions and tables
PURPOSE = "the DXF drawing of the plates"
JOINT_WORDS = {"E": "external", "I": "internal"}
SAME = 1e-9
"""Lengths that differ by less, relative to the plate, are equal."""


def text(model: Model) -> str:
    """Return the file; raise MissingExtra without ezdxf."""
    ezdxf = optional("ezdxf", "cad", PURPOSE)
    document = ezdxf.new("R2010", setup=["linetypes"])
    document.header["$INSUNITS"] = INSUNITS[model.unit]
    document.header["$MEASUREMENT"] = 0 if model.unit in IMPERIAL else 1
    document.styles.get("Standard").dxf.font = FONT
    for name, (color, width) in LAYERS.items():
        kind = "CENTER" if name == "CENTRE" else "CONTINUOUS"
        document.layers.add(name, color=color, linetype=kind, lineweight=width)
    base, platform = plates_of(model.geometry)
    size = max(base.size, platform.size)
    height = 0.03 * size
    document.header["$LTSCALE"] = 0.05 * size
    decimals = min(max(DIGITS - 1 - math.floor(math.log10(size)), 0), 8)
    _dimension_style(document, height, decimals)
    apart = _round_up(1.5 * (base.size + platform.size) + 10.0 * height)
    for plate, x in ((base, 0.0), (platform, apart)):
        drawing = _Drawing(document.modelspace(), np.array([x, 0.0]), height, decimals, model.unit)
        drawing.plate(plate, bottom=-1.5 * size)
    optional("ezdxf.zoom", "cad", PURPOSE).extents(document.modelspace())  # what a program shows when it opens the file
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue()


def _dimension_style(document: Any, height: float, decimals: int) -> None:
    sizes = {"dimtxt": height, "dimasz": height, "dimexo": height, "dimexe": 0.5 * height, "dimgap": 0.4 * height}
    numbers = {"dimdec": decimals, "dimzin": 0, "dimtad": 1, "dimdsep": ord(".")}
    lines = {"dimclrd": 5, "dimclre": 5, "dimclrt": 7, "dimlwd": BY_LAYER, "dimlwe": BY_LAYER}
    document.dimstyles.new(STYLE, dxfattribs=sizes | numbers | lines)


def _round_up(value: float) -> float:
    """Return the next number of two digits, so that the shift is easy to undo."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{step * math.ceil(value / step):.2g}")


class Plate(NamedTuple):
    """One plate, seen from +z of its frame."""

    title: str
    joints: dict[str, Floats]
    """E1 E2 E3, the external ones, and I1 I2 I3, the internal ones; shape (3,)."""
    outline: Floats
    """Corners of the convex hull of the joints in plan, shape (n, 2); none where they lie on a line in plan."""
    sides: dict[str, tuple[Floats, Floats]]
    """The ends of a1 and a2, or b1 and b2, where the plate is a hexagon of the paper; without those of length 0."""
    radii: list[float]
    """Of the circles about the origin on which the external and the internal joints lie, where they do; each once."""

    @property
    def size(self) -> float:
        """The largest distance of a joint from the origin, in plan."""
        return float(max(np.linalg.norm(joint[:2]) for joint in self.joints.values()))


def plates_of(geometry: Geometry) -> tuple[Plate, Plate]:
    """Return the base and the platform."""
    return (
        _plate("Base", geometry.base_external, geometry.base_internal, ("a1", "a2")),
        _plate("Platform", geometry.platform_external, geometry.platform_internal, ("b1", "b2")),
    )


def _plate(title: str, external: Floats, internal: Floats, names: tuple[str, str]) -> Plate:
    joints = {f"{kind}{i + 1}": row for kind, rows in (("E", external), ("I", internal)) for i, row in enumerate(rows)}
    flat = np.vstack([external, internal]) * [1.0, 1.0, 0.0]
    faces = outlines(flat) if np.ptp(flat) > 0.0 else []
    radii: list[float] = []
    for circle in np.linalg.norm(flat.reshape(2, 3, 3)[..., :2], axis=2):
        same = SAME * float(circle.max())
        if np.ptp(circle) <= same and not any(abs(circle[0] - other) <= same for other in radii):
            radii.append(float(circle[0]))
    return Plate(
        title, joints, faces[0][:, :2] if faces else np.empty((0, 2)), _sides(external, internal, names), radii
    )


def _sides(external: Floats, internal: Floats, names: tuple[str, str]) -> dict[str, tuple[Floats, Floats]]:
    """Return the sides of a hexagon: the first to the internal joint of the same number, the second to the one before.

    The joints lie on one circle about the origin in one plane z = constant, and each of the two sides has one length.
    """
    others, joints = (internal, np.roll(internal, 1, axis=0)), np.vstack([external, internal])
    lengths = [np.linalg.norm(external - other, axis=1) for other in others]
    scale = SAME * float(np.abs(joints).max())
    if any(np.ptp(values) > scale for values in (np.linalg.norm(joints[:, :2], axis=1), joints[:, 2], *lengths)):
        return {}
    sides = zip(names, others, lengths, strict=True)
    return {name: (external[0], other[0]) for name, other, length in sides if length[0] > scale}


class _Drawing:
    """Draws one plate around the origin of its frame, which lies at `origin` of the drawing."""

    def __init__(self, space: Any, origin: Floats, height: float, decimals: int, unit: str) -> None:
        self.space, self.origin, self.height, self.decimals, self.unit = space, origin, height, decimals, unit

    def plate(self, plate: Plate, bottom: float) -> None:
        """Draw a plate, and its table of coordinates below y = bottom."""
        if len(corners := plate.outline + self.origin):
            self.space.add_lwpolyline(corners.tolist(), close=True, dxfattribs={"layer": "OUTLINE"})
        self._axes(0.25 * plate.size)
        for radius in plate.radii:
            self.space.add_circle(self.origin, radius, dxfattribs={"layer": "CENTRE"})
        self._joints(plate)
        for name, ends in plate.sides.items():
            self._side(name, *ends)
        for radius, angle in zip(plate.radii, np.degrees(_free_angles(plate)), strict=False):
            self.space.add_radius_dim(center=self.origin, radius=radius, angle=angle, **_STYLED).render()
        self._table(plate, bottom)

    def _axes(self, length: float) -> None:
        for axis, name in zip(np.eye(2), "xy", strict=True):
            ends = (self.origin - 0.25 * length * axis, self.origin + length * axis)
            self.space.add_line(*ends, dxfattribs={"layer": "CENTRE", "linetype": "CONTINUOUS"})
            self._text(name, self.origin + (length + 0.8 * self.height) * axis, "CENTRE", "MIDDLE_CENTER")

    def _joints(self, plate: Plate) -> None:
        """Draw a circle at each centre, one where joints coincide, and its name, toward the origin if there is room."""
        centres: dict[tuple[float, ...], list[str]] = {}
        for name, joint in plate.joints.items():
            near = next((at for at in centres if np.linalg.norm(joint - at) <= SAME * plate.size), None)
            centres.setdefault(near or tuple(joint.tolist()), []).append(name)
        for at, names in centres.items():
            centre, label = np.array(at[:2]), " ".join(names)
            self.space.add_circle(self.origin + centre, 0.4 * self.height, dxfattribs={"layer": "JOINTS"})
            reach, radius = self.height * (1.2 + 0.75 * len(label)), float(np.linalg.norm(centre))
            away = centre / radius if radius > 0.0 else np.array([0.0, 1.0])
            step = -reach if reach < 0.4 * radius else reach
            self._text(label, self.origin + centre + step * away, "TEXT", "MIDDLE_CENTER")

    def _side(self, name: str, start: Floats, end: Floats) -> None:
        """Dimension a side, on the side away from the origin."""
        a, b = sorted([start[:2], end[:2]], key=lambda point: point.round(9).tolist())  # words left to right
        left = np.array([a[1] - b[1], b[0] - a[0]])
        outward = left * math.copysign(1.0, left @ (a + b)) / np.linalg.norm(left)
        distance = 4.0 * self.height * math.copysign(1.0, left @ outward)
        words, ends = f"{name} = <>", {"p1": self.origin + a, "p2": self.origin + b}
        dimension = self.space.add_aligned_dim(**ends, distance=distance, text=words, **_STYLED)
        if np.linalg.norm(b - a) < self.height * (len(words) + self.decimals):  # no room between the extension lines
            dimension.set_location(self.origin + 0.5 * (a + b) + 5.4 * self.height * outward)
        dimension.render()

    def _table(self, plate: Plate, bottom: float) -> None:
        """Write the title and the coordinates of the joints in the frame of the plate."""
        columns = self.height * np.array([0.0, 22.0, 34.0, 46.0])
        start = self.origin + np.array([-0.5 * columns[-1], bottom])
        x = self.origin[0]
        place = "" if x == 0.0 else f"; its origin is at x = {x:g} of the drawing"
        heads = ["joint", *(with_unit(axis, self.unit) for axis in "xyz")]
        rows = [
            [f"{name}  {JOINT_WORDS[name[0]]} {name[1]}"]
            + [f"{value:.{self.decimals}f}" for value in joint.round(self.decimals) + 0.0]
            for name, joint in plate.joints.items()
        ]
        self._text(f"{plate.title} from +z, in its own frame{place}", start, "TEXT", "LEFT", scale=1.2)
        for k, row in enumerate([heads, *rows], start=1):
            for x, entry in zip(columns, row, strict=True):
                align = "LEFT" if x == 0.0 else "RIGHT"
                self._text(entry, start + np.array([x, -2.0 * k * self.height]), "TEXT", align)

    def _text(self, words: str, at: Floats, layer: str, align: str, scale: float = 1.0) -> None:
        places = optional("ezdxf.enums", "cad", PURPOSE).TextEntityAlignment
        text = self.space.add_text(words, height=scale * self.height, dxfattribs={"layer": layer})
        text.set_placement(at, align=places[align])


_STYLED: dict[str, Any] = {"dimstyle": STYLE, "dxfattribs": {"layer": "DIMENSIONS"}}


def _free_angles(plate: Plate) -> Floats:
    """Return the middles of the gaps between the directions of the joints, the widest first, dimensioned sides last."""
    angles = np.unique([round(math.atan2(y, x) % math.tau, 9) for x, y, _ in plate.joints.values()])
    gaps = np.diff(np.append(angles, angles[0] + math.tau))
    middles = angles + 0.5 * gaps
    outward = [(start + end)[:2] for start, end in plate.sides.values()]
    beside_sides = [any(np.cos(angle - math.atan2(y, x)) > 0.99 for x, y in outward) for angle in middles]
    beside_axes = -np.abs(np.sin(2.0 * middles)).round(6)
    return np.asarray(middles[np.lexsort((beside_axes, -gaps.round(6), np.array(beside_sides)))])


FORMAT = Format("dxf", ".dxf", "drawing of the two plates", text, mark="NINEDOF")
