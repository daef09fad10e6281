"""The limits of a study along a motion: margins over time, and when each is passed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ninedof.design.limit_numbers import CONES, PARTS
from ninedof.design.limit_numbers import LEGS as OF_LENGTHS
from ninedof.design.limits import kind_of
from ninedof.design.study import Study
from ninedof.motion.follow import Followed, LimitBreak, stretches
from ninedof.robot.configuration import Configuration, single
from ninedof.robot.leg_names import LEGS
from ninedof.sheet.pose_limits import PoseLimit, pose_limits
from ninedof.support.arguments import instance
from ninedof.support.arrays import Floats
from ninedof.support.margins import margin_of, tolerance_of


@dataclass(frozen=True, eq=False, repr=False)
class PathLimits:
    """The limits of a study along a motion, over time."""

    time: Floats
    """Shape (n,)."""
    limits: tuple[PoseLimit, ...]
    """One for each side of each limit and each leg, with values and margins over time."""

    @cached_property
    def breaks(self) -> tuple[LimitBreak, ...]:
        """Stretches of time in which a limit is passed by more than 1e-6 of it; angles in radians."""
        breaks: list[LimitBreak] = []
        for one in self.limits:
            tolerance = tolerance_of(kind_of(one.name), one.limit)
            breaks += stretches(f"{one.label} {one.side}", self.time, one.value, one.margin, tolerance)
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
        rows: dict[tuple[str, str], dict[str, Any]] = {}
        for one in self.limits:
            k = int(np.argmin(one.margin))
            margin = float(one.margin[k])
            if (key := (one.name, one.side)) in rows and rows[key]["margin"] <= margin:
                continue
            row = {"limit": one.limit, "value": float(one.value[k])}
            if one.name in CONES:
                row = {f"{name}_deg": float(np.degrees(value)) for name, value in row.items()}
            names = {"name": one.name, "kind": kind_of(one.name), "part": one.part, "side": one.side}
            rows[key] = names | row | {"margin": margin, "at": float(self.time[k])}
        return list(rows.values())

    def __repr__(self) -> str:
        """Show the limits that are passed."""
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

    Returns
    -------
    PathLimits

    Examples
    --------
    >>> import ninedof as nd
    >>> limits = {"base_cone": {"max_deg": 5}, "leg_clearance": {"radius": 0.05}}
    >>> study = nd.Study(variables={"a1": 0.0, "b2": 0.0}, constraints=limits)  # joints in pairs: these legs may meet
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(3.9828, 2.4432)
    >>> motion = nd.follow(g, nd.Trajectory.line(home, [0.5, 0, 0]), home)
    >>> nd.path_limits(study, motion, home)
    <PathLimits: 1001 poses, breaks base_cone l1 max, base_cone l2 max, base_cone r1 max, base_cone r3 max>

    """
    instance("study", study, Study)
    g = instance("followed", followed, Followed).geometry
    single(g, home, "home")
    every = pose_limits(study, g, followed.configurations, home, followed.characteristic_length)
    forces, rates = followed.leg_forces, followed.leg_rates
    moving = {"rate": rates} if forces is None else {"rate": rates, "force": forces, "power": forces * rates}
    rows = [one for one in every if one.name not in OF_LENGTHS and _duty_of(one.name) not in moving]
    return PathLimits(followed.time, (*rows, *_of_motion(study, moving)))


def _duty_of(name: str) -> str:
    """Return what a limit of legs is about: "force" for "force" and for "upper_force"."""
    return name.rpartition("_")[2]


def _of_motion(study: Study, values: Mapping[str, Floats]) -> Iterator[PoseLimit]:
    """Yield the limits of forces, rates and powers of a motion, shape (n, 9) or (k, n, 9): the largest of k loads."""
    for limit in study.limits:
        duty = _duty_of(limit.name)
        if duty not in values or limit.at != "poses":
            continue
        moduli = np.abs(values[duty])
        most = moduli.reshape(-1, *moduli.shape[-2:]).max(axis=0)
        for leg in PARTS[limit.name]:
            value = most[:, LEGS.index(leg)]
            margin = margin_of(limit.kind, "max", limit.high, value)
            yield PoseLimit(limit.name, leg, "max", limit.high, value, np.asarray(margin))
