"""DXF: the two plates side by side in plan, each in its own frame: joints, outlines, dimensions, cone axes, a table.

ezdxf writes the file. A dimension that a CAD program can edit is an entity, a style, a block and references between
them; a maintained library that also audits them is worth the extra `cad`.
"""

from __future__ import annotations

import io
import math
from typing import Any

import numpy as np

from ninedof.export.model import Format, Model
from ninedof.robot.plates import Plate, free_angles, plates_of, turn_words
from ninedof.support.arrays import Floats
from ninedof.support.extras import optional
from ninedof.support.placing import LabelPlaces, around, rectangle, toward
from ninedof.support.units import amount, with_unit

INSUNITS = {"": 0, "in": 1, "ft": 2, "mm": 4, "cm": 5, "m": 6}
IMPERIAL = ("in", "ft")
LAYERS = {
    **{"OUTLINE": (7, 50), "JOINTS": (1, 25), "CENTRE": (8, 13), "DIMENSIONS": (5, 18), "CONES": (6, 18)},
    "TEXT": (7, 25),
}
"""Names, colour numbers (black on white, red, grey, blue, magenta) and line widths in 0.01 mm."""
STYLE = "NINEDOF"
BY_LAYER = -1  # width of lines
FONT = "arial.ttf"
DIGITS = 6  # of the largest length in dimensions and tables
PURPOSE = "the DXF drawing of the plates"
WORDS = 0.03  # height of words in sizes of the plate
LARGE = 0.045  # at most, of a plate that is smaller than the other
LETTER = 0.82  # width of a letter in heights of capitals
TABLE = 89.0  # width of the table of joints, in heights of words
CONE = 6.0  # heights of words that the axis of a level cone is long
CONES = "cone: axis at the joint in this frame, of length 1, from the joint along the leg; drawn in plan"
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
    plates = plates_of(model.geometry)
    size = max(plate.size for plate in plates)
    decimals = min(max(DIGITS - 1 - math.floor(math.log10(size)), 0), 8)
    document.header["$LTSCALE"] = 0.05 * plates[0].size
    apart = 0.0
    for plate in plates:
        style = f"{STYLE}_{plate.title.upper()}"
        height = min(WORDS * size, LARGE * plate.size)  # the words of a small platform stay apart
        _dimension_style(document, style, height, decimals)
        drawing = _Drawing(document.modelspace(), np.array([apart, 0.0]), height, decimals, style)
        drawing.plate(plate, model)
        drawing.table(plate, model, WORDS * size)
        apart = _round_up(max(1.6 * (plates[0].size + plates[1].size), (TABLE + 6.0) * WORDS * size))
    optional("ezdxf.zoom", "cad", PURPOSE).extents(document.modelspace())  # what a program shows when it opens the file
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue()


def _dimension_style(document: Any, style: str, height: float, decimals: int) -> None:
    sizes = {"dimtxt": height, "dimasz": height, "dimexo": height, "dimexe": 0.5 * height, "dimgap": 0.4 * height}
    numbers = {"dimdec": decimals, "dimzin": 0, "dimtad": 1, "dimdsep": ord(".")}
    lines = {"dimclrd": 5, "dimclre": 5, "dimclrt": 7, "dimlwd": BY_LAYER, "dimlwe": BY_LAYER}
    lines |= {"dimadec": 3, "dimazin": 2}  # angles
    document.dimstyles.new(style, dxfattribs=sizes | numbers | lines)


