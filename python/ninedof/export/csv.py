"""CSV: the coordinates of the joints, the neutral pose and the legs, in sections that a spreadsheet shows."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence

from ninedof.export.model import Model
from ninedof.export.points import JOINTS, LEGS, O, P, base_frame, own_frame
from ninedof.support.units import with_unit

AXES = ("x", "y", "z")
BASE_AXES = tuple(f"base {axis}" for axis in AXES)
JOINT, POSE, ROTATION, LEG, SETTING = SECTIONS = ("joint", "pose", "rotation", "leg", "setting")
"""First column of each section, which names it."""
ROWS_OF_Q = ("row 1", "row 2", "row 3")
LENGTH = "characteristic_length"
LEG_COLUMNS = ("from", "to", "neutral", "shortest", "longest")


def text(model: Model) -> str:
    """Return the file. Numbers are the shortest that read back to the same bits."""
    own, base = own_frame(model.geometry), base_frame(model.geometry, model.configuration)
    ranges = model.leg_ranges or [()] * len(LEGS)
    joints = [[name, *_numbers(own[name]), *_numbers(base[name])] for name in JOINTS]
    pose = [[name, *_numbers(base[name])] for name in (P, O)]
    rotation = [[name, *_numbers(row)] for name, row in zip(ROWS_OF_Q, model.configuration.rotation, strict=True)]
    legs = [
        [*leg, *_numbers([neutral, *ends])]
        for leg, neutral, ends in zip(LEGS, model.neutral_lengths, ranges, strict=True)
    ]
    length = model.characteristic_length
    settings = [[LENGTH, length if isinstance(length, str) else repr(float(length))]]

    def measured(names: Sequence[str]) -> list[str]:
        return [with_unit(name, model.unit) for name in names]

    leg_columns = [*LEG_COLUMNS[:2], *measured(LEG_COLUMNS[2:] if model.leg_ranges else LEG_COLUMNS[2:3])]
    sections = [
        [[JOINT, *measured(AXES), *measured(BASE_AXES)], *joints],
        [[POSE, *measured(AXES)], *pose],
        [[ROTATION, *AXES], *rotation],
        [[LEG, *leg_columns], *legs],
        [[SETTING, "value"], *settings],
    ]
    return "\n".join(_section(rows) for rows in sections)


def _section(rows: list[list[str]]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerows(rows)
    return buffer.getvalue()


def _numbers(values: Iterable[float]) -> list[str]:
    return [repr(float(value)) for value in values]
