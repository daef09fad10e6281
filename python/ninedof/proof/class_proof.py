"""The proof of a class of plates at the neutral pose: which studies it reaches, and which of their limits."""

from __future__ import annotations

from dataclasses import replace

from ninedof import _core
from ninedof.design.poses import ZERO, Pose
from ninedof.design.region_poses import o_is_placed
from ninedof.design.study import Study
from ninedof.support.running import Progress

GAPS = {"hexagonal": 1e-12, "symmetric": 1e-6, "symmetric_nonplanar": 2e-3}
"""Relative gaps to prove: of hexagons five numbers matter, of planar symmetric designs seven, of others eleven."""
MOST_BOXES = 100_000_000  # a gigabyte of tree, some five minutes


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
        if not (_in_region(study) or any(_is_neutral_pose(pose) for pose in objective.poses)):
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


def _in_region(study: Study) -> bool:
    return study.objective.region is not None and study.objective.region.path is None


def _is_neutral_pose(pose: Pose) -> bool:
    return pose.position == pose.rotation == ZERO and pose.internal_point == "shifted"
