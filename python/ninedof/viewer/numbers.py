"""Everything a viewer shows about one configuration, as plain numbers: pure functions."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ninedof.conditioning.conditioning import condition_number, singular_values
from ninedof.design.limit_numbers import CONES, SPREADS
from ninedof.design.limits import OF_LENGTHS, ROWS, kind_of, split_label
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import LEGS
from ninedof.sheet.path_limits import PoseLimit, limits_at_poses, worst_of
from ninedof.sheet.rows import LimitRow
from ninedof.singularity.singularity import SingularityMargins, singularity_margins
from ninedof.support.arrays import Floats
from ninedof.support.margins import is_violated, margin_of
from ninedof.viewer.machine import Variant

RANGE = "leg_range"
"""Name of a limit of a leg that the region of the study makes."""


@dataclass(frozen=True, eq=False)
class Numbers:
    """The numbers of a configuration."""

    condition_number: float
    """Of J'; infinite where singular."""
    singular_values: Floats
    """Of J', descending, shape (6,)."""
    leg_lengths: Floats
    """Shape (9,): l1 l2 l3 q1 q2 q3 r1 r2 r3."""
    leg_margins: Floats
    """The least margin of each leg over its limits of length, shape (9,); infinite without one."""
    determinants: SingularityMargins
    limits: tuple[LimitRow, ...]
    """Every limit of the study at its worst leg, with the name of that leg: "base_cone l1". Of a limit of the design
    the margin alone is known: its side is "", limit and value are NaN."""
    cones_passed: frozenset[tuple[str, int]]
    """("base" or "platform", leg 0 to 8) of joints turned beyond their cone."""

    @property
    def legs_out(self) -> tuple[bool, ...]:
        """Whether each leg is beyond a limit of its length."""
        return tuple(is_violated(margin) for margin in self.leg_margins)


def numbers_of(variant: Variant, c: Configuration) -> Numbers:
    """Return the numbers of a single configuration."""
    g = variant.geometry
    limits = limits_at(variant, c)
    legs, cones = np.full(9, math.inf), set()
    for one in limits:
        margin = float(one.margin[0])
        if one.part in LEGS and (one.name in OF_LENGTHS or one.name in SPREADS or one.name == RANGE):
            legs[LEGS.index(one.part)] = min(legs[LEGS.index(one.part)], margin)
        elif one.name in CONES and is_violated(margin):
            cones.add((ROWS[one.name].body, LEGS.index(one.part)))
    return Numbers(
        condition_number=float(condition_number(g, c, variant.length)),
        singular_values=np.asarray(singular_values(g, c, variant.length)),
        leg_lengths=np.asarray(leg_lengths(g, c)),
        leg_margins=legs,
        determinants=singularity_margins(g, c),
        limits=(*_worst(limits), *_of_design(variant, limits)),
        cones_passed=frozenset(cones),
    )


def limits_at(variant: Variant, c: Configuration) -> list[PoseLimit]:
    """Return every limit of a single configuration, its arrays of shape (1,): of the study, and the ranges of legs."""
    limits, g = list[PoseLimit](), variant.geometry
    c = Configuration(c.position[None], c.rotation[None], c.internal_point[None])
    if variant.study is not None:
        limits = limits_at_poses(variant.study, g, c, variant.home, variant.length, variant.study_lengths)
    lengths = leg_lengths(g, c)
    limited = {(one.part, one.side): one.limit for one in limits if one.name in OF_LENGTHS}
    for k, leg in enumerate(LEGS):
        for side, end in (("min", variant.leg_low[k]), ("max", variant.leg_high[k])):
            own = limited.get((leg, side))  # of the study; the range that the region leaves may be narrower
            if 0.0 < end < math.inf and (own is None or not math.isclose(own, end)):
                margin = margin_of("length", side, end, lengths[:, k])
                limits.append(PoseLimit(RANGE, leg, side, end, lengths[:, k], margin))
    return limits


def _worst(limits: Sequence[PoseLimit]) -> Iterator[LimitRow]:
    for one, _ in worst_of(limits):
        value, margin = float(one.value[0]), float(one.margin[0])
        yield LimitRow(one.label, one.side, float(one.limit), value, margin, one.part, _kind(one.name))


def _of_design(variant: Variant, limits: Sequence[PoseLimit]) -> list[LimitRow]:
    of_pose = {one.name for one in limits}
    return [
        LimitRow(name, "", math.nan, math.nan, margin, "", _kind(name))
        for name, margin in (variant.margins or {}).items()
        if name not in of_pose and not name.startswith("condition")
    ]


def _kind(label: str) -> str:
    name = split_label(label)[0]
    return "length" if name == RANGE else kind_of(name)
