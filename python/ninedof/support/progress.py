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


def part_of(progress: Progress | None, part: str) -> Progress | None:
    """Return a progress whose phases begin with the name of a part of the work."""
    phase(progress, part)
    return None if progress is None else _Part(progress, part)


class _Part:
    def __init__(self, whole: Progress, name: str) -> None:
        self._whole, self._name = whole, name

    def __call__(self, done: int, total: int, value: float | None) -> object:
        return self._whole(done, total, value)

    def phase(self, words: str) -> None:
        phase(self._whole, f"{self._name}, {words}")


def progress_argument(progress: object) -> Progress | None:
    """Return `progress`; raise unless it is callable or None."""
    if progress is not None and not callable(progress):
        raise ValueError(f"progress: got {shown(progress)}, expected a callable of three arguments")
    return cast("Progress | None", progress)
