"""Everything a viewer shows about one configuration, as plain numbers: pure functions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ninedof.conditioning.conditioning import condition_number, singular_values
from ninedof.design.leg_limits import LEGS as OF_LENGTHS
from ninedof.design.leg_limits import SPREADS
from ninedof.design.limit_numbers import CONES
from ninedof.design.limits import ROWS, split_label
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.robot.leg_names import LEGS
from ninedof.sheet.pose_limits import PoseLimit, pose_limits
from ninedof.singularity.singularity import SingularityMargins, singularity_margins
from ninedof.support.arrays import Floats
from ninedof.support.margins import is_violated, margin_of

DETERMINANTS = ("det N", "det B", "det C")


@dataclass(frozen=True)
class Limit:
    """One side of one limit, at its worst leg."""

    name: str
    """Of the constraint, with its leg or determinant: "base_cone l1"; "l1" for the range of a leg."""
    side: str
    """"min", "max", or "" for a limit of the design, of which the margin alone is known."""
    limit: float
    """Angles in degrees; NaN for a limit of the design."""
    value: float
    margin: float
    """As `margin_of`, negative where the limit is passed."""
    unit: str
    """"ratio", "length", "angle" or "sign"."""

    @property
    def passed(self) -> bool:
        """Whether the limit is passed."""
        return is_violated(self.margin, self.unit, self.limit)


@dataclass(frozen=True, eq=False)
class Numbers:
    """What is shown of a configuration."""

    condition_number: float
    """Of J'; infinite where singular."""
    singular_values: Floats
    """Of J', descending, shape (6,)."""
    leg_lengths: Floats
    """Shape (9,): l1 l2 l3 q1 q2 q3 r1 r2 r3."""
    leg_margins: Floats
    """The least margin of each leg over its limits of length, shape (9,); infinite without one."""
    determinants: SingularityMargins
    limits: tuple[Limit, ...]
    """Every limit of the study, the least margin of each."""
    cones_passed: frozenset[tuple[str, int]]
    """("base" or "platform", leg 0 to 8) of joints turned beyond their cone."""

    @property
    def legs_out(self) -> tuple[bool, ...]:
        """Whether each leg is beyond a limit of its length."""
        return tuple(is_violated(margin) for margin in self.leg_margins)


@dataclass(frozen=True, eq=False)
class Yardstick:
    """What numbers are held against: it changes with the design, and not with the pose."""

    study: Study | None
    neutral: Configuration
    length: float
    """Characteristic length."""
    leg_low: Floats
    """Least length of each leg, shape (9,)."""
    leg_high: Floats
    beside: Floats | None
    """Leg lengths at the poses of the study, shape (m, 9): spreads are taken over them and the pose shown."""
    design_margins: tuple[tuple[str, float], ...]
    """Least margin of every constraint at the study's own poses, by name."""


def margins_at(yard: Yardstick, g: Geometry, c: Configuration) -> list[PoseLimit]:
    """Return every limit of a pose for each pose of a stack, shape (n,): those of the study, and the ranges of legs."""
    found = []
    if yard.study is not None:
        found = pose_limits(yard.study, g, c, yard.neutral, yard.length, yard.beside)
    given = {(k, one.side) for one in found if one.name in OF_LENGTHS for k in [LEGS.index(one.part)]}
    lengths = leg_lengths(g, c)
    for k, name in enumerate(LEGS):
        for side, end in (("min", yard.leg_low[k]), ("max", yard.leg_high[k])):
            if 0.0 < end < math.inf and (k, side) not in given:
                margin = margin_of("length", side, end, lengths[:, k])
                found.append(PoseLimit("leg_range", name, side, float(end), lengths[:, k], margin))
    return found


def numbers(yard: Yardstick, g: Geometry, c: Configuration) -> Numbers:
    """Return what is shown of a single configuration."""
    lengths = leg_lengths(g, c)
    found = margins_at(yard, g, Configuration(c.position[None], c.rotation[None], c.internal_point[None]))
    legs = np.full(9, math.inf)
    cones = set()
    for one in found:
        margin = float(one.margin[0])
        if one.part in LEGS and (one.name in OF_LENGTHS or one.name in SPREADS or one.name == "leg_range"):
            legs[LEGS.index(one.part)] = min(legs[LEGS.index(one.part)], margin)
        elif one.name in CONES and is_violated(margin):
            cones.add((one.name.partition("_")[0], LEGS.index(one.part)))
    return Numbers(
        condition_number=float(condition_number(g, c, yard.length)),
        singular_values=np.asarray(singular_values(g, c, yard.length)),
        leg_lengths=np.asarray(lengths),
        leg_margins=legs,
        determinants=singularity_margins(g, c),
        limits=(*_worst(found), *_of_design(yard, found)),
        cones_passed=frozenset(cones),
    )


def _worst(found: Sequence[PoseLimit]) -> list[Limit]:
    """Return the side and leg of least margin of each limit."""
    worst: dict[tuple[str, str], PoseLimit] = {}
    for one in found:
        key = (one.name, one.side)
        if key not in worst or not one.margin[0] >= worst[key].margin[0]:
            worst[key] = one
    rows = []
    for (name, side), one in worst.items():
        kind = "length" if name == "leg_range" else _kind(name)
        limit, value = (math.degrees(x) if kind == "angle" else float(x) for x in (one.limit, one.value[0]))
        rows.append(Limit(one.label, side, limit, value, float(one.margin[0]), kind))
    return rows


def _kind(label: str) -> str:
    name = split_label(label)[0]
    return ROWS[name].kind if name in ROWS else "ratio"


def _of_design(yard: Yardstick, found: Sequence[PoseLimit]) -> list[Limit]:
    """Return the limits that belong to the design and not to a pose."""
    of_pose = {one.name for one in found}
    return [
        Limit(name, "", math.nan, math.nan, margin, _kind(name))
        for name, margin in yard.design_margins
        if name not in of_pose and not name.startswith("condition")
    ]
