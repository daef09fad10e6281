"""A proved lower bound of the worst condition number over the poses of a study: no design of it does better."""

from __future__ import annotations

from time import perf_counter
from typing import Any

from ninedof.design.region_poses import o_is_placed
from ninedof.design.study import Study
from ninedof.proof.design_range import EXISTS, NONE, DesignRange, design_range, existence
from ninedof.proof.optimum_proof import OptimumProof
from ninedof.support.progress import Progress, phase

GAP = 1e-3
"""Relative gap to prove: the poses that rule at an optimum meet there, and the last of it is the dearest."""
STEPS = (0.1, 0.02, 5e-3)  # gaps that are proved before: a bound that is there when time ends
COARSE = (0.5, 0.3)  # before these where many variables are free
MOST_FREE, FEW = 6, 4


def ends_soon(study: Study) -> bool:
    """Whether this proof is known for a study, and comes to its end in seconds or minutes: few free variables."""
    return not _missing(study) and len(_free(study)) <= FEW


def range_to_prove(study: Study, condition_number: float | None = None) -> DesignRange:
    """Return all designs of a study that keep its limits, and a condition number; raise where no proof is known."""
    if missing := _missing(study):
        raise ValueError(missing)
    return design_range(study, _free(study), None, condition_number, MOST_FREE)


def prove_over_poses(
    study: Study,
    condition_number: float,
    *,
    gap: float,
    time_limit: float,
    threads: int = 0,
    progress: Progress | None = None,
) -> OptimumProof:
    """Prove that no design of a study is better than a known one by more than a gap, over all poses, with all limits.

    Boxes of designs are cut until each is proved to break a limit, or to have a greater condition number, at one of its
    poses. Smaller gaps come later: what is proved when the time ends is returned.
    """
    begin, boxes, bound = perf_counter(), 0, 1.0
    where = "over the region" if study.objective.region is not None else "at its poses" if study.objective.poses else ""
    better, left, interrupted, aim, certificate = None, 0, False, condition_number * (1.0 - gap), b""
    steps = STEPS if len(_free(study)) <= FEW else (*COARSE, *STEPS)
    for one in (*(step for step in steps if step > gap), gap):
        target = condition_number * (1.0 - one)
        if not target > 1.0:
            continue
        phase(progress, f"proving that no design is below {target:.6g}")
        seconds = begin + time_limit - perf_counter()
        how: dict[str, Any] = {"seconds": max(seconds, 0.0), "threads": threads, "progress": progress}
        found = existence(range_to_prove(study, target), certificate=True, **how)
        boxes, left, interrupted = boxes + found.designs, found.left, found.interrupted
        if found.state != NONE:
            better = target if found.state == EXISTS else None
            break
        bound, certificate = target, found.certificate
    return OptimumProof(
        lower_bound=bound,
        target=aim,
        complete=bound == aim,
        boxes=boxes,
        open=left,
        seconds=perf_counter() - begin,
        better=better,
        interrupted=interrupted,
        where=where,
        certificate=certificate,
    )


def _free(study: Study) -> list[str]:
    return [name for name, ends in study.variables.items() if isinstance(ends, tuple)]


def _missing(study: Study) -> str:
    """Return what a study would need for this proof; nothing if there is one."""
    objective, free = study.objective, _free(study)
    if objective.index != "condition_number" or objective.aggregate != "worst":
        return "objective: got another one, expected the worst condition number for a proof"
    if not isinstance(study.characteristic_length, float | int):
        return "characteristic_length: got one that depends on the design, expected a number for a proof over poses"
    if o_is_placed(study):
        return 'internal_point: got "best", expected "shifted" or "held" for a proof'
    if not 1 <= len(free) <= MOST_FREE:
        return f"variables: got {len(free)} that are free, expected one to {MOST_FREE} for a proof over poses"
    return ""
