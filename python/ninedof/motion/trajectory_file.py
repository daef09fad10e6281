"""Reads a trajectory from a CSV file: the first line names the columns."""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ninedof.motion.rotations import from_euler, from_quaternions, from_vectors
from ninedof.support.arguments import cleaned, path_argument, shown
from ninedof.support.arrays import Floats
from ninedof.support.files import read_text

PLACE = ("t", "x", "y", "z")
QUATERNION = ("qw", "qx", "qy", "qz")
VECTOR = ("rx", "ry", "rz")
EULER = ("yaw", "pitch", "roll")
DEGREES = "_deg"
WAYS = {  # to give the rotation
    QUATERNION: "quaternion",
    VECTOR: "rotation vector",
    tuple(name + DEGREES for name in VECTOR): "rotation vector",
    EULER: "Euler angles",
    tuple(name + DEGREES for name in EULER): "Euler angles",
}
FEWEST = 3  # poses: accelerations need three
UNIT = 1e-3  # a quaternion may differ from unit length by rounding, not by more


class Columns(NamedTuple):
    """What a file holds."""

    time: Floats
    position: Floats
    rotation: Floats | None


def read_trajectory(path: str | os.PathLike[str], unit: str) -> Columns:
    """Read a file; raise ValueError naming file, line and column, and where it names another unit of lengths."""
    file = str(path_argument("path", path))
    try:
        reader = csv.reader(read_text(path).split("\n"))
        rows = [(reader.line_num, row) for row in reader if any(row) and not row[0].lstrip().startswith("#")]
    except OSError as error:
        raise ValueError(f"{file}: cannot be read ({error.strerror or error})") from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{file}: not a CSV file ({error})") from None
    if not rows:
        raise ValueError(f"{file}: got an empty file, expected a line with the names of the columns")
    (line, header), *body = rows
    named = [cleaned(name.strip()).partition(" (") for name in header]  # "x (mm)", as `ninedof path` writes it
    names = [name for name, _, _ in named]
    _require_unit(f"{file}, line {line}", unit, {name: end.rstrip(")") for name, _, end in named if name in PLACE[1:]})
    way = _way(f"{file}, line {line}", names)
    if len(body) < FEWEST:
        raise ValueError(f"{file}: got {len(body)} poses, expected at least {FEWEST}")
    table = _numbers(file, names, body)
    lines_of = [number for number, _ in body]
    columns = {name: table[:, k] for k, name in enumerate(names)}
    _require_increasing(file, lines_of, columns["t"])
    position = np.stack([columns[name] for name in PLACE[1:]], axis=1)
    rotation = _rotation(file, lines_of, way, columns) if way else None
    return Columns(columns["t"], position, rotation)


def _require_unit(where: str, unit: str, found: dict[str, str]) -> None:
    for name, named in found.items():
        if named and unit and named != unit:
            raise ValueError(f"{where}, column {name}: got {named}, expected {unit} as in the design")


def _way(where: str, names: Sequence[str]) -> tuple[str, ...]:
    """Return the columns of the rotation, none if there are none, or raise for missing and unknown columns."""
    for name in names:
        if _is_finite(name):
            raise ValueError(f"{where}: got the number {name}, expected the names of the columns, such as t,x,y,z")
        if names.count(name) > 1:
            raise ValueError(f"{where}, column {name}: got it twice, expected each column once")
    missing = [name for name in PLACE if name not in names]
    if missing:
        raise ValueError(
            f"{where}: got columns {cleaned(', '.join(names))}, no {', '.join(missing)}; expected t, x, y, z"
        )
    others = [name for name in names if name not in PLACE]
    if not others:
        return ()
    for way in WAYS:
        if set(others) == set(way):
            return way
    known = {name for way in WAYS for name in way}
    for name in others:
        if name not in known:
            raise ValueError(f"{where}, column {shown(name)}: not known, expected t x y z and one of {_ways()}")
    raise ValueError(f"{where}: got {cleaned(' '.join(others))} as rotation, expected one of {_ways()}")


def _ways() -> str:
    return ", ".join(" ".join(way) for way in WAYS)


def _numbers(file: str, names: Sequence[str], body: Sequence[tuple[int, list[str]]]) -> Floats:
    for line, row in body:
        if len(row) != len(names):
            raise ValueError(
                f"{file}, line {line}: got {len(row)} entries, expected {len(names)} ({cleaned(', '.join(names))})"
            )
    try:
        table = np.array([[float(text) for text in row] for _, row in body])
        if np.isfinite(table).all():
            return table
    except ValueError:
        pass
    for line, row in body:
        for name, text in zip(names, row, strict=True):
            if not _is_finite(text):
                raise ValueError(f"{file}, line {line}, column {name}: got {shown(text)}, expected a finite number")
    raise AssertionError("unreachable")


def _is_finite(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _require_increasing(file: str, lines: Sequence[int], time: Floats) -> None:
    wrong = np.flatnonzero(~(np.diff(time) > 0.0))
    if len(wrong):
        k = int(wrong[0]) + 1
        raise ValueError(f"{file}, line {lines[k]}, column t: got {time[k]:g} after {time[k - 1]:g}, expected more")


def _rotation(file: str, lines: Sequence[int], way: tuple[str, ...], columns: dict[str, Floats]) -> Floats:
    given = np.stack([columns[name] for name in way], axis=1)
    if way == QUATERNION:
        size = np.linalg.norm(given, axis=1)
        wrong = np.flatnonzero(np.abs(size - 1.0) > UNIT)
        if len(wrong):
            k = int(wrong[0])
            raise ValueError(f"{file}, line {lines[k]}, column qw: got a quaternion of length {size[k]:g}, expected 1")
        return from_quaternions(given)
    angles = np.radians(given) if way[0].endswith(DEGREES) else given
    return from_euler(*angles.T) if WAYS[way] == "Euler angles" else from_vectors(angles)
