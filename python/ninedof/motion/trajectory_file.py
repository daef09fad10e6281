"""Reads a trajectory from a CSV file: the first line names the columns."""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Sequence

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
IN_DEGREES = [tuple(name + DEGREES for name in way) for way in (VECTOR, EULER)]
WAYS = (QUATERNION, VECTOR, IN_DEGREES[0], EULER, IN_DEGREES[1])  # to give the rotation
ONE_OF = "one of " + ", ".join(map(" ".join, WAYS))
FEWEST = 3  # poses: accelerations need three
UNIT = 1e-3  # a quaternion may differ from unit length by rounding, not by more

Poses = tuple[Floats, Floats, Floats | None]
"""Time (n,), position (n, 3) and, where the file has one, rotation (n, 3, 3)."""


def read_trajectory(path: str | os.PathLike[str], unit: str) -> Poses:
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
    for name, _, end in named:
        if name in PLACE[1:] and end and unit and (of_file := end.rstrip(")")) != unit:
            raise ValueError(f"{file}, line {line}, column {name}: got {of_file}, expected {unit} as in the design")
    way = _way(f"{file}, line {line}", names)
    if len(body) < FEWEST:
        raise ValueError(f"{file}: got {len(body)} poses, expected at least {FEWEST}")
    columns = dict(zip(names, _numbers(file, names, body).T, strict=True))
    time, position = columns["t"], np.stack([columns[name] for name in PLACE[1:]], axis=1)
    if k := _first(np.diff(time, prepend=-np.inf) <= 0.0):
        place = f"{file}, line {body[k][0]}, column t"
        raise ValueError(f"{place}: got {time[k]:g} after {time[k - 1]:g}, expected more")
    turns = np.stack([columns[name] for name in way], axis=1) if way else np.empty((len(time), 0))
    if way == QUATERNION:
        size = np.linalg.norm(turns, axis=1)
        if (k := _first(np.abs(size - 1.0) > UNIT)) is not None:
            place = f"{file}, line {body[k][0]}, column qw"
            raise ValueError(f"{place}: got a quaternion of length {size[k]:g}, expected 1")
        return time, position, from_quaternions(turns)
    angles = np.radians(turns) if way in IN_DEGREES else turns
    if way and way[0].startswith("yaw"):
        return time, position, from_euler(*angles.T)
    return time, position, from_vectors(angles) if way else None


def _way(where: str, names: Sequence[str]) -> tuple[str, ...]:
    """Return the columns of the rotation, none if there are none, or raise for missing and unknown columns."""
    for name in names:
        if _is_finite(name):
            raise ValueError(f"{where}: got the number {name}, expected the names of the columns, such as t,x,y,z")
        if names.count(name) > 1:
            raise ValueError(f"{where}, column {name}: got it twice, expected each column once")
    if missing := [name for name in PLACE if name not in names]:
        listed = cleaned(", ".join(names))
        raise ValueError(f"{where}: got columns {listed}, no {', '.join(missing)}; expected t, x, y, z")
    others = {name for name in names if name not in PLACE}
    for way in ((), *WAYS):
        if others == set(way):
            return way
    known = {name for way in WAYS for name in way}
    for name in names:
        if name in others - known:
            raise ValueError(f"{where}, column {shown(name)}: not known, expected t x y z and {ONE_OF}")
    listed = " ".join(name for name in names if name in others)
    raise ValueError(f"{where}: got {cleaned(listed)} as rotation, expected {ONE_OF}")


def _numbers(file: str, names: Sequence[str], body: Sequence[tuple[int, list[str]]]) -> Floats:
    for line, row in body:
        if len(row) != len(names):
            columns = cleaned(", ".join(names))
            raise ValueError(f"{file}, line {line}: got {len(row)} entries, expected {len(names)} ({columns})")
    try:
        table = np.array([[float(text) for text in row] for _, row in body])
    except ValueError:
        table = np.array([math.nan])
    if not np.isfinite(table).all():
        line, name, text = next(
            (line, name, text)
            for line, row in body
            for name, text in zip(names, row, strict=True)
            if not _is_finite(text)
        )
        raise ValueError(f"{file}, line {line}, column {name}: got {shown(text)}, expected a finite number")
    return table


def _is_finite(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _first(wrong: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> int | None:
    """Return where the first entry is that is true."""
    return int(np.argmax(wrong)) if wrong.any() else None
