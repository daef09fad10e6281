"""DXF: the two plates side by side in plan, each in its own frame, with joints, outlines, sides and coordinates.

ezdxf writes the file. A dimension that a CAD program can edit is an entity, a style, a block and references between
them; a maintained library that also audits them is worth the extra `cad`.
"""

from __future__ import annotations

import io
import math
from typing import Any

import numpy as np

from ninedof.export.model import Model
from ninedof.export.plates import Plate, Side, plates_of
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
    words = {
        "dimdec": decimals,
        "dimzin": 0,
        "dimtad": 1,
        "dimclrd": 5,
        "dimclre": 5,
        "dimclrt": 7,
        "dimdsep": ord("."),
    }
    words |= {"dimlwd": BY_LAYER, "dimlwe": BY_LAYER}
    document.dimstyles.new(STYLE, dxfattribs=sizes | words)


def _round_up(value: float) -> float:
    """Return the next number of two digits, so that the shift is easy to undo."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{step * math.ceil(value / step):.2g}")


class _Drawing:
    """Draws one plate around the origin of its frame, which lies at `origin` of the drawing."""

    def __init__(self, space: Any, origin: Floats, height: float, decimals: int, unit: str) -> None:
        self.space, self.origin, self.height, self.decimals, self.unit = space, origin, height, decimals, unit

    def plate(self, plate: Plate, bottom: float) -> None:
        """Draw a plate, and its table of coordinates below y = bottom."""
        if len(plate.outline):
            self.space.add_lwpolyline(
                (plate.outline + self.origin).tolist(), close=True, dxfattribs={"layer": "OUTLINE"}
            )
        self._axes(0.25 * plate.size)
        for radius in plate.radii:
            self.space.add_circle(self.origin, radius, dxfattribs={"layer": "CENTRE"})
        self._joints(plate)
        for side in plate.sides:
            self._side(side)
        for radius, angle in zip(plate.radii, _free_angles(plate), strict=False):
            self._radius(radius, angle)
        self._table(plate, bottom)

    def _axes(self, length: float) -> None:
        for axis, name in zip(np.eye(2), "xy", strict=True):
            ends = (self.origin - 0.25 * length * axis, self.origin + length * axis)
            self.space.add_line(*ends, dxfattribs={"layer": "CENTRE", "linetype": "CONTINUOUS"})
            self._text(name, self.origin + (length + 0.8 * self.height) * axis, "CENTRE", "MIDDLE_CENTER")

    def _joints(self, plate: Plate) -> None:
        """Draw a circle at each centre, one where joints coincide, and its name, toward the origin if there is room."""
        shared: dict[tuple[float, ...], list[str]] = {}
        for name, joint in plate.joints.items():
            near = next((at for at in shared if np.linalg.norm(joint - at) <= 1e-9 * plate.size), None)
            shared.setdefault(near or tuple(joint.tolist()), []).append(name)
        for at, names in shared.items():
            centre, label = np.array(at[:2]), " ".join(names)
            self.space.add_circle(self.origin + centre, 0.4 * self.height, dxfattribs={"layer": "JOINTS"})
            reach, radius = self.height * (1.2 + 0.75 * len(label)), float(np.linalg.norm(centre))
            away = centre / radius if radius > 0.0 else np.array([0.0, 1.0])
            step = -reach if reach < 0.4 * radius else reach
            self._text(label, self.origin + centre + step * away, "TEXT", "MIDDLE_CENTER")

    def _side(self, side: Side) -> None:
        """Dimension a side, on the side away from the origin."""
        a, b = sorted([side.start[:2], side.end[:2]], key=lambda end: end.round(9).tolist())  # words left to right
        left = np.array([a[1] - b[1], b[0] - a[0]])
        outward = left * math.copysign(1.0, left @ (a + b)) / np.linalg.norm(left)
        distance = 4.0 * self.height * math.copysign(1.0, left @ outward)
        words, length = f"{side.name} = <>", float(np.linalg.norm(b - a))
        dimension = self.space.add_aligned_dim(
            p1=self.origin + a, p2=self.origin + b, distance=distance, text=words, **_STYLED
        )
        if length < self.height * (len(words) + self.decimals):  # no room between the extension lines
            beyond = 5.4 * self.height
            dimension.set_location(self.origin + 0.5 * (a + b) + beyond * outward)
        dimension.render()

    def _radius(self, radius: float, angle: float) -> None:
        self.space.add_radius_dim(center=self.origin, radius=radius, angle=math.degrees(angle), **_STYLED).render()

    def _table(self, plate: Plate, bottom: float) -> None:
        """Write the title and the coordinates of the joints in the frame of the plate."""
        columns = self.height * np.array([0.0, 22.0, 34.0, 46.0])
        start = self.origin + np.array([-0.5 * columns[-1], bottom])
        x = self.origin[0]
        place = "" if x == 0.0 else f"; its origin is at x = {x:g} of the drawing"
        heads = ["joint", *(with_unit(axis, self.unit) for axis in "xyz")]
        rows = [
            [f"{name}  {JOINT_WORDS[name[0]]} {name[1]}", *(f"{value:.{self.decimals}f}" for value in rounded)]
            for name, rounded in ((name, joint.round(self.decimals) + 0.0) for name, joint in plate.joints.items())
        ]
        self._text(f"{plate.title} from +z, in its own frame{place}", start, "TEXT", "LEFT", scale=1.2)
        for k, row in enumerate([heads, *rows], start=1):
            for x, entry in zip(columns, row, strict=True):
                align = "LEFT" if x == 0.0 else "RIGHT"
                self._text(entry, start + np.array([x, -2.0 * k * self.height]), "TEXT", align)

    def _text(self, words: str, at: Floats, layer: str, align: str, scale: float = 1.0) -> None:
        places = optional("ezdxf.enums", "cad", PURPOSE).TextEntityAlignment
        written = self.space.add_text(words, height=scale * self.height, dxfattribs={"layer": layer})
        written.set_placement(at, align=places[align])


_STYLED: dict[str, Any] = {"dimstyle": STYLE, "dxfattribs": {"layer": "DIMENSIONS"}}


def _free_angles(plate: Plate) -> Floats:
    """Return the middles of the gaps between the directions of the joints, the widest first, dimensioned sides last."""
    angles = np.unique([round(math.atan2(y, x) % math.tau, 9) for x, y, _ in plate.joints.values()])
    gaps = np.diff(np.append(angles, angles[0] + math.tau))
    middles = angles + 0.5 * gaps
    outward = [(side.start + side.end)[:2] for side in plate.sides]
    taken = [any(np.cos(angle - math.atan2(y, x)) > 0.99 for x, y in outward) for angle in middles]
    beside_axes = -np.abs(np.sin(2.0 * middles)).round(6)
    found: Floats = middles[np.lexsort((beside_axes, -gaps.round(6), np.array(taken)))]
    return found
