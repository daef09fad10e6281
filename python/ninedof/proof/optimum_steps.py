"""A bound over poses, in smaller and smaller gaps: by the class at the neutral pose, then by boxes of designs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from time import perf_counter

from ninedof import _core
from ninedof.design.domains.poses import ZERO
from ninedof.design.domains.region_poses import o_is_placed
from ninedof.design.study import Study
from ninedof.proof.design_range import EXISTS, LONGEST, NONE, DesignRange, design_range
from ninedof.proof.optimum_proof import OptimumProof
from ninedof.support.running import Progress, phase

GAPS = {"hexagonal": 1e-12, "symmetric": 1e-6, "symmetric_nonplanar": 2e-3}
"""Relative gaps to prove: of hexagons five numbers matter, of planar symmetric designs seven, of others eleven."""
MOST_BOXES = 100_000_000  # a gigabyte of tree, some five minutes
GAP = 1e-3
"""Relative gap to prove by boxes: the active poses of an optimum meet there, and the last of it takes longest."""
STEPS = (0.1, 0.02, 5e-3, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)  # gaps that are proved before: a bound when the time ends
COARSE = (0.5, 0.3, 0.2)  # before these where many variables are free
MOST_FREE, FEW = 6, 4
MANY_BOXES, FEW_BOXES = 1_000_000, 50_000
"""Of the class, where boxes of designs may do more: seconds where many variables are free, else a part of one."""


def prove_class(
    study: Study, target: float, box_limit: int, time_limit: float, threads: int, progress: Progress | None
) -> _core.OptimumProof:
    """Return the core's proof that no design is below `target` at the neutral pose, with its tree; 0 s: no limit."""
    settings = _core.OptimumSettings(
        target=target, threads=threads, box_limit=box_limit, time_limit=time_limit, keep_tree=True
    )
    return _core.prove_optimum(study.problem(), settings, progress)


def left_out_of_class(study: Study) -> tuple[str, ...]:
    """Return the limits that the proof does without; raise ValueError if it does not reach the study."""
    return prove_class(study, 2.0, 0, 0.0, 1, None).left_out  # looks at the study and at no box


def at_home(study: Study) -> Study | None:
    """Return the study at its neutral pose alone, if that is one of its poses and its class has a proof; else None.

    No worst condition number is below that at one of the poses, and a limit that holds at all of them holds there.
    """
    objective = study.objective
    alone = study
    if not is_neutral(study):
        if study.tool or objective.aggregate != "worst" or o_is_placed(study):
            return None
        shifts = ((pose.position, pose.rotation, pose.internal_point) for pose in objective.poses)
        in_region = objective.region is not None and objective.region.path is None
        if not in_region and (ZERO, ZERO, "shifted") not in shifts:
            return None
        alone = replace(study, objective=replace(objective, region=None, poses=()))
    try:
        left_out_of_class(alone)
    except ValueError:
        return None
    return alone


def is_neutral(study: Study) -> bool:
    """Whether a study is about the neutral pose alone, without a tool."""
    return not (study.tool or study.objective.region is not None or study.objective.poses)


@dataclass(frozen=True)
class Ways:
    """Ways to prove the bound of a study."""

    home: Study | None
    """The study at its neutral pose, where its class has a proof."""
    by_boxes: bool
    """Whether boxes of designs are known to prove it, with every limit, where the class does not."""
    neutral: bool
    """Whether the study is about the neutral pose alone."""
    reason: str = ""
    """Why the class of a study about the neutral pose has no proof; "" where it has one, or where there is none."""

    @property
    def left_out(self) -> tuple[str, ...]:
        """The limits that the proof does without, wherever it ends."""
        return () if self.by_boxes or self.home is None else left_out_of_class(self.home)

    @property
    def gap(self) -> float:
        """The gap to prove by default."""
        return GAP if self.by_boxes or self.home is None else GAPS[self.home.family]

    @property
    def class_gap(self) -> float:
        """The gap that the class is to prove by default."""
        return self.gap if self.home is None or not self.neutral else GAPS[self.home.family]


def ways_of(study: Study) -> Ways:
    """Return how the bound of a study can be proved; raise ValueError if the theory does not reach it."""
    home, neutral, few = at_home(study), is_neutral(study), len(study.free_variables) <= FEW
    if home is not None and neutral and not (few and left_out_of_class(home)):
        return Ways(home, by_boxes=False, neutral=True)
    reason = ""
    if home is None and neutral:
        try:
            left_out_of_class(study)  # raises
        except ValueError as error:
            if _missing(study) or not few:
                raise
            reason = str(error) if study.family in GAPS else ""
    try:
        # Raises where a limit has no bounds over boxes of designs.
        _core.any_admissible(range_to_prove(study).for_core(), seconds=0.0)
    except ValueError:
        if home is None:
            raise
        return Ways(home, by_boxes=False, neutral=neutral)
    return Ways(home, by_boxes=True, neutral=neutral, reason=reason)


def range_to_prove(study: Study, condition_number: float | None = None) -> DesignRange:
    """Return all designs of a study that keep its limits, and a condition number; raise where no proof is known."""
    if missing := _missing(study):
        raise ValueError(missing)
    return design_range(study, study.free_variables, None, condition_number, MOST_FREE)


