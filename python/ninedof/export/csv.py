"""CSV: the coordinates of the joints, the neutral pose and the legs, in sections that a spreadsheet shows.

A section begins with a line whose first entry names it. A reader needs "joint" and "pose" alone, so that a file may be
written by hand.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from ninedof.conditioning.characteristic_length import KINDS
from ninedof.export.model import JOINTS, LEGS, Fields, Format, Model, O, P
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import TRIPLES, Geometry
from ninedof.support.arguments import cleaned, did_you_mean, shown
from ninedof.support.arrays import Floats
from ninedof.support.units import unit_argument, with_unit

AXES = ("x", "y", "z")
JOINT, POSE, ROTATION, LEG, SETTING = SECTIONS = ("joint", "pose", "rotation", "leg", "setting")
"""First column of each section, which names it."""
ROWS_OF_Q = ("row 1", "row 2", "row 3")
LENGTH = "characteristic_length"


def text(model: Model) -> str:
    """Return the file. Numbers are the shortest that read back to the same bits."""
    base, length = model.base_frame, model.characteristic_length

    def measured(*names: str) -> list[str]:
        return [with_unit(name, model.unit) for name in names]

    lengths = ["neutral", *(["shortest", "longest"] if model.leg_ranges else [])]
    ranges = model.leg_ranges or [()] * len(LEGS)
    sections = [
        [[JOINT, *measured(*AXES, *(f"base {axis}" for axis in AXES))]]
        + [[name, *_numbers(x), *_numbers(base[name])] for name, x in model.own_frame.items()],
        [[POSE, *measured(*AXES)]] + [[name, *_numbers(base[name])] for name in (P, O)],
        [[ROTATION, *AXES]]
        + [[name, *_numbers(row)] for name, row in zip(ROWS_OF_Q, model.configuration.rotation, strict=True)],
        [[LEG, "from", "to", *measured(*lengths)]]
        + [[*leg, *_numbers([x, *ends])] for leg, x, ends in zip(LEGS, model.neutral_lengths, ranges, strict=True)],
        [[SETTING, "value"], [LENGTH, length if isinstance(length, str) else repr(float(length))]],
    ]
    return "\n".join(_section(rows) for rows in sections)


def _section(rows: list[list[str]]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerows(rows)
    return buffer.getvalue()


def _numbers(values: Iterable[float]) -> list[str]:
    return [repr(float(value)) for value in values]


class Section(NamedTuple):
    """The names of the columns, their units, and the rows by their first entry; each with the number of its line."""

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
    sections = _sections(text)
    for name in (JOINT, POSE):
        if name not in sections:
            raise ValueError(f"got no section {name}, expected a line that begins with {name},x,y,z")
    joints, pose = sections[JOINT], sections[POSE]
    points, (p, s) = _vectors(joints, JOINTS), _vectors(pose, (P, O))
    rotation = _vectors(sections[ROTATION], ROWS_OF_Q) if ROTATION in sections else np.eye(3)
    length = _length(sections[SETTING]) if SETTING in sections else 1.0
    geometry = Geometry(**dict(zip(TRIPLES, points.reshape(4, 3, 3), strict=True)))
    return geometry, Configuration(p, rotation, s), length, _unit(joints, pose)


def _sections(text: str) -> dict[str, Section]:
    sections: dict[str, Section] = {}
    rows: dict[str, tuple[int, list[str]]] | None = None
    reader = csv.reader(text.split("\n"))
    try:
        for entries in reader:
            name, *rest = [cleaned(entry.strip()) for entry in entries] or [""]
            if name.startswith("#") or not any((name, *rest)):
                continue
            line = reader.line_num
            if name not in SECTIONS and rows is None:
                raise ValueError(
                    f"line {line}: got {shown(name)}, expected the header of a section, such as joint,x,y,z"
                )
            if name in (sections if name in SECTIONS or rows is None else rows):
                raise ValueError(f"line {line}: got {name} twice, expected it once")
            if name in SECTIONS:
                columns = [column.partition(" (") for column in rest]
                rows = {}
                sections[name] = Section(line, [c[0] for c in columns], [c[2].rstrip(")") for c in columns], rows)
            elif rows is not None:
                rows[name] = line, rest
    except csv.Error as error:
        raise ValueError(f"not a CSV file ({error})") from None
    return sections


def _unit(*sections: Section) -> str:
    """Return the unit that all columns of lengths name."""
    first = sections[0].units[sections[0].columns.index("x")]
    for section in sections:
        for name in AXES:
            unit, where = section.units[section.columns.index(name)], f"line {section.line}, column {name}"
            if unit != first:
                raise ValueError(f"{where}: got {unit or 'no unit'}, expected {first or 'none'}")
            try:
                unit_argument(unit)
            except ValueError as error:
                raise ValueError(f"{where}: {error}") from None
    return first


def _vectors(section: Section, names: Sequence[str]) -> Floats:
    """Return the columns x, y and z of the named rows, shape (n, 3); raise for rows that are missing or not known."""
    where, columns = f"line {section.line}", section.columns
    if any(columns.count(axis) != 1 for axis in AXES):
        raise ValueError(f"{where}: got {','.join(columns)}, expected the columns x, y and z, each once")
    for name, (line, _) in section.rows.items():
        if name not in names:
            hint = did_you_mean(name, names)
            raise ValueError(f"line {line}: got {shown(name)}, expected one of {', '.join(names)}{hint}")
    if missing := [name for name in names if name not in section.rows]:
        raise ValueError(f"{where}: got no {', '.join(missing)} below, expected a row for each")
    return np.array([[_number(*section.rows[name], columns.index(axis), axis) for axis in AXES] for name in names])


def _number(line: int, entries: Sequence[str], index: int, name: str) -> float:
    entry = entries[index] if index < len(entries) else ""
    try:
        value = float(entry)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f"line {line}, column {name}: got {shown(entry)}, expected a finite number")
    return value


def _length(section: Section) -> float | str:
    for name, (line, entries) in section.rows.items():
        if name != LENGTH:
            raise ValueError(f"line {line}: got {shown(name)}, expected {LENGTH}")
        if entries[:1] and entries[0] in KINDS:
            return entries[0]
        value = _number(line, entries, 0, "value")
        if value <= 0.0:
            raise ValueError(f"line {line}: got {value:g}, expected a positive number or one of {', '.join(KINDS)}")
        return value
    return 1.0


FORMAT = Format("csv", ".csv", "coordinates of the joints", text, read, mark=",base x")
