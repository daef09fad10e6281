"""What was measured."""

from dataclasses import dataclass, field
from statistics import median

from compare.floor import floors
from compare.methods import Method


@dataclass
class Line:
    method: Method
    count: int
    missing: str  # why it did not run
    error: float = 0.0  # the largest relative difference from ours
    nanoseconds: list = field(default_factory=list)  # a pose, each round

    @property
    def median(self):
        return median(self.nanoseconds)

    @property
    def worst(self):
        return max(self.nanoseconds)


@dataclass
class Results:
    poses: int
    rounds: int
    levels: list
    lines: list = field(default_factory=list)
    facts: dict | None = None  # of ninedof_floor
    exact_poses: int = 0
    exact_error: float = 0.0

    def ours(self, norm="2"):
        """Ours on one core at the best level, in a norm."""
        return next(
            line
            for line in reversed(self.lines)
            if line.method.module == "with_ninedof" and line.method.norm == norm and line.method.cores == 1
        )

    def level(self, level):
        return next(
            line
            for line in self.lines
            if line.method.environment.get("NINEDOF_SIMD") == level
            and line.method.norm == "2"
            and line.method.cores == 1
        )

    def ratio(self, line):
        """Of paired rounds: what else the machine did fell on both."""
        ours = self.ours(line.method.norm).nanoseconds
        return median(theirs / own for theirs, own in zip(line.nanoseconds, ours, strict=True))

    def floors(self):
        return {} if self.facts is None else floors(self.facts)
