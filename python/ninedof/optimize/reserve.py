"""The reserve that a study with tolerances leaves to its limits, so that every machine within them keeps them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any

from ninedof import _core
from ninedof.design.duty import Tolerances
from ninedof.design.limits import Limit
from ninedof.design.region_poses import places_o
from ninedof.design.study import Study
from ninedof.proof.machine import posed_robot
from ninedof.proof.machine_record import PROVED
from ninedof.support.arguments import finite, flag, table, text
from ninedof.support.schema import Table, entry
from ninedof.support.short import short_repr

ROUNDS = 6  # two are enough where limits change little with the design
MORE = 1.02  # of what a proof lacks: a limit on its edge would be proved by rounding only
FOR_PROOF = 5.0  # seconds of each limit


def _shares(name: str, value: Any) -> dict[str, float]:
    return {text(name, key): finite(name, share, 0.0) for key, share in table(name, value).items()}


@short_repr
@dataclass(frozen=True)
class Reserve(Table):
    """What the search kept of each limit in the place of all of it."""

    shares: dict[str, float] = entry(_shares)
    """By label and side, "stroke_ratio max": the part of the limit; only of limits that need a reserve."""
    proved: bool = entry(flag, False)
    """Whether all limits are proved of every machine within the tolerances, at every pose."""
    note: str = entry(text, "")
    """Why it is not proved."""

    def study(self, study: Study) -> Study:
        """Return the study that was solved: with limits that leave the reserve, and without tolerances."""
        constraints: dict[str, list[Limit]] = {}
        for limit in study.limits:
            low, high = (self.shares.get(f"{limit.label} {side}", 1.0) for side in ("min", "max"))
            kept = replace(limit, low=limit.low * low, high=limit.high * high)
            constraints.setdefault(limit.name, []).append(kept)
        return replace(study, constraints=constraints, tolerances=Tolerances())

    @property
    def words(self) -> list[str]:
        """The reserve in sentences."""
        parts = [f"{name.replace('_', ' ')} {100.0 * abs(1.0 - share):.2g} %" for name, share in self.shares.items()]
        out = [f"reserve for the tolerances: {', '.join(parts)}"] if parts else []
        return [*out, "proved of every machine within the tolerances" if self.proved else self.note]


def with_reserve(result: Any, solve: Callable[[Study, Any], Any], threads: int) -> Any:
    """Return the result whose limits are proved of every machine within the study's tolerances, if one is found.

    What the proof of a design lacks is taken from its limits, and the study solved anew from there, until the proof
    succeeds.

    Parameters
    ----------
    result : Result
        Of the study without a reserve.
    solve : callable
        Solves a study, from a result.
    threads : int

    """
    study, reserve, first = result.study, Reserve({}), result
    region = study.objective.region
    if region is not None and not places_o(region):
        return replace(result, reserve=Reserve({}, False, "no reserve for tolerances: O is placed anew at every pose"))
    for _ in range(ROUNDS):
        if result.best is None or result.interrupted:
            break
        open_ones = list(_open(study, result, threads))
        if not open_ones:
            return replace(_of(study, result, first), reserve=replace(reserve, proved=True, note=""))
        shares, names = dict(reserve.shares), []
        for limit in open_ones:
            name = f"{limit.name} {limit.side}"
            worst = limit.value[limit.side == "max"]
            share = limit.limit / worst if 0.0 < worst < math.inf else 0.0
            lacking = (1.0 - share) * MORE
            names.append(name.replace("_", " "))
            shares[name] = shares.get(name, 1.0) * (1.0 - lacking)
        words = f"not proved of every machine within the tolerances: {', '.join(names)}"
        reserve = Reserve({key: share for key, share in shares.items() if 0.1 < share < 10.0}, False, words)
        if len(reserve.shares) < len(shares) or any(limit.limit == 0.0 for limit in open_ones):
            break
        result = solve(reserve.study(study), result)
    return replace(_of(study, result, first), reserve=reserve)


def _of(study: Study, result: Any, first: Any) -> Any:
    """Return a result as one of the study itself."""
    reason = result.reason
    if result.best is None:
        reason = f"with a reserve for the tolerances: {reason}"
    return replace(result, study=study, reason=reason, actuators=first.actuators)


def _open(study: Study, result: Any, threads: int) -> Iterable[_core.LimitOverPoses]:
    """Yield the limits that are not proved of every machine within the tolerances."""
    best = result.best
    poses = best.configurations[: 1 + len(study.objective.poses)]
    robot = posed_robot(study, best.geometry, poses, best.characteristic_length, None, study.tolerances)
    for limit in _core.limits_over_poses(robot, study.problem(), 0.0, threads, FOR_PROOF).limits:
        if limit.answer != PROVED:
            yield limit
