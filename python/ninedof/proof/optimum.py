"""A proved lower bound of the condition number of all designs of a study, at the neutral pose or over poses."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

from ninedof import _core
from ninedof.design.region_poses import o_is_placed
from ninedof.design.study import Study
from ninedof.proof.design_range import EXISTS, LONGEST, NONE, DesignRange, design_range, existence
from ninedof.proof.optimum_proof import OptimumProof
from ninedof.support.arguments import finite, instance, path_argument
from ninedof.support.arrays import thread_argument
from ninedof.support.running import Progress, phase, progress_argument
from ninedof.support.structs import from_core
from ninedof.support.text import short_repr

GAPS = {"hexagonal": 1e-12, "symmetric": 1e-6, "symmetric_nonplanar": 2e-3}
"""Relative gaps to prove: of hexagons five numbers matter, of planar symmetric designs seven, of others eleven."""
MOST_BOXES = 100_000_000  # a gigabyte of tree, some five minutes


def prove_optimum(
    study: Study,
    condition_number: float,
    *,
    gap: float | None = None,
    time_limit: float | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> OptimumProof:
    """Prove that no design of a study is better than a known one by more than a given gap.

    Branch and bound over all designs, in interval arithmetic: boxes of designs are cut until each is proved to hold
    none below the target. Of a symmetric class at the neutral pose a design counts through the five numbers (hexagons),
    seven (other planar designs) or eleven (non-planar ones) on which its singular values and limits depend, so that the
    paper's problem takes a second or two. Over a region, at listed poses, with a tool, for other families and for
    limits that the first proof does not know, boxes of one to six free variables break a limit, or have a greater
    condition number, at a pose that is met: smaller and smaller gaps are proved, of five and six variables the
    first ones at the neutral pose, without some limits. Ctrl-C and the time limit return what is proved so far.

    Parameters
    ----------
    study : Study
        With a characteristic length that is a number, and the worst condition number as its objective. Of a symmetric
        family at the neutral pose any number of variables may be free; of the limits radius_ratio, leg_ratio (max),
        zs_fraction and, of non-planar designs, lengths of legs, joint_height, height and footprint (max) are part of
        that proof, others are left out (`OptimumProof.left_out`) where more than six variables are free. Elsewhere at
        most six are free, between finite ends, and O is shifted or held.
    condition_number : float
        Of the best design known.
    gap : float, optional
        To be proved: no condition number below (1 - gap) condition_number. By default 1e-12 for hexagons, 1e-6 for
        other planar designs and 2e-3 for non-planar ones, which is the work of minutes, and 1e-3 over poses.
    time_limit : float, optional
        Seconds; none by default.
    threads : int, optional
        One per processor by default. Without a time limit the result is the same for any number.
    progress : callable, optional
        Called as progress(boxes examined, 0, lower bound so far).

    Returns
    -------
    OptimumProof

    Raises
    ------
    ValueError
        If the theory does not reach the study: the message says what it expects.
    RuntimeError
        If floating-point numbers of this process do not follow IEEE 754, as after loading code built with -ffast-math.

    Notes
    -----
    docs/theory/proof.md has the lemmas. Assumed: IEEE 754 arithmetic.

    Examples
    --------
    >>> import ninedof as nd
    >>> proof = nd.prove_optimum(nd.Study.paper(), 3.7626590785960, gap=1e-3)
    >>> proof.complete, round(proof.lower_bound, 3)
    (True, 3.759)

    """
    best = finite("condition_number", condition_number)
    over_poses = _is_over_poses(study)
    aim = gap_of(study) if gap is None else finite("gap", gap, least=0.0, most=1.0)
    limit = 0.0 if time_limit is None else finite("time_limit", time_limit, least=0.0)
    progress_argument(progress)
    if not best * (1.0 - aim) > 1.0:
        raise ValueError(f"condition_number: got {best:g} and a gap of {aim:g}, expected more than 1 to be proved")
    count = thread_argument(threads)
    if over_poses:
        return prove_over_poses(study, best, gap=aim, time_limit=limit or LONGEST, threads=count, progress=progress)
    proof = _prove_class(study, best * (1.0 - aim), MOST_BOXES, limit, count, progress)
    return from_core(OptimumProof, proof, target=best * (1.0 - aim), where="")


def left_out_of(study: Study) -> tuple[str, ...]:
    """Return the limits of a study that a proof leaves out; raise ValueError if the theory does not reach the study."""
    if _is_over_poses(study):
        existence(range_to_prove(study), seconds=0.0)  # raises where a limit has no bounds over boxes of designs
        return ()
    return _left_out_of_class(study)


def gap_of(study: Study) -> float:
    """Return the gap that is proved by default."""
    return GAP if _is_over_poses(study) else GAPS[study.family]


def _is_over_poses(study: Study) -> bool:
    """Whether the proof is that over poses with every limit, and not that of a class of plates at the neutral pose."""
    if instance("study", study, Study).tool or study.objective.region is not None or study.objective.poses:
        range_to_prove(study)  # raises where no proof is known
        return True
    if _missing(study) or len(_free(study)) > FEW:  # the proof over poses is not known, or does not end soon
        _left_out_of_class(study)  # raises
        return False
    try:
        return bool(_left_out_of_class(study))
    except ValueError:
        return True


def _left_out_of_class(study: Study) -> tuple[str, ...]:
    return _prove_class(study, 2.0, 0, 0.0, 1, None).left_out  # looks at the study and at no box


def _prove_class(
    study: Study, target: float, box_limit: int, time_limit: float, threads: int, progress: Progress | None
) -> _core.OptimumProof:
    """Return the core's proof that no design is below `target` at the neutral pose, with its tree; 0 s: no limit."""
    settings = _core.OptimumSettings(
        target=target, threads=threads, box_limit=box_limit, time_limit=time_limit, keep_tree=True
    )
    return _core.prove_optimum(study.problem(), settings, progress)


