"""Progress of a long call, reported to its caller."""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

from ninedof.support.arguments import shown

Progress = Callable[[int, int, float | None], object]
"""Called as progress(done, total, value): the work done, the work in all as far as it is known, and the best objective
or the volume so far; None where there is no such figure."""


def phase(progress: Progress | None, words: str) -> None:
    """Tell a progress that has a method `phase` which part of the work begins."""
    say = getattr(progress, "phase", None)
    if callable(say):
        say(words)


def progress_argument(progress: object) -> Progress | None:
    """Return `progress`; raise unless it is callable or None."""
    if progress is not None and not callable(progress):
        raise ValueError(f"progress: got {shown(progress)}, expected a callable of three arguments")
    return cast("Progress | None", progress)
