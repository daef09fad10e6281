"""Where O is at the poses of a study, and which legs never move because of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ninedof.design.indices import LEGS
from ninedof.design.pose import Pose
from ninedof.support.arrays import Floats

IDLE = 1e-9  # of the longest length: a leg whose stroke is shorter does not move
WORDS = {"carried": "carried with the platform", "held": "held", "best": "best", "given": "given"}


def idle_legs(lengths: Floats) -> NDArray[np.bool_]:
    """Return which legs have the same length at all poses, of which there are several; lengths (n, 9)."""
    low, high = lengths.min(axis=0), lengths.max(axis=0)
    return np.asarray((high - low <= IDLE * high) & (len(lengths) > 1))


def idle_words(lengths: Floats) -> str:
    """Return the names of the legs that never move; "" if all do."""
    return ", ".join(name for name, idle in zip(LEGS, idle_legs(lengths), strict=True) if idle)


def rule_words(poses: Sequence[Pose], region_rule: str | None = None) -> str:
    """Return where O is: one word for all poses, or how many poses follow each."""
    rules = Counter(p.internal_point if isinstance(p.internal_point, str) else "given" for p in poses)
    if region_rule is not None:
        rules[region_rule] += 0
    if len(rules) == 1:
        return f"O is {WORDS[next(iter(rules))]} at every pose"
    counts = [f"{WORDS[rule]} at {count} poses" for rule, count in rules.most_common() if count]
    return f"O is {', '.join(counts)}" + ("" if region_rule is None else f", {WORDS[region_rule]} in the region")