class StepByStep:
    """The proof that no design of a study is better than a known one by more than a gap, over all poses.

    The class at the neutral pose comes first, as it takes fewer boxes: it does without the limits that `left_out`
    names. For gaps that it does not reach boxes of designs are cut until each is proved to break a limit, or to have a
    greater condition number, at one of its poses. Smaller gaps come later: what is proved when the time ends is
    returned.
    """

    def __init__(self, study: Study, ways: Ways, time_limit: float, threads: int, progress: Progress | None) -> None:
        """Begin; the time limit counts from here, in seconds."""
        self._study, self._ways, self._threads, self._progress = study, ways, threads, progress
        self._begin = perf_counter()
        self._end = self._begin + time_limit
        self._below = math.inf
        """A condition number in the class at the neutral pose: nothing above it is proved there."""
        self._boxes, self._left, self._interrupted = 0, 0, False
        self._better: float | None = None
        self._bound, self._certificate, self._left_out = 1.0, b"", tuple[str, ...]()

    def prove(self, best: float, gap: float | None, earlier: OptimumProof | None = None) -> OptimumProof:
        """Return what is proved of a gap below `best`, beside what an earlier proof of the same study has."""
        ways, many = self._ways, len(self._study.free_variables) > FEW
        aim, finest = (best * (1.0 - (one if gap is None else gap)) for one in (ways.gap, ways.class_gap))
        coarser = (best * (1.0 - step) for step in ((*COARSE, *STEPS) if many else STEPS))
        most_boxes = MOST_BOXES if not ways.by_boxes else MANY_BOXES if many else FEW_BOXES
        if earlier is not None:
            self._bound, self._certificate, self._left_out = earlier.lower_bound, earlier.certificate, earlier.left_out
        for target in (*(one for one in coarser if one < aim), aim):
            if target <= self._bound:
                continue
            phase(self._progress, f"proving that no design is below {target:.6g}")
            if self._by_class(target, most_boxes):
                if ways.by_boxes and ways.neutral and self._by_class(finest, MANY_BOXES):
                    return self._proof(finest)  # all at once
            elif not self._by_boxes(target):
                break
        return self._proof(aim)

    def _by_class(self, target: float, most_boxes: int) -> bool:
        """Whether the class at the neutral pose proves the target."""
        seconds = self._end - perf_counter()
        if self._ways.home is None or self._interrupted or not (target < self._below and seconds > 0.0):
            return False
        proof = prove_class(self._ways.home, target, most_boxes, seconds, self._threads, self._progress)
        self._count(proof.boxes, proof.open, proof.interrupted)
        if proof.complete:
            self._bound, self._certificate, self._left_out = target, proof.certificate, tuple(proof.left_out)
        elif not proof.interrupted:
            self._below = min(self._below, target if proof.better is None else proof.better)
            self._better = None if self._ways.by_boxes else proof.better
        return proof.complete

    def _by_boxes(self, target: float) -> bool:
        """Whether boxes of designs prove the target."""
        if not self._ways.by_boxes or self._interrupted:
            return False
        seconds = min(max(self._end - perf_counter(), 0.0), LONGEST)
        question = range_to_prove(self._study, target).for_core()
        answer = _core.any_admissible(
            question, seconds=seconds, threads=self._threads, certificate=True, progress=self._progress
        )
        self._count(answer.looked_at, answer.open, answer.interrupted)
        if answer.state == NONE:
            self._bound, self._certificate, self._left_out = target, answer.certificate(question), ()
        self._better = target if answer.state == EXISTS else None
        return answer.state == NONE

    def _proof(self, aim: float) -> OptimumProof:
        """Return what is proved."""
        objective = self._study.objective
        return OptimumProof(
            lower_bound=self._bound,
            target=aim,
            complete=self._bound >= aim,
            boxes=self._boxes,
            open=self._left,
            seconds=perf_counter() - self._begin,
            better=self._better,
            left_out=self._left_out,
            interrupted=self._interrupted,
            where="over the region" if objective.region is not None else "at its poses" if objective.poses else "",
            reason=self._ways.reason,
            certificate=self._certificate,
        )

    def _count(self, boxes: int, left: int, interrupted: bool) -> None:
        self._boxes, self._left, self._interrupted = self._boxes + boxes, left, interrupted


def _missing(study: Study) -> str:
    """Return what a study would need for this proof; nothing if there is one."""
    objective, free = study.objective, study.free_variables
    if objective.index != "condition_number" or objective.aggregate != "worst":
        return "objective: got another one, expected the worst condition number for a proof"
    if not isinstance(study.characteristic_length, float | int):
        return "characteristic_length: got one that depends on the design, expected a number for a proof over poses"
    if o_is_placed(study):
        return 'internal_point: got "best", expected "shifted" or "held" for a proof'
    if not 1 <= len(free) <= MOST_FREE:
        return f"variables: got {len(free)} that are free, expected one to {MOST_FREE} for a proof over poses"
    return ""
