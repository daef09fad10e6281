"""Whether any design of a range keeps every limit: asked for actuators, and of optima over poses."""

from __future__ import annotations

from typing import NamedTuple

from ninedof import _core
from ninedof.proof.design_range import LONGEST, DesignRange
from ninedof.support.progress import Progress

EXISTS, NONE, UNDECIDED = "exists", "none", "undecided"


class Existence(NamedTuple):
    """An answer, proved but for "undecided"."""

    state: str
    design: dict[str, float] | None
    """One that exists: the variables that vary."""
    designs: int
    """Boxes of designs that were looked at."""
    left: int
    """Boxes that are not decided."""
    interrupted: bool
    certificate: bytes
    """Of "none", where it is asked for: a file that ninedof_check replays."""


def existence(
    of: DesignRange,
    *,
    seconds: float = LONGEST,
    resolution: float = 0.0,
    threads: int = 0,
    certificate: bool = False,
    progress: Progress | None = None,
) -> Existence:
    """Say whether any design of the range keeps every limit at every pose."""
    state, x, designs, left, interrupted, written = _core.any_admissible(
        of.for_core(),
        threads=threads,
        seconds=min(seconds, LONGEST),
        resolution=resolution,
        certificate=certificate,
        progress=progress,
    )
    design = dict(zip(of.vary, x, strict=True)) if state == EXISTS else None
    return Existence(state, design, designs, left, interrupted, written)