def _round_up(value: float) -> float:
    """Return the next number of two digits, so that the shift is easy to undo."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{step * math.ceil(value / step):.2g}")


class _Drawing:
    """Draws one plate around the origin of its frame, which lies at `origin` of the drawing."""

    def __init__(self, space: Any, origin: Floats, height: float, decimals: int, style: str) -> None:
        self.space, self.origin, self.height, self.decimals = space, origin, height, decimals
        self.styled: dict[str, Any] = {"dimstyle": style, "dxfattribs": {"layer": "DIMENSIONS"}}
        self.places = LabelPlaces()

    def plate(self, plate: Plate, model: Model) -> None:
        """Draw a plate with its dimensions, then names where they cover nothing."""
        if len(corners := plate.outline + self.origin):
            self.space.add_lwpolyline(corners.tolist(), close=True, dxfattribs={"layer": "OUTLINE"})
            self.places.add_path(np.vstack([corners, corners[:1]]))
        for radius in plate.radii:
            self.space.add_circle(self.origin, radius, dxfattribs={"layer": "CENTRE"})
        centres = plate.centres()
        self._cones(plate, model)
        for at in centres:
            self.space.add_circle(self.origin + at[:2], 0.4 * self.height, dxfattribs={"layer": "JOINTS"})
            self.places.words.append(rectangle(self.origin + at[:2], self.height, self.height))
        for name, ends in plate.sides.items():
            self._side(name, *ends)
        for radius, angle in zip(plate.radii, free_angles(plate), strict=False):
            self._radius(radius, angle)
        for k, angles in enumerate(plate.angles):
            self._angle((0.4 + 0.2 * k) * min(plate.radii), *angles)
        self._axes(0.25 * plate.size)
        for at, names in centres.items():
            self._name(" ".join(names), self.origin + at[:2], 0.4 * self.height)

    def _cones(self, plate: Plate, model: Model) -> None:
        """Draw the axis of each cone in plan from its joint, where it is not upright."""
        for name, joint in plate.joints.items():
            start = self.origin + joint[:2]
            tip = start + CONE * self.height * model.cone_axes[_joint(plate, name)][:2]
            if np.linalg.norm(tip - start) > 0.5 * self.height:
                self.space.add_line(start, tip, dxfattribs={"layer": "CONES"})
                self.places.add_path(np.array([start, tip]))

    def _axes(self, length: float) -> None:
        for axis in np.eye(2):
            ends = np.array([self.origin - 0.25 * length * axis, self.origin + length * axis])
            self.space.add_line(*ends, dxfattribs={"layer": "CENTRE", "linetype": "CONTINUOUS"})
            self.places.add_path(ends)
        for axis, name in zip(np.eye(2), "xy", strict=True):
            self._name(name, self.origin + length * axis, 0.0)

    def _name(self, words: str, at: Floats, clear: float) -> None:
        """Write words as near to a point as they cover nothing, the first outward."""
        width, h = LETTER * self.height * len(words), self.height
        way = around(at - self.origin, np.pi / 12.0, 13)
        reach = clear + 0.5 * h + np.abs(way) @ [0.5 * width, 0.5 * h]
        centres = np.concatenate([at + (reach + more * h)[:, None] * way for more in (0.0, 0.8, 1.8, 3.0, 5.0)])
        self._text(words, self.places.put(1.1 * width, 1.3 * h, centres), "MIDDLE_CENTER")

    def _side(self, name: str, start: Floats, end: Floats) -> None:
        a, b = sorted([start[:2], end[:2]], key=lambda point: point.round(9).tolist())  # words left to right
        left = np.array([a[1] - b[1], b[0] - a[0]])
        outward = left * math.copysign(1.0, left @ (a + b)) / np.linalg.norm(left)
        distance = 5.0 * self.height * math.copysign(1.0, left @ outward)
        words, ends = f"{name} = <>", {"p1": self.origin + a, "p2": self.origin + b}
        dimension = self.space.add_aligned_dim(**ends, distance=distance, text=words, **self.styled)
        if np.linalg.norm(b - a) < self.height * (len(words) + self.decimals):  # no room between the extension lines
            dimension.set_location(self.origin + 0.5 * (a + b) + 6.4 * self.height * outward)
        self._render(dimension)

    def _radius(self, radius: float, angle: float) -> None:
        """Dimension a circle, with the words past it."""
        self._render(
            self.space.add_radius_dim(center=self.origin, radius=radius, angle=math.degrees(angle), **self.styled)
        )

    def _angle(self, radius: float, start: float, end: float) -> None:
        """Dimension an angle at the origin, with level words beside the middle of its arc."""
        middle, width = 0.5 * (start + end), LETTER * self.height * 8.0
        ways = middle + np.array([0.0, 0.15, -0.15, 0.35, -0.35, 0.7, -0.7, 1.1, -1.1])
        reach = radius + np.array([2.5, -2.5, 4.0, 6.0])[:, None] * self.height
        centres = (reach[..., None] * toward(ways)).reshape(-1, 2)
        for side in 1.1 * radius * toward([start, end]):
            self.places.add_path(np.array([self.origin, self.origin + side]))
        self.places.add_path(self.origin + radius * toward(np.linspace(start, end, 9)))
        at = self.places.put(width, 1.6 * self.height, self.origin + centres)
        self.places.words.pop()  # the words themselves take their place
        dimension = self.space.add_angular_dim_cra(
            center=self.origin,
            radius=0.3 * radius,
            start_angle=math.degrees(start),
            end_angle=math.degrees(end),
            distance=0.7 * radius,
            location=at,
            text_rotation=0.0,
            **self.styled,
        )
        self._render(dimension)

    def _render(self, dimension: Any) -> None:
        """Draw a dimension, and keep its words and lines free of names."""
        block = self.space.doc.blocks.get(dimension.render().dimension.dxf.geometry)
        self.places.words += words_of(block)
        for line in block.query("LINE"):
            self.places.add_path(np.array([line.dxf.start, line.dxf.end])[:, :2])

    def table(self, plate: Plate, model: Model, height: float) -> None:
        """Write the title and the table of the joints in the frame of the plate, below it, in words of a height."""
        self.height, bottom = height, self.origin[1] - plate.size - 8.0 * (self.height + height)
        columns = height * np.array([0.0, 20.0, 31.0, 42.0, 53.0, 63.0, 73.0, 81.0, TABLE])
        start = np.array([self.origin[0] - 0.5 * columns[-1], bottom])
        x = self.origin[0]
        place = "" if x == 0.0 else f"; its origin is at x = {x:g} of the drawing"
        lengths = [with_unit(word, model.unit) for word in ("x", "y", "z", "radius")]
        rows = [["joint", *lengths, "angle (deg)", "cone x", "cone y", "cone z"]]
        for name, joint in plate.joints.items():
            radius, angle = float(np.hypot(*joint[:2])), math.degrees(math.atan2(joint[1], joint[0]))
            numbers = [f"{value + 0.0:.{self.decimals}f}" for value in (*joint.round(self.decimals), radius)]
            axis = [f"{value:.5f}" for value in model.cone_axes[_joint(plate, name)].round(5) + 0.0]
            word = f"{name}  {JOINT_WORDS[name[0]]} {name[1]}"
            rows.append([word, *numbers, f"{round(angle, 4) + 0.0:.4f}" if radius > 0.0 else "-", *axis])
        self._text(f"{plate.title} from +z, in its own frame{place}", start, "LEFT", scale=1.2)
        for k, row in enumerate(rows, start=1):
            for x, entry in zip(columns, row, strict=True):
                align = "LEFT" if x == 0.0 else "RIGHT"
                self._text(entry, start + np.array([x, -2.0 * k * self.height]), align)
        c, unit = model.configuration, model.unit
        heights = {"zp": c.position, "zs": c.internal_point}
        words = [f"{name} = {amount(f'{at[2]:.{self.decimals}f}', unit)}" for name, at in heights.items()]
        pose = f"neutral pose: {', '.join([*words, *turn_words(c), *model.tool.words(unit)])}"
        for k, note in enumerate((CONES, pose), start=len(rows) + 1):
            self._text(note, start + np.array([0.0, -2.0 * k * self.height]), "LEFT")

    def _text(self, words: str, at: Floats, align: str, scale: float = 1.0) -> None:
        places = optional("ezdxf.enums", "cad", PURPOSE).TextEntityAlignment
        text = self.space.add_text(words, height=scale * self.height, dxfattribs={"layer": "TEXT"})
        text.set_placement(at, align=places[align])


def words_of(block: Any) -> list[Floats]:
    """Return the outlines of the words in the block of a dimension, shape (4, 2)."""
    boxes = []
    for text in block.query("MTEXT"):
        words, height = text.plain_text(), float(text.dxf.char_height)
        angle = math.radians(text.get_rotation())
        boxes.append(rectangle(np.array(text.dxf.insert)[:2], LETTER * height * len(words), 1.2 * height, angle))
    return boxes


def _joint(plate: Plate, name: str) -> str:
    """Return the name of a joint of a plate in the model: "E1" is "base_external_1"."""
    return f"{plate.title.lower()}_{JOINT_WORDS[name[0]]}_{name[1]}"


FORMAT = Format("dxf", ".dxf", "drawing of the two plates", text, mark="NINEDOF")
