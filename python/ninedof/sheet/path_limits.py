"""The limits of a study at each pose of a stack, and along a motion: values, margins, and when each is violated."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ninedof import _core
from ninedof.conditioning.conditioning import condition_number
from ninedof.design.limit_numbers import CLEARANCE, CONES, FORCES, PARTS, SPREADS, apart
from ninedof.design.limits import OF_LENGTHS, kind_of
from ninedof.design.objective import CONDITION_LIMIT
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.motion.follow import Followed, LimitBreak
from ninedof.robot.configuration import Configuration, single
from ninedof.robot.geometry import LEGS, Geometry
from ninedof.support.arguments import instance
from ninedof.support.arrays import Floats
from ninedof.support.margins import margin_of, tolerance_of
from ninedof.support.structs import from_core


class PoseLimit(NamedTuple):
    """One side of a limit of a study for one leg, or of one that legs share, at each pose of a stack."""

    name: str
    """Of the constraint."""
    part: str
    """The leg ("l1") or the determinant; "" for a limit that has no parts."""
    side: str
    """"min" or "max"."""
    limit: float
    """Angles in radians, lengths in the unit of the study."""
    value: Floats
    """Shape (n,), in the unit of the limit."""
    margin: Floats
    """As `margin_of`, negative where the limit is violated; shape (n,)."""

    @property
    def label(self) -> str:
        """In words: the name and the part."""
        return f"{self.name} {self.part}".strip()


def limits_at_poses(
    study: Study,
    g: Geometry,
    c: Configuration,
    neutral: Configuration,
    characteristic_length: float,
    beside: Floats | None = None,
) -> list[PoseLimit]:
    """Return every limit that a study has at its poses, of a design with a single neutral configuration.

    Limits on the spread of lengths compare poses: at each they are taken over the stack up to it or, with the lengths
    at other poses, shape (m, 9), `beside` it, over these and that pose alone. The ways to the poses that
    `singularity_free` tests are left out: its determinants are those of the poses. Legs whose joints coincide in every
    design of the study are exempt from `leg_clearance`.
    """
    rows = list[PoseLimit]()
    for limit in study.limits:
        name, kind = limit.name, limit.row.kind
        if limit.at != "poses":
            continue
        unit = study.zp(neutral) if limit.of == "zp" else 1.0
        values = _spreads(name, leg_lengths(g, c), beside) if name in SPREADS else []
        if name in PARTS:
            numbers = _core.limit_numbers(study.limit_for_core(limit), g, neutral, c, characteristic_length)
            values = list(zip(PARTS[name], numbers.T, strict=True))
            if name == CLEARANCE:
                values = [("", numbers[:, apart(g, study)].min(axis=1, initial=math.inf))]
        for part, value in values:
            for side, end in limit.sides.items():
                grows = side == "min" and name in SPREADS and beside is None  # along the stack: its end counts
                there = np.full_like(value, value[-1]) if grows else value
                margin = margin_of(kind, side, unit * end, there)
                rows.append(PoseLimit(name, part, side, unit * end, there, margin))
    if (most := study.objective.condition_limit) is not None:
        kappa = np.asarray(condition_number(g, c, characteristic_length))
        rows.append(PoseLimit(CONDITION_LIMIT, "", "max", most, kappa, margin_of("ratio", "max", most, kappa)))
    return rows


def _spreads(name: str, lengths: Floats, beside: Floats | None) -> list[tuple[str, Floats]]:
    """Return the spread of lengths that a limit is about at each pose, by leg or of all legs."""
    if beside is None:
        long, short = np.maximum.accumulate(lengths, axis=0), np.minimum.accumulate(lengths, axis=0)
    else:
        long, short = np.maximum(lengths, beside.max(axis=0)), np.minimum(lengths, beside.min(axis=0))
    numbers = _core.spread_numbers(name, long, short)
    return list(zip(LEGS if numbers.shape[1] > 1 else [""], numbers.T, strict=True))


def worst_of(limits: Iterable[PoseLimit]) -> list[tuple[PoseLimit, int]]:
    """Return, for each side of each limit, the part with the least margin, and the pose where it has it."""
    worst: dict[tuple[str, str], tuple[PoseLimit, int]] = {}
    for one in limits:
        key, k = (one.name, one.side), int(np.argmin(one.margin))
        if key in worst and one.margin[k] >= worst[key][0].margin[worst[key][1]]:
            continue
        worst[key] = one, k
    return list(worst.values())


@dataclass(frozen=True, eq=False, repr=False)
class PathLimits:
    """The limits of a study along a motion, over time."""

    time: Floats
    """Shape (n,)."""
    limits: tuple[PoseLimit, ...]
    """One for each side of each limit and each leg, with values and margins over time."""

    @cached_property
    def breaks(self) -> tuple[LimitBreak, ...]:
        """Stretches of time in which a limit is violated by more than 1e-6 of it; angles in radians."""
        breaks: list[LimitBreak] = []
        for one in self.limits:
            tolerance = tolerance_of(kind_of(one.name), one.limit)
            stretches = _core.stretches(f"{one.label} {one.side}", self.time, one.value, one.margin, tolerance)
            breaks += [from_core(LimitBreak, entry) for entry in stretches]
        return tuple(sorted(breaks, key=lambda stretch: (stretch.begin, stretch.limit)))

    @property
    def margins(self) -> dict[str, Floats]:
        """The least margin of each limit over its legs, by name, over time."""
        least: dict[str, Floats] = {}
        for one in self.limits:
            least[one.name] = np.minimum(least[one.name], one.margin) if one.name in least else one.margin
        return least

    def worst(self) -> list[dict[str, Any]]:
        """Return the least margin of each side of each limit as plain values; angles in degrees, as "limit_deg"."""
        rows = []
        for one, k in worst_of(self.limits):
            row = {"limit": one.limit, "value": float(one.value[k])}
            if one.name in CONES:
                row = {f"{name}_deg": float(np.degrees(value)) for name, value in row.items()}
            names = {"name": one.name, "kind": kind_of(one.name), "part": one.part, "side": one.side}
            rows.append(names | row | {"margin": float(one.margin[k]), "at": float(self.time[k])})
        return rows

    def __repr__(self) -> str:
        """Show the limits that are violated."""
        names = ", ".join(sorted({entry.limit for entry in self.breaks}))
        return f"<PathLimits: {len(self.time)} poses, {'breaks ' + names if names else 'within limits'}>"


def path_limits(study: Study, followed: Followed, home: Configuration) -> PathLimits:
    """Return the margins of the limits of a study along a motion.

    Every limit at poses but those on leg lengths, which are limits of `follow`: cones, clearance, determinants,
    condition number, and spreads of lengths. A spread at a time is that over the path until then. Limits of rates are
    held against those of the motion, and of forces and powers where it has loads, the largest of them; else those at
    rest count.

    Parameters
    ----------
    study : Study
    followed : Followed
        A motion of a design of the study.
    home : Configuration
        The neutral configuration, a single one: for the axes of cones and the signs of determinants.

    Examples
    --------
    >>> import ninedof as nd
    >>> study = nd.Study(constraints={"base_cone_internal": {"max_deg": 5}})
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(3.9828, 2.4432)
    >>> motion = nd.follow(g, nd.Trajectory.line(home, [0.5, 0, 0]), home)
    >>> nd.path_limits(study, motion, home)
    <PathLimits: 1001 poses, breaks base_cone_internal r1 max, base_cone_internal r3 max>

    """
    instance("study", study, Study)
    g = instance("followed", followed, Followed).geometry
    single(g, home, "home")
    every = limits_at_poses(study, g, followed.configurations, home, followed.characteristic_length)
    forces, rates = followed.leg_forces, followed.leg_rates
    moving = {"rate": rates} if forces is None else {"rate": rates, FORCES: forces, "power": forces * rates}
    rows = [one for one in every if one.name not in OF_LENGTHS and kind_of(one.name) not in moving]
    return PathLimits(followed.time, (*rows, *_of_motion(study, moving)))


def _of_motion(study: Study, values: Mapping[str, Floats]) -> Iterator[PoseLimit]:
    """Yield the limits of a motion on its values by kind, shape (n, 9) or (k, n, 9): the largest of k loads."""
    for limit in study.limits:
        if limit.kind not in values or limit.at != "poses":
            continue
        moduli = np.abs(values[limit.kind])
        most = moduli.reshape(-1, *moduli.shape[-2:]).max(axis=0)
        for leg in PARTS[limit.name]:
            value = most[:, LEGS.index(leg)]
            margin = margin_of(limit.kind, "max", limit.high, value)
            yield PoseLimit(limit.name, leg, "max", limit.high, value, np.asarray(margin))
