"""Where O is at the poses of a study."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ninedof.design.pose import ZERO, Pose
from ninedof.redundancy.rules import WORDS

GIVEN = "given"


def rule_words(poses: Sequence[Pose]) -> str:
    """Return where O is: one word for all poses, or how many poses follow each."""
    rules = Counter(p.internal_point if isinstance(p.internal_point, str) else GIVEN for p in poses)
    if any(p.position != ZERO for p in poses) and len(rules) > 1:
        at_rest = [p for p in poses if p.position == ZERO and p.internal_point == "shifted"]
        if len(at_rest) == rules["shifted"]:  # where the platform has not moved, shifted and held are the same
            del rules["shifted"]
            rules[next(iter(rules))] += len(at_rest)
    if len(rules) == 1:
        return f"O is {_words(next(iter(rules)))} at every pose"
    counts = (f"{_words(rule)} at {count} {'pose' if count == 1 else 'poses'}" for rule, count in rules.most_common())
    return f"O is {', '.join(counts)}"


def _words(rule: str) -> str:
    return WORDS.get(rule, rule)
