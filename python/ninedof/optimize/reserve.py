"""Proofs about the machine of a result: its limits at every pose, its tolerances, and the reserve that these need."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

from ninedof.design.domains.region_poses import o_is_placed, placing_of
from ninedof.design.duty import LARGEST_TOLERANCE, Tolerances, tolerances_like
from ninedof.design.limit_numbers import crossed, with_scaled_limits
from ninedof.design.limits import limit_words
from ninedof.design.objective import CONDITION_LIMIT
from ninedof.design.study import Study
from ninedof.optimize.candidate import best_of
from ninedof.proof.machine import FOR_LIMITS, Certify, certify
from ninedof.proof.machine_limits import NEUTRAL_LIMIT, open_limits
from ninedof.proof.machine_record import UNDECIDED, MachineCertificate
from ninedof.proof.point_rule import PointRule, rule_of
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import LEGS, Geometry
from ninedof.sheet.rows import limit_rows
from ninedof.support.arguments import finite, flag, known_keys, table, text
from ninedof.support.running import Progress, phase, progress_argument
from ninedof.support.structs import Fixed, StudyTable, entry
from ninedof.support.text import short_repr
from ninedof.support.units import amount

PROOFS = 12  # about as many are needed for the largest tolerances
FIRST, LEAST, MOST = 1e-4, 1e-6, 0.05  # of the machine's height
STEP, HALVINGS = 4.0, 5


def certified(result: Any, options: dict[str, Any]) -> MachineCertificate:
    """Return the certificate of a machine, for the options of `Result.certify`."""
    design, place = machine_of(result), placing_of(result, result.configuration)
    progress = progress_argument(options.get("progress"))
    if options.get("rule") is None and options.get("resume") is None and place is not None:
        options["rule"] = lambda: rule_of(place, *design, options.get("threads", 0), progress)
    return certify(result.study, *design, **options)


def largest(result: Any, options: dict[str, Any]) -> tuple[Tolerances, bool]:
    """Return the largest tolerances of a machine, for the options of `Result.largest_tolerance`, and if time decided.

    They are looked for from those of the study on, from a millionth to a twentieth of the machine's height, to 5 %:
    none at all where not even the least ones are proved. A KeyboardInterrupt has the largest ones proved so far.
    """
    known_keys("largest_tolerance", options, {"condition_number", "slack", "time_limit", "threads", "rule", "progress"})
    study, place, design = result.study, placing_of(result, result.configuration), machine_of(result)
    request = Certify(**{"time_limit": 60.0, "slack": 0.0} | options)
    seconds, progress, rule = request.time_limit, request.progress, None
    if isinstance(request.rule, PointRule):
        rule = request.rule
    elif place is not None:
        rule = rule_of(place, *design, request.threads, progress)
    how: dict[str, Any] = {name: getattr(request, name) for name in ("threads", "slack", "condition_number")}
    height = study.zp(design[1][0])
    first, least, most, limit = (share * height for share in (FIRST, LEAST, MOST, LARGEST_TOLERANCE))
    own = max(study.tolerances.joints, study.tolerances.legs)
    timed = False

    def of(size: float) -> Tolerances:
        return study.tolerances if size == own > 0.0 else tolerances_like(study.tolerances, size)

    def proved(size: float) -> bool:
        nonlocal timed
        phase(progress, f"proving tolerances of {amount(format(size, '.3g'), study.unit)}")
        each = max(seconds, FOR_LIMITS) if size == own else max(seconds / PROOFS, 0.5)  # its own ones as `certify` does
        begin = perf_counter()
        unproved = open_limits(study, (*design, rule), of(size), each, **how)
        if unproved:  # the legs of a limit share its time
            ended = perf_counter() - begin >= each / len(LEGS)
            timed = ended and all(one.answer == UNDECIDED for one in unproved)
        return not unproved

    low, high = 0.0, own or first
    try:
        while (high <= most or high == own) and proved(high):
            low, high = high, min(STEP * high, limit)
        while low == 0.0 and high >= least:
            high /= STEP
            if proved(high):
                low, high = high, STEP * high
        for _ in range(HALVINGS if low > 0.0 else 0):
            middle = (low * high) ** 0.5
            low, high = (middle, high) if proved(middle) else (low, middle)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(of(low)) from None
    return of(low), timed


def machine_of(result: Any) -> tuple[Geometry, Configuration, float]:
    """Return geometry, neutral and listed poses, and characteristic length of the best design."""
    best = best_of(result)
    return best.geometry, best.configurations[: 1 + len(result.study.objective.poses)], best.characteristic_length


ROUNDS = 6  # two are enough where limits change little with the design
MORE, EDGE = 1.02, 1e-8  # of what a proof lacks, and of the limit: on its edge it would be proved by rounding only
NARROWER = 0.005  # of a limit of the condition number, in each round
LEAST_SHARE = 0.5  # of a limit, and of its inverse: tolerances that take more leave no machine
FOR_PROOF = 600.0  # seconds of each limit, which ends by its boxes: the same result however busy the machine is
UNPROVED = "not proved of every machine within the tolerances"


def _shares(name: str, value: Any) -> Mapping[str, float]:
    shares = {text(name, key): finite(name, share, 0.0) for key, share in table(name, value).items()}
    return Fixed(shares)


@short_repr
@dataclass(frozen=True)
class Reserve(StudyTable):
    """The share of each limit that the search kept, in the place of all of it."""

    shares: Mapping[str, float] = entry(_shares, Fixed())
    """By label and side, "stroke_ratio max": the part of the limit; only of limits that need a reserve."""
    proved: bool = entry(flag, False)
    """Whether all limits are proved of every machine within the tolerances, at every pose."""
    note: str = entry(text, "")
    """Why it is not proved."""

    def _share(self, label: str, side: str) -> float:
        return self.shares.get(f"{NEUTRAL_LIMIT if label == 'neutral_condition_limit' else label} {side}", 1.0)

    def leaves_room(self, study: Study) -> bool:
        """Whether there is a number between the ends of every limit that leaves the reserve."""
        return not crossed(study, self._share)

    def study(self, study: Study) -> Study:
        """Return the study that was solved: with limits that leave the reserve, and without tolerances."""
        return replace(with_scaled_limits(study, self._share), tolerances=Tolerances())

    @property
    def words(self) -> list[str]:
        """The reserve in sentences."""
        parts = [f"{_words(name)} {100.0 * abs(1.0 - share):.2g} %" for name, share in self.shares.items()]
        others = "verdict, prices and what is left to gain are of the study with it; a smaller reserve may be enough"
        out = [f"reserve for the tolerances: {', '.join(parts)}; {others}"] if parts else []
        note = "proved of every machine within the tolerances" if self.proved else self.note
        return [*out, note] if note else out


def _words(name: str) -> str:
    """Return a label and side, "stroke_ratio max", in words."""
    label, _, side = name.rpartition(" ")
    return limit_words(label, side)


def with_reserve(
    result: Any,
    solve: Callable[[Study, Any], Any],
    threads: int,
    progress: Progress | None = None,
    ended: Callable[[], bool] = bool,
) -> Any:
    """Return the result whose limits are proved of every machine within the study's tolerances, if one is found.

    What the proof of a design lacks is taken from its limits, and `solve` solves the study anew from there, until the
    proof succeeds. The result given is of the study without a reserve. Where a proof has no bound of a number at all,
    and no machine was met that breaks a limit, the search stops: that there is no design would be said of nothing.
    """
    study, shares, first, lacking, unknown = result.study, dict[str, float](), result, dict[str, float](), False
    if o_is_placed(study):
        return replace(result, reserve=Reserve(note="no reserve for tolerances: O is placed anew at every pose"))
    for left in reversed(range(ROUNDS + 1)):
        if result.best is None or result.interrupted:
            break
        phase(progress, "proving the limits of every machine within the tolerances")
        try:
            lacking, unknown = _open(study, result, threads)
        except KeyboardInterrupt:
            note = "interrupted before the limits were proved of every machine within the tolerances"
            return replace(_of(study, result, first), interrupted=True, reserve=Reserve(shares, note=note))
        if not lacking:
            return replace(_of(study, result, first), reserve=Reserve(shares, proved=True))
        if ended():
            break
        taken = {key: shares.get(key, 1.0) * share for key, share in lacking.items()}
        if left == 0 or not all(LEAST_SHARE < share < 1.0 / LEAST_SHARE for share in taken.values()):
            break
        if not Reserve(shares | taken).leaves_room(study):
            break
        shares |= taken
        result = solve(Reserve(shares).study(study), result)
    over = result.interrupted or ended()
    if unknown and not over and result.best is not None:
        reason = f"{UNPROVED}: {', '.join(map(_words, lacking))}; a longer proof may decide"
        result, over = replace(result, status=type(result.status).STOPPED, reason=reason), True
    return _without(study, result, first, Reserve(shares, note=UNPROVED), lacking, over)


def _open(study: Study, result: Any, threads: int) -> tuple[dict[str, float], bool]:
    """Return the limits that are not proved of every machine within the tolerances, and the part to be kept of each.

    Also whether nothing is known of one, and none is known to be broken.
    """
    best, out = result.best, dict[str, float]()
    design = (*machine_of(result), None)
    # Where the design lies within a limit, the reserve begins at its own value: else it would change nothing.
    own = {
        f"{row.name} {row.side}": row.value / row.limit
        for row in limit_rows(result.solved, best.variables)
        if row.limit
    }
    limits = open_limits(study, design, study.tolerances, FOR_PROOF, threads)
    unknown = any(not all(map(math.isfinite, one.value)) for one in limits) and all(
        one.answer == UNDECIDED for one in limits
    )
    for limit in limits:
        key = f"{limit.name} {limit.side}"
        met, worst = limit.value if limit.side == "max" else limit.value[::-1]
        if limit.name in (CONDITION_LIMIT, NEUTRAL_LIMIT):  # its enclosure is wide
            share = min(limit.limit / met, 1.0) * (1.0 - NARROWER)
        else:
            lack = 1.0 - limit.limit / worst if 0.0 < worst < math.inf else 1.0
            sign, most = (1.0, min) if limit.side == "max" else (-1.0, max)
            share = (1.0 - lack * MORE - sign * EDGE) * most(own.get(key, 1.0), 1.0)
        out[key] = share
    return out, unknown


def _of(study: Study, result: Any, first: Any) -> Any:
    """Return a result as one of the study itself, with the actuators that were chosen before."""
    chosen = first.actuators
    if chosen is not None and result.best is not None and result is not first:
        chosen = replace(chosen, notes=(*chosen.notes, "actuators were chosen and compared without the reserve"))
    return replace(result, study=study, actuators=chosen)


def _without(study: Study, result: Any, first: Any, reserve: Reserve, lacking: Iterable[str], over: bool) -> Any:
    """Return what is left where no design is proved: the last one of a search that is over, else that there is none."""
    if first.best is None or over:
        if result.best is None and first.best is not None:  # that without a reserve is the best one so far
            result = replace(first, status=result.status, reason=result.reason, interrupted=result.interrupted)
            reserve = Reserve(note=reserve.note)
        return replace(_of(study, result, first), reserve=reserve)
    if result.best is not None:
        reason = f"{UNPROVED}: {', '.join(_words(name) for name in lacking)}"
    else:
        reason = f"with a reserve for the tolerances: {result.reason}"
    none = replace(result, status=type(result.status).INFEASIBLE, reason=reason, candidates=(), region=None)
    return replace(_of(study, none, first), actuators=None, reserve=reserve)
