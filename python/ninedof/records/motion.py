"""The run folder of a motion: record, motion.npz, legs.csv in the order of controllers, poses.csv.

Where the motion names its length unit, the names of columns have it in brackets: "l1 (mm)", "l1_rate (mm/s)".
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ninedof.design.limit_numbers import CONES
from ninedof.motion import Followed
from ninedof.records.record import ARRAYS, Draw, Record, write_drawn
from ninedof.robot.leg_names import LEGS
from ninedof.sheet.path_limits import PathLimits
from ninedof.support.arrays import Floats
from ninedof.support.files import write_whole
from ninedof.support.units import per, with_unit

LEGS_FILE, POSES_FILE, ARRAYS_FILE = "legs.csv", "poses.csv", ARRAYS["motion"][1]
LENGTHS = ("x", "y", "z", "o_x", "o_y", "o_z")  # columns of poses.csv
RATE, ACCELERATION, FORCE, POWER = "_rate", "_acceleration", "_force", "_power"


def write_motion(
    motion: Followed,
    directory: str | os.PathLike[str],
    draw: Draw | None = None,
    question: Mapping[str, Any] | None = None,
    limits: PathLimits | None = None,
) -> Path:
    """Write a motion into an existing directory; return the path of its record.

    Parameters
    ----------
    motion : Followed
    directory : path
    draw : callable, optional
        Called with the directory after the record was written; draws figures there and returns their paths.
    question : mapping, optional
        What was asked, for the record.
    limits : PathLimits, optional
        Those of a study: their worst values and breaks join the record, their margins poses.csv.

    """
    folder = Path(directory)
    write_whole(folder / LEGS_FILE, legs_csv(motion))
    write_whole(folder / POSES_FILE, _csv(*_poses(motion, {} if limits is None else limits.margins)))
    motion.save(folder / ARRAYS_FILE)
    files = (LEGS_FILE, POSES_FILE, ARRAYS_FILE)
    record = Record("motion", question or {}, {"motion": plain(motion, limits)}, files=files)
    return write_drawn(record, folder, draw)


def legs_csv(motion: Followed) -> bytes:
    """Return legs.csv: time, lengths, rates and accelerations of the legs, forces and powers of each load."""
    return _csv(*_legs(motion))


def plain(motion: Followed, limits: PathLimits | None) -> dict[str, Any]:
    """Return a motion with the limits of a study as plain values; angles in degrees, as "worst_deg"."""
    out = motion.to_dict()
    if limits is None:
        return out
    out["limits"] = limits.worst()
    for broken in limits.breaks:
        row = broken._asdict()
        if broken.limit.startswith(CONES):
            row["worst_deg"] = math.degrees(row.pop("worst"))
        out["breaks"].append(row)
    out["breaks"].sort(key=lambda row: (row["begin"], row["limit"]))
    return out


def _legs(motion: Followed) -> tuple[list[str], Iterable[Floats]]:
    """Return t, nine lengths, nine rates, nine accelerations, and nine forces and powers for each load."""
    unit, shape = motion.unit, (-1, len(motion.time), 9)
    parts = [("", unit, motion.leg_lengths), (RATE, per(unit, "s"), motion.leg_rates)]
    parts.append((ACCELERATION, per(unit, "s^2"), motion.leg_accelerations))
    if motion.leg_forces is not None and motion.leg_powers is not None:
        loads = zip(motion.leg_forces.reshape(shape), motion.leg_powers.reshape(shape), strict=True)
        for k, (forces, powers) in enumerate(loads, start=1):
            number = f"_{k}" if motion.load_count > 1 else ""
            parts.append((FORCE + number, motion.force_unit, forces))
            parts.append((POWER + number, "W" if motion.force_unit else "", powers))
    names = ["t", *(with_unit(leg + what, of) for what, of, _ in parts for leg in LEGS)]
    return names, (motion.time[:, None], *(values for *_, values in parts))


def _poses(motion: Followed, margins: Mapping[str, Floats]) -> tuple[list[str], Iterable[Floats]]:
    c = motion.configurations
    x, y, z, o_x, o_y, o_z = (with_unit(name, motion.unit) for name in LENGTHS)
    names = ["t", x, y, z, *(f"Q{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)), o_x, o_y, o_z, "condition_number"]
    names += [*motion.singularity_margins._fields, "leg_margin", *(f"margin_{name}" for name in margins)]
    last = (motion.condition_number, *motion.singularity_margins, motion.leg_margins.min(axis=1), *margins.values())
    return names, (
        motion.time[:, None],
        c.position,
        c.rotation.reshape(-1, 9),
        c.internal_point,
        np.stack(last, axis=1),
    )


def _csv(names: Sequence[str], columns: Iterable[Floats]) -> bytes:
    """Return a table whose numbers read back to the same bits."""
    rows = np.concatenate(list(columns), axis=1).tolist()
    return "\n".join([",".join(names), *(",".join(map(repr, row)) for row in rows), ""]).encode()