@short_repr
@dataclass(frozen=True)
class CertificateCheck:
    """The verdict of the checker of a certificate."""

    proved: bool
    words: str
    """The proved statement, or the reason of a refusal."""
    boxes: int
    recut: int
    """Boxes that were cut further than by the search."""
    incomplete: bool = False
    """Of a set of designs: nothing in it is wrong, and not all of it could be confirmed."""
    study: tuple[str, ...] = ()
    """Of a proof: the designs that it is about, one line each, as the checker read them; angles in radians."""


def check_certificate(path: str | os.PathLike[str], *, progress: Progress | None = None) -> CertificateCheck:
    """Check a certificate of an optimum, a machine or a set of designs, without trusting the search that wrote it.

    By the code of the program ninedof_check, which shares none with the search: numbers, formulas and bounds are its
    own. The certificate of the paper's study takes some eight seconds.

    Parameters
    ----------
    path : path
        As `OptimumProof.save`, `Result.save_certificate` and `AdmissibleSet.save_certificate` write it.
    progress : callable, optional
        Called as progress(bytes or boxes of designs read, all of them, None).

    Returns
    -------
    CertificateCheck
        A certificate that is damaged, changed or no proof is refused with the reason.

    Raises
    ------
    ValueError
        If the file cannot be read.

    """
    try:
        data = path_argument("path", path).read_bytes()
    except OSError as error:
        raise ValueError(f"certificate: got {path!s}, expected a file that can be read ({error.strerror})") from None
    progress_argument(progress)
    return from_core(CertificateCheck, _core.check_certificate(data, progress))


GAP = 1e-3
"""Relative gap to prove: the poses that rule at an optimum meet there, and the last of it is the dearest."""
STEPS = (0.1, 0.02, 5e-3)  # gaps that are proved before: a bound that is there when time ends
COARSE = (0.5, 0.3, 0.2)  # before these where many variables are free
MOST_FREE, FEW = 6, 4
FEW_BOXES = 1_000_000  # of a step at the neutral pose: some seconds


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
    threads: int,
    progress: Progress | None,
) -> OptimumProof:
    """Prove that no design of a study is better than a known one by more than a gap, over all poses.

    Boxes of designs are cut until each is proved to break a limit, or to have a greater condition number, at one of its
    poses. Smaller gaps come later: what is proved when the time ends is returned. No worst condition number is below
    that at the neutral pose: of many free variables, where that is in the region, the proof of the class comes first,
    as it takes fewer boxes. It does without the limits that `left_out` names.
    """
    begin, boxes, bound = perf_counter(), 0, 1.0
    many = len(_free(study)) > FEW
    home = _at_home(study) if many else None
    left_out: tuple[str, ...] = ()
    where = "over the region" if study.objective.region is not None else "at its poses" if study.objective.poses else ""
    better, left, interrupted, aim, certificate = None, 0, False, condition_number * (1.0 - gap), b""
    steps = (*COARSE, *STEPS) if many else STEPS
    for one in (*(step for step in steps if step > gap), gap):
        target = condition_number * (1.0 - one)
        if not target > 1.0:
            continue
        phase(progress, f"proving that no design is below {target:.6g}")
        seconds = begin + time_limit - perf_counter()
        if home is not None and seconds > 0.0:
            proof = _prove_class(home, target, FEW_BOXES, seconds, threads, progress)
            boxes, left, interrupted = boxes + proof.boxes, proof.open, proof.interrupted
            if proof.complete:
                bound, certificate, left_out = target, proof.certificate, proof.left_out
                continue
            if interrupted:
                break
            home, seconds = None, begin + time_limit - perf_counter()  # a smaller gap is not proved there either
        how: dict[str, Any] = {"seconds": max(seconds, 0.0), "threads": threads, "progress": progress}
        found = existence(range_to_prove(study, target), certificate=True, **how)
        boxes, left, interrupted = boxes + found.designs, found.left, found.interrupted
        if found.state != NONE:
            better = target if found.state == EXISTS else None
            break
        bound, certificate, left_out = target, found.certificate, ()
    return OptimumProof(
        lower_bound=bound,
        target=aim,
        complete=bound == aim,
        boxes=boxes,
        open=left,
        seconds=perf_counter() - begin,
        better=better,
        left_out=left_out,
        interrupted=interrupted,
        where=where,
        certificate=certificate,
    )


def _at_home(study: Study) -> Study | None:
    """Return the study at its neutral pose, if that is a pose of its region and its class has a proof; else None."""
    region = study.objective.region
    if region is None or region.path is not None or study.tool or study.family not in ("hexagonal", "symmetric"):
        return None
    alone = replace(study, objective=replace(study.objective, region=None))
    try:
        _left_out_of_class(alone)
    except ValueError:
        return None
    return alone


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
