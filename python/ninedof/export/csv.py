"""CSV: the coordinates of the joints, the neutral pose and the legs, in sections that a spreadsheet shows.

A section begins with a line whose first entry names it. A reader needs "joint" and "pose" alone, so that a file may be
written by hand.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ninedof.conditioning.characteristic_length import KINDS
from ninedof.export.model import JOINTS, LEGS, Fields, Format, Model, O, P
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import TRIPLES, Geometry
from ninedof.support.arguments import cleaned, did_you_mean, shown
from ninedof.support.arrays import Floats
from ninedof.support.kept.files import csv_rows, finite_or_nan
from ninedof.support.structs import within
from ninedof.support.units import unit_argument, with_unit

AXES = ("x", "y", "z")
JOINT, POSE, ROTATION, LEG, TOOL, SETTING = SECTIONS = ("joint", "pose", "rotation", "leg", "tool", "setting")
"""First column of each section, which names it."""
ROWS_OF_Q = ("row 1", "row 2", "row 3")
LENGTH = "characteristic_length"


def text(model: Model) -> str:
    """Return the file. Numbers are the shortest that read back to the same bits."""
    base, length, unit = model.base_frame, model.characteristic_length, model.unit
    x, y, z, base_x, base_y, base_z = (with_unit(name, unit) for name in (*AXES, *(f"base {axis}" for axis in AXES)))
    names = ["neutral", *(["shortest", "longest"] if model.leg_ranges else [])]  # those that the poses need
    names += ["permitted shortest", "permitted longest"] if model.permitted_ranges else []
    lengths = [with_unit(name, unit) for name in names]
    none: list[tuple[float, ...]] = [()] * len(LEGS)
    ranges = [(*a, *b) for a, b in zip(model.leg_ranges or none, model.permitted_ranges or none, strict=True)]
    sections: list[list[Iterable[Any]]] = [
        [
            (JOINT, x, y, z, base_x, base_y, base_z),
            *((name, *own, *base[name]) for name, own in model.own_frame.items()),
        ],
        [(POSE, x, y, z), *((name, *base[name]) for name in (P, O))],
        [
            (ROTATION, *AXES),
            *((name, *row) for name, row in zip(ROWS_OF_Q, model.configuration.rotation, strict=True)),
        ],
        [
            (LEG, "from", "to", *lengths),
            *((*leg, x, *ends) for leg, x, ends in zip(LEGS, model.neutral_lengths, ranges, strict=True)),
        ],
        [(SETTING, "value"), (LENGTH, length if isinstance(length, str) else float(length))],
    ]
    if model.tool:
        axes = [(f"axis {name}", *axis) for name, axis in zip(AXES, model.tool.axes.T, strict=True)]
        sections.insert(-1, [(TOOL, *AXES), ("point", *map(float, model.tool.position)), *axes])
    file = io.StringIO()
    for k, rows in enumerate(sections):
        file.write("\n" if k else "")
        csv.writer(file, lineterminator="\n").writerows(rows)
    return file.getvalue()


class Block(NamedTuple):
    """One section of a file: names and units of its columns, and its rows by their first entry, with their lines."""

    line: int
    columns: list[str]
    units: list[str]
    rows: dict[str, tuple[int, list[str]]]


def read(text: str) -> Fields:
    """Return the design of a CSV file of joint coordinates.

    "joint" and "pose" are needed: the twelve joints, such as base_external_1, in the frame of their plate, and p and O
    in the base frame, with the columns x, y and z. "rotation" has the rows of Q (the identity without it) and "setting"
    the characteristic length (1 without it). The unit of lengths is that of the headers, "x (mm)". All else is left
    out: it follows from these numbers.
    """
    blocks = _blocks(text)
    for name in (JOINT, POSE):
        if name not in blocks:
            raise ValueError(f"got no section {name}, expected a line that begins with {name},x,y,z")
    joints, pose = blocks[JOINT], blocks[POSE]
    points, (p, s) = _vectors(joints, JOINTS), _vectors(pose, (P, O))
    rotation = _vectors(blocks[ROTATION], ROWS_OF_Q) if ROTATION in blocks else np.eye(3)
    length = _length(blocks[SETTING]) if SETTING in blocks else 1.0
    geometry = Geometry(**dict(zip(TRIPLES, points.reshape(4, 3, 3), strict=True)))
    return geometry, Configuration(p, rotation, s), length, _unit(joints, pose)


def _blocks(text: str) -> dict[str, Block]:
    blocks: dict[str, Block] = {}
    rows: dict[str, Any] | None = None
    for line, entries in csv_rows(text):
        name, *rest = map(cleaned, entries)
        if name not in SECTIONS and rows is None:
            raise ValueError(f"line {line}: got {shown(name)}, expected the header of a section, such as joint,x,y,z")
        if name in (blocks if name in SECTIONS or rows is None else rows):
            raise ValueError(f"line {line}: got {name} twice, expected it once")
        if name in SECTIONS:
            heads, rows = [head.partition(" (") for head in rest], {}
            blocks[name] = Block(line, [head[0] for head in heads], [head[2].rstrip(")") for head in heads], rows)
        elif rows is not None:
            rows[name] = line, rest
    return blocks


def _unit(*blocks: Block) -> str:
    """Return the unit that all columns of lengths name."""
    units = [(f"line {one.line}, column {axis}", one.units[one.columns.index(axis)]) for one in blocks for axis in AXES]
    first = units[0][1]
    for where, unit in units:
        if unit != first:
            raise ValueError(f"{where}: got {unit or 'no unit'}, expected {first or 'none'}")
        with within(where, ": "):
            unit_argument(unit)
    return first


def _vectors(block: Block, names: Sequence[str]) -> Floats:
    """Return the columns x, y and z of the named rows, shape (n, 3); raise for rows that are missing or not known."""
    where, columns = f"line {block.line}", block.columns
    if any(columns.count(axis) != 1 for axis in AXES):
        raise ValueError(f"{where}: got {','.join(columns)}, expected the columns x, y and z, each once")
    for name, (line, _) in block.rows.items():
        if name not in names:
            expected = f"expected one of {', '.join(names)}{did_you_mean(name, names)}"
            raise ValueError(f"line {line}: got {shown(name)}, {expected}")
    if missing := [name for name in names if name not in block.rows]:
        raise ValueError(f"{where}: got no {', '.join(missing)} below, expected a row for each")
    return np.array([[_number(*block.rows[name], columns.index(axis), axis) for axis in AXES] for name in names])


def _number(line: int, entries: Sequence[str], index: int, name: str) -> float:
    entry = entries[index] if index < len(entries) else ""
    if math.isnan(value := finite_or_nan(entry)):
        raise ValueError(f"line {line}, column {name}: got {shown(entry)}, expected a finite number")
    return value


def _length(block: Block) -> float | str:
    for name, (line, _) in block.rows.items():
        if name != LENGTH:
            raise ValueError(f"line {line}: got {shown(name)}, expected {LENGTH}")
    line, entries = block.rows.get(LENGTH, (block.line, ["1.0"]))
    if entries[:1] and entries[0] in KINDS:
        return entries[0]
    if (value := _number(line, entries, 0, "value")) <= 0.0:
        raise ValueError(f"line {line}: got {value:g}, expected a positive number or one of {', '.join(KINDS)}")
    return value


FORMAT = Format("csv", ".csv", "coordinates of the joints", text, read, mark=",base x")
