"""The run folder of a motion: record, motion.npz, legs.csv in the order of controllers, poses.csv.

Where the motion names its length unit, the names of columns have it in brackets: "l1 (mm)", "l1_rate (mm/s)".
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ninedof.design.limit_numbers import CONES
from ninedof.motion import Followed
from ninedof.robot.leg_names import LEGS
from ninedof.runs.folder import Record, write_drawn
from ninedof.sheet.path_limits import PathLimits
from ninedof.support.arrays import Floats
from ninedof.support.files import write_whole
from ninedof.support.units import per, with_unit

LEGS_FILE, POSES_FILE, ARRAYS_FILE = "legs.csv", "poses.csv", "motion.npz"
LENGTHS = ("x", "y", "z", "o_x", "o_y", "o_z")  # columns of poses.csv
RATE, ACCELERATION, FORCE = "_rate", "_acceleration", "_force"


def write_motion(
    found: Followed,
    directory: str | os.PathLike[str],
    draw: Callable[[Path], Sequence[Path]] | None = None,
    asked: Mapping[str, Any] | None = None,
    limits: PathLimits | None = None,
) -> Path:
    """Write a motion into an existing directory; return the path of its record.

    Parameters
    ----------
    found : Followed
    directory : path
    draw : callable, optional
        Called with the directory after the record was written; draws figures there and returns their paths.
    asked : mapping, optional
        What was asked, for the record.
    limits : PathLimits, optional
        Those of a study: their worst values and breaks join the record, their margins poses.csv.

    """
    folder = Path(directory)
    write_whole(folder / LEGS_FILE, legs_csv(found))
    write_whole(folder / POSES_FILE, _csv(*_poses(found, {} if limits is None else limits.margins)))
    found.save(folder / ARRAYS_FILE)
    files = (LEGS_FILE, POSES_FILE, ARRAYS_FILE)
    record = Record("motion", asked or {}, {"motion": plain(found, limits)}, files=files)
    return write_drawn(record, folder, draw)


def load_motion(path: str | os.PathLike[str]) -> Followed:
    """Read a motion from its run folder or the record there."""
    place = Path(path)
    return Followed.load((place if place.is_dir() else place.parent) / ARRAYS_FILE)


def legs_csv(found: Followed) -> bytes:
    """Return legs.csv: time, lengths, rates and accelerations of the legs, and forces if there is a load."""
    return _csv(*_legs(found))


def plain(found: Followed, limits: PathLimits | None) -> dict[str, Any]:
    """Return a motion with the limits of a study as plain values; angles in degrees, as "worst_deg"."""
    out = found.to_dict()
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


def _legs(found: Followed) -> tuple[list[str], Iterable[Floats]]:
    """Return t, nine lengths, nine rates, nine accelerations, and nine forces if there is a load."""
    parts = {"": found.leg_lengths, RATE: found.leg_rates, ACCELERATION: found.leg_accelerations}
    if found.leg_forces is not None:
        parts[FORCE] = found.leg_forces
    units = {"": found.unit, RATE: per(found.unit, "s"), ACCELERATION: per(found.unit, "s^2"), FORCE: ""}
    names = ["t", *(with_unit(leg + what, units[what]) for what in parts for leg in LEGS)]
    return names, (found.time[:, None], *parts.values())


def _poses(found: Followed, margins: Mapping[str, Floats]) -> tuple[list[str], Iterable[Floats]]:
    c = found.configurations
    x, y, z, o_x, o_y, o_z = (with_unit(name, found.unit) for name in LENGTHS)
    names = ["t", x, y, z, *(f"Q{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)), o_x, o_y, o_z, "condition_number"]
    names += [*found.singularity_margins._fields, "leg_margin", *(f"margin_{name}" for name in margins)]
    last = (found.condition_number, *found.singularity_margins, found.leg_margins.min(axis=1), *margins.values())
    return names, (found.time[:, None], c.position, c.rotation.reshape(-1, 9), c.internal_point, np.stack(last, axis=1))


def _csv(names: Sequence[str], columns: Iterable[Floats]) -> bytes:
    """Return a table whose numbers read back to the same bits."""
    rows = np.concatenate(list(columns), axis=1).tolist()
    return "\n".join([",".join(names), *(",".join(map(repr, row)) for row in rows), ""]).encode()
