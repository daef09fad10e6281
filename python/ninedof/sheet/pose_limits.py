"""The limits of a study at each pose of a stack: values and margins."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ninedof.conditioning.conditioning import condition_number
from ninedof.design.limit_numbers import CLEARANCE, PARTS, SPREADS, apart, limit_numbers
from ninedof.design.limits import ROWS
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.robot.leg_names import LEGS
from ninedof.support.arrays import Floats
from ninedof.support.margins import margin_of


class PoseLimit(NamedTuple):
    """One side of a limit of a study for one leg, or of one that legs share, at each pose of a stack."""

    name: str
    """Of the constraint: "base_cone"."""
    part: str
    """The leg or the determinant; "" for a limit that has no parts."""
    side: str
    """"min" or "max"."""
    limit: float
    """Angles in radians, lengths in the unit of the study."""
    value: Floats
    """Shape (n,), in the unit of the limit."""
    margin: Floats
    """As `margin_of`, negative where the limit is passed; shape (n,)."""

    @property
    def label(self) -> str:
        """In words: "base_cone l1"."""
        return f"{self.name} {self.part}".strip()


def pose_limits(
    study: Study,
    g: Geometry,
    c: Configuration,
    neutral: Configuration,
    characteristic_length: float,
    beside: Floats | None = None,
) -> list[PoseLimit]:
    """Return every limit that a study has at its poses.

    Limits on the spread of lengths compare poses: at each they are taken over the stack up to it. The ways to the poses
    that `singularity_free` tests are left out: its determinants are those of the poses. Legs whose joints coincide in
    every design of the study are exempt from `leg_clearance`.

    Parameters
    ----------
    study : Study
    g : Geometry
    c : Configuration, shape (n,)
    neutral : Configuration
        A single one, for the axes of cones, signs of determinants and units of zp.
    characteristic_length : float
        For `condition_limit` and `fault_tolerant`.
    beside : array_like, shape (m, 9), optional
        Leg lengths at other poses: with them the spread at a pose is over these and that pose alone, whatever the order
        of the stack.

    """
    rows = list[PoseLimit]()
    for limit in study.limits:
        name, kind = limit.name, limit.row.kind
        if limit.at != "poses":
            continue
        unit = study.zp(neutral) if limit.of == "zp" else 1.0
        if name == CLEARANCE:
            numbers = limit_numbers(study.limit_for_core(limit), g, c, neutral)
            values = [("", numbers[:, apart(g, study)].min(axis=1, initial=math.inf))]
        elif name in PARTS:
            numbers = limit_numbers(study.limit_for_core(limit), g, c, neutral, characteristic_length)
            values = list(zip(PARTS[name], numbers.T, strict=True))
        else:
            values = _spreads(name, leg_lengths(g, c), beside) if name in SPREADS else []
        for part, value in values:
            for side, end in limit.sides.items():
                margin = margin_of(kind, side, unit * end, value)
                rows.append(PoseLimit(name, part, side, unit * end, value, margin))
    if (most := study.objective.condition_limit) is not None:
        kappa = np.asarray(condition_number(g, c, characteristic_length))
        rows.append(PoseLimit("condition_limit", "", "max", most, kappa, margin_of("ratio", "max", most, kappa)))
    return rows


def _spreads(name: str, lengths: Floats, beside: Floats | None) -> list[tuple[str, Floats]]:
    """Return the spread of lengths that a limit is about at each pose, by leg or of all legs."""
    if beside is None:
        long, short = np.maximum.accumulate(lengths, axis=0), np.minimum.accumulate(lengths, axis=0)
    else:
        long, short = np.maximum(lengths, beside.max(axis=0)), np.minimum(lengths, beside.min(axis=0))
    if name == "leg_ratio":
        return [("", long.max(axis=1) / short.min(axis=1))]
    spread = long - short if ROWS[name].kind == "length" else long / short
    return list(zip(LEGS, spread.T, strict=True))
