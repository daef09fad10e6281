"""Reads the coordinates of joints from a CSV file: what the format "csv" writes, or a shorter file written by hand."""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ninedof.conditioning.characteristic_length import KINDS
from ninedof.export.csv import AXES, JOINT, LENGTH, POSE, ROTATION, ROWS_OF_Q, SECTIONS, SETTING
from ninedof.export.points import JOINTS, O, P
from ninedof.export.reading import Read
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import TRIPLES, Geometry
from ninedof.support.arguments import cleaned, did_you_mean, shown
from ninedof.support.arrays import Floats
from ninedof.support.files import read_text
from ninedof.support.units import unit_argument


class Row(NamedTuple):
    """The place of a line, for messages, and its entries."""

    where: str
    entries: list[str]


class Section(NamedTuple):
    """The header of a section, its first entry left out, and the rows by their first entry."""

    header: Row
    rows: dict[str, Row]


def read(path: str | os.PathLike[str]) -> Read:
    """Read a design from a CSV file of joint coordinates.

    A section begins with a line whose first entry names it. "joint" and "pose" are needed: the twelve joints, such as
    base_external_1, in the frame of their plate, and p and O in the base frame, with the columns x, y and z. "rotation"
    has the rows of Q (the identity without it) and "setting" the characteristic length (1 without it). The unit of
    lengths is that of the headers, "x (mm)". All else is left out: it follows from these numbers.

    Raises
    ------
    ValueError
        Naming the file, and the line where there is one.

    """
    file = os.fspath(path)
    sections = _sections(_lines(file))
    for name in (JOINT, POSE):
        if name not in sections:
            raise ValueError(f"{file}: got no section {name}, expected a line that begins with {name},x,y,z")
    joints, pose = sections[JOINT], sections[POSE]
    unit = _unit([joints, pose])
    points, (p, s) = _vectors(joints, JOINTS), _vectors(pose, (P, O))
    rotation = _vectors(sections[ROTATION], ROWS_OF_Q) if ROTATION in sections else np.eye(3)
    length = _length(sections[SETTING]) if SETTING in sections else 1.0
    try:
        geometry = Geometry(**dict(zip(TRIPLES, points.reshape(4, 3, 3), strict=True)))
        return geometry, Configuration(p, rotation, s), length, unit
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def _lines(file: str) -> list[Row]:
    try:
        reader = csv.reader(read_text(file).split("\n"))
        rows = [Row(f"{file}, line {reader.line_num}", [cleaned(entry.strip()) for entry in row]) for row in reader]
    except OSError as error:
        raise ValueError(f"{file}: cannot be read ({error.strerror or error})") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{file}: not a CSV file ({error})") from None
    return [row for row in rows if any(row.entries) and not row.entries[0].startswith("#")]


def _sections(rows: Sequence[Row]) -> dict[str, Section]:
    found: dict[str, Section] = {}
    rows_here: dict[str, Row] | None = None
    for where, (name, *entries) in rows:
        if name in SECTIONS:
            _require_once(where, name, found)
            rows_here = {}
            found[name] = Section(Row(where, entries), rows_here)
        elif rows_here is None:
            raise ValueError(f"{where}: got {shown(name)}, expected the header of a section, such as joint,x,y,z")
        else:
            _require_once(where, name, rows_here)
            rows_here[name] = Row(where, entries)
    return found


def _require_once(where: str, name: str, found: dict[str, Section] | dict[str, Row]) -> None:
    if name in found:
        raise ValueError(f"{where}: got {name} twice, expected it once")


def _column(header: str) -> tuple[str, str]:
    """Return the name and the unit of "x (mm)"."""
    name, _, unit = header.partition(" (")
    return name, unit.rstrip(")")


def _unit(sections: Sequence[Section]) -> str:
    """Return the unit that all columns of lengths name."""
    found: list[str] = []
    for section in sections:
        where, header = section.header
        for name, unit in map(_column, header):
            if name in AXES:
                try:
                    found.append(unit_argument(unit))
                except ValueError as error:
                    raise ValueError(f"{where}, column {name}: {error}") from None
                if unit != found[0]:
                    raise ValueError(f"{where}, column {name}: got {unit or 'no unit'}, expected {found[0] or 'none'}")
    return found[0] if found else ""


def _vectors(section: Section, names: Sequence[str]) -> Floats:
    """Return the columns x, y and z of the named rows, shape (n, 3); raise for rows that are missing or not known."""
    where, header = section.header
    columns = [_column(name)[0] for name in header]
    for axis in AXES:
        if columns.count(axis) != 1:
            raise ValueError(f"{where}: got {','.join(columns)}, expected the columns x, y and z, each once")
    for name, row in section.rows.items():
        if name not in names:
            raise ValueError(
                f"{row.where}: got {shown(name)}, expected one of {', '.join(names)}{did_you_mean(name, names)}"
            )
    missing = [name for name in names if name not in section.rows]
    if missing:
        raise ValueError(f"{where}: got no {', '.join(missing)} below, expected a row for each")
    return np.array([[_number(section.rows[name], columns.index(axis), axis) for axis in AXES] for name in names])


def _number(row: Row, index: int, name: str) -> float:
    entry = row.entries[index] if index < len(row.entries) else ""
    try:
        value = float(entry)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f"{row.where}, column {name}: got {shown(entry)}, expected a finite number")
    return value


def _length(section: Section) -> float | str:
    for name, row in section.rows.items():
        if name != LENGTH:
            raise ValueError(f"{row.where}: got {shown(name)}, expected {LENGTH}")
        entry = row.entries[0] if row.entries else ""
        if entry in KINDS:
            return entry
        value = _number(row, 0, "value")
        if value <= 0.0:
            raise ValueError(f"{row.where}: got {entry}, expected a positive number or one of {', '.join(KINDS)}")
        return value
    return 1.0
