"""The workspace about the pose shown, for the eye: positions, in its orientation, that keep every limit."""

from __future__ import annotations

import math
import traceback
from collections.abc import Callable
from concurrent.futures import CancelledError, ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np

from ninedof.design.domains.region_poses import o_is_placed
from ninedof.design.limit_numbers import CONES, REGULAR
from ninedof.design.limits import OF_LENGTHS
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats
from ninedof.support.units import amount
from ninedof.viewer.machine import Variant
from ninedof.viewer.shapes import Mesh
from ninedof.workspace.question import LEG_LIMITS
from ninedof.workspace.search import workspace
from ninedof.workspace.study_question import EASE, permitted_ranges, study_limits

COARSE = {"tolerance": 0.01, "resolution": 16, "points": 1000, "most_evaluations": 400_000}
COARSE_SEARCHED = {"tolerance": 0.05, "resolution": 6, "points": 64, "most_evaluations": 20_000}
"""With a search of the best O at each position."""
REACH = 0.75  # of the size of the machine: half the side of the box that is searched


@dataclass(frozen=True, eq=False)
class Body:
    """A sentence about a workspace, and its surface."""

    words: str = ""
    mesh: Mesh | None = None


def question_of(variant: Variant, c: Configuration, rule: str, size: float, condition_limit: float) -> dict[str, Any]:
    """Return the arguments of `workspace`.

    Positions are connected with the pose shown, and have its side of every singularity; with the neutral pose where the
    study limits cones, whose axes are those there.
    """
    criteria = {}
    if variant.study is not None:
        limits, _ = study_limits(variant.study, variant.geometry, variant.home)
        criteria = {name: limit for name, limit in limits.items() if name not in OF_LENGTHS}
    criteria |= {LEG_LIMITS: leg_limits(variant), REGULAR: True}
    if condition_limit < math.inf:
        criteria["condition_number"] = min(condition_limit, criteria.get("condition_number", math.inf))
    carried = {"platform": c.rotation.T @ (c.internal_point - c.position)}  # without a turn the same as shifted
    ends, reach = np.stack([variant.home.position, c.position]), REACH * size
    return {
        "box": (ends.min(axis=0) - reach, ends.max(axis=0) + reach),
        "rotation": c.rotation,
        "criteria": criteria,
        "internal_point": {"best": "best", "held": c.internal_point}.get(rule, carried),
        "home": variant.home if set(CONES) & set(criteria) else c,
        "characteristic_length": variant.length,
        "threads": 1,
        **(COARSE_SEARCHED if rule == "best" else COARSE),
    }


def leg_limits(variant: Variant) -> tuple[Floats, Floats]:
    """Return the least and greatest length of each leg, shapes (9,), eased by `EASE` of themselves.

    Limits that compare lengths leave each leg the range about those of the study that `ninedof workspace` has; where O
    is placed in a region, `leg_low` and `leg_high` are within it.
    """
    low, high, study, lengths = variant.leg_low, variant.leg_high, variant.study, variant.study_lengths
    if study and lengths is not None and not o_is_placed(study):
        least, most = permitted_ranges(study, variant.home, lengths)
        low, high = np.maximum(low, least), np.minimum(high, most)
    return low * (1.0 - EASE), high * (1.0 + EASE)


def body_of(variant: Variant, question: dict[str, Any], unit: str, progress: Any = None) -> Body:
    """Return the workspace of `question_of`."""
    positions = workspace(variant.geometry, progress=progress, **question)
    if not positions.volume > 0.0:
        start = "neutral pose" if set(CONES) & set(question["criteria"]) else "pose shown"
        why = f", which violates {positions.home_limit}" if positions.home_limit else ""
        return Body(f"No position that keeps all limits is connected with the {start}{why}.")
    surface = positions.surface()
    faces = np.concatenate([surface.faces[:, [0, 1, 2]], surface.faces[:, [0, 2, 3]]]).astype(np.uint32)
    volume = amount(f"{positions.volume:.3g}", f"{unit}³" if unit else "")
    more = ", and more beyond what was looked at" if positions.box_limits else ""
    when = "with the orientation and the rule for O of the moment it was asked for"
    return Body(f"Volume about {volume}{more}, {when}.", (surface.points, faces))


class BodySearch:
    """The search for a workspace in a thread of its own; it is given up when another one begins.

    From there `show` is called with the number of the search and what it found; `counts` says whether to show that.
    """

    def __init__(self, show: Callable[[int, Body], None]) -> None:
        self._show, self._newest = show, 0
        self._threads = ThreadPoolExecutor(1, thread_name_prefix="ninedof-viewer-workspace")

    def begin(self, search: Callable[[Any], Body]) -> None:
        """Search by a function of a progress callback, in place of the search before."""
        self._newest += 1
        self._threads.submit(self._work, self._newest, search)

    def counts(self, number: int) -> bool:
        """Return whether a search is the newest and not given up."""
        return number == self._newest

    def cancel(self) -> None:
        """Give up the search."""
        self._newest += 1

    def close(self) -> None:
        """Give up the search and wait for it: no thread is left inside the core when Python ends."""
        self._newest += 1
        self._threads.shutdown()

    def _work(self, number: int, search: Callable[[Any], Body]) -> None:
        def progress(*_: Any) -> None:
            if not self.counts(number):
                raise CancelledError

        try:
            progress()
            body = search(progress)
        except CancelledError:
            return
        except Exception as error:  # whatever it is, the user is waiting for an answer
            if not isinstance(error, ValueError):  # a mistake of the program is shown where it was started
                traceback.print_exc()
            body = Body(f"Not found: {str(error) or type(error).__name__}")
        self._show(number, body)
