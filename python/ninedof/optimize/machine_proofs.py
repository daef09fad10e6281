"""Proofs about the machine of a result: its limits at every pose, and its tolerances. `result` is a Result."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ninedof.design.duty import Tolerances, tolerances_like
from ninedof.design.region_poses import Placing, o_is_placed
from ninedof.proof.machine import certify, open_limits
from ninedof.proof.machine_record import MachineCertificate
from ninedof.proof.point_rule import PointRule, rule_of
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.support.arguments import finite, known_keys
from ninedof.support.progress import phase, progress_argument

PROOFS = 12  # about as many are needed for the largest tolerances


def certified(result: Any, options: dict[str, Any]) -> MachineCertificate:
    """Return the certificate of a machine, for the options of `Result.certify`."""
    design, place = machine_of(result), placing_of(result)
    progress = progress_argument(options.get("progress"))
    if options.get("rule") is None and options.get("resume") is None and place is not None:
        options["rule"] = lambda: rule_of(place, *design, options.get("threads", 0), progress)
    return certify(result.study, *design, **options)


def largest(result: Any, options: dict[str, Any]) -> Tolerances:
    """Return the largest tolerances of a machine, for the options of `Result.largest_tolerance`."""
    known_keys("largest_tolerance", options, {"condition_number", "slack", "time_limit", "threads", "rule", "progress"})
    study, place, design = result.study, placing_of(result), machine_of(result)
    seconds = finite("time_limit", options.pop("time_limit", 60.0), 0.0) / PROOFS
    progress = progress_argument(options.pop("progress", None))
    threads = options.setdefault("threads", 0)
    rule = options.pop("rule", None)
    if place is not None and not isinstance(rule, PointRule):
        rule = rule_of(place, *design, threads, progress)

    def proved(tolerances: Tolerances) -> bool:
        phase(progress, f"proving {max(tolerances.joints, tolerances.legs):.3g}")
        return not open_limits(study, (*design, rule), tolerances, max(seconds, 0.5), **options)

    return largest_tolerance(proved, study.tolerances, study.zp(design[1][0]))


def machine_of(result: Any) -> tuple[Geometry, Configuration, float]:
    """Return geometry, neutral and listed poses, and characteristic length of the best design."""
    best = result.best
    if best is None:
        raise ValueError(f"result: got one without a design, expected one to be proved: {result.reason}")
    return best.geometry, best.configurations[: 1 + len(result.study.objective.poses)], best.characteristic_length


def placing_of(result: Any) -> Placing | None:
    """Return how O is placed in the region, where the study places it anew at every pose."""
    best = result.best
    if best is None or not o_is_placed(result.study):
        return None
    ranges = () if result.region is None else result.region.leg_ranges
    return Placing(result.study, best.configuration, best.variables, best.objective, ranges)


FIRST, LEAST, MOST = 1e-4, 1e-6, 0.05  # of the machine's height
STEP, HALVINGS = 4.0, 5


def largest_tolerance(proved: Callable[[Tolerances], bool], shape: Tolerances, height: float) -> Tolerances:
    """Return the largest tolerances that are proved, to 5 %; none at all where not even the least ones are.

    They have the ratio of `shape`, and are looked for from a millionth to a twentieth of the machine's height. A
    KeyboardInterrupt has the largest ones proved so far.
    """

    def of(size: float) -> Tolerances:
        return tolerances_like(shape, size * height)

    low, high = 0.0, FIRST
    try:
        while high <= MOST and proved(of(high)):
            low, high = high, STEP * high
        while low == 0.0 and high >= LEAST:
            if proved(of(high / STEP)):
                low = high / STEP
            else:
                high /= STEP
        if low == 0.0:
            return Tolerances()
        for _ in range(HALVINGS):
            middle = (low * high) ** 0.5
            low, high = (middle, high) if proved(of(middle)) else (low, middle)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(of(low) if low > 0.0 else Tolerances()) from None
    return of(low)
