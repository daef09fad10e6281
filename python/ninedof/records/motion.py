"""The tables in the run folder of a motion: legs.csv in the order of controllers, poses.csv.

Where the motion names its length unit, the names of columns have it in brackets: "l1 (mm)", "l1_rate (mm/s)".
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ninedof.design.limit_numbers import CONES
from ninedof.motion import Followed
from ninedof.robot.geometry import LEGS
from ninedof.sheet.path_limits import PathLimits
from ninedof.support.arrays import Floats
from ninedof.support.kept.files import write_whole
from ninedof.support.units import per, with_unit

LEGS_FILE, POSES_FILE = "legs.csv", "poses.csv"
LENGTHS = ("x", "y", "z", "o_x", "o_y", "o_z")  # columns of poses.csv
RATE, ACCELERATION, FORCE, POWER = "_rate", "_acceleration", "_force", "_power"


def write_tables(motion: Followed, folder: Path, limits: PathLimits | None) -> list[Path]:
    """Write both tables, in poses.csv the margins of the limits of a study too; return their paths."""
    poses = _csv(_poses(motion, {} if limits is None else limits.margins))
    return [write_whole(folder / LEGS_FILE, legs_csv(motion)), write_whole(folder / POSES_FILE, poses)]


def legs_csv(motion: Followed) -> bytes:
    """Return legs.csv: t, nine lengths, rates and accelerations of the legs, nine forces and powers of each load."""
    unit, shape = motion.unit, (-1, len(motion.time), 9)
    parts = [("", unit, motion.leg_lengths), (RATE, per(unit, "s"), motion.leg_rates)]
    parts.append((ACCELERATION, per(unit, "s²"), motion.leg_accelerations))
    if motion.leg_forces is not None and motion.leg_powers is not None:
        loads = zip(motion.leg_forces.reshape(shape), motion.leg_powers.reshape(shape), strict=True)
        for k, (forces, powers) in enumerate(loads, start=1):
            number = f"_{k}" if motion.load_count > 1 else ""
            parts.append((FORCE + number, motion.force_unit, forces))
            parts.append((POWER + number, "W" if motion.force_unit else "", powers))
    columns = {with_unit("t", "s" * bool(unit)): motion.time}
    for what, of, values in parts:
        columns |= {with_unit(leg + what, of): values[:, k] for k, leg in enumerate(LEGS)}
    return _csv(columns)


def motion_values(motion: Followed, limits: PathLimits | None) -> dict[str, Any]:
    """Return a motion with the limits of a study as plain values; angles in degrees, as "worst_deg"."""
    out = motion.to_dict() | ({} if limits is None else {"limits": limits.worst()})
    for row in out["breaks"]:
        if row["limit"].startswith(CONES):
            row["worst_deg"] = math.degrees(row.pop("worst"))
    return out


def _poses(motion: Followed, margins: Mapping[str, Floats]) -> dict[str, Floats]:
    c, axes = motion.configurations, range(3)
    return {
        with_unit("t", "s" * bool(motion.unit)): motion.time,
        **{with_unit(LENGTHS[k], motion.unit): c.position[:, k] for k in axes},
        **{f"Q{i + 1}{j + 1}": c.rotation[:, i, j] for i in axes for j in axes},
        **{with_unit(LENGTHS[3 + k], motion.unit): c.internal_point[:, k] for k in axes},
        "condition_number": motion.condition_number,
        **motion.singularity_margins._asdict(),
        "leg_margin": motion.leg_margins.min(axis=1),
        **{f"margin_{name}": margin for name, margin in margins.items()},
    }


def _csv(columns: Mapping[str, Floats]) -> bytes:
    """Return a table whose numbers read back to the same bits."""
    rows = np.stack(list(columns.values()), axis=1).tolist()
    return "\n".join([",".join(columns), *(",".join(map(repr, row)) for row in rows), ""]).encode()
