"""For which rows of a list of actuators admissible designs exist."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass
from time import perf_counter
from typing import Any

from ninedof import _core
from ninedof.design.actuators import LEG_KINDS, Actuator
from ninedof.design.study import Study
from ninedof.proof.design_range import EXISTS, LONGEST, UNDECIDED, design_range
from ninedof.support.arguments import finite, instance, whole
from ninedof.support.arrays import MOST_THREADS
from ninedof.support.running import Progress, part_of, progress_argument


@dataclass(frozen=True)
class AdmissibleRow:
    """Whether a design exists whose legs of one kind have a row; the other kinds may have any length."""

    kind: str
    """ "external", "upper" or "lower"; "all" in a study that takes one row for all legs."""
    row: Actuator
    state: str
    """ "exists" or "none", both proved, or "undecided"."""
    design: Mapping[str, float] | None
    """A design that is proved: the variables that vary. None without one."""

    def to_dict(self) -> dict[str, Any]:
        """Return plain values, as JSON has them; angles in radians."""
        design = None if self.design is None else dict(self.design)
        return {"legs": self.kind, "actuator": self.row.name, "state": self.state, "design": design}


@dataclass(frozen=True)
class AdmissibleRows:
    """For which rows designs exist."""

    rows: tuple[AdmissibleRow, ...]
    """By kinds of legs, the rows in the order of the study."""
    of: str
    """The designs that were asked about, in words."""
    interrupted: bool = False
    """Ctrl-C: the rows after it are undecided."""


def admissible_actuators(
    study: Study,
    vary: Collection[str] | Mapping[str, tuple[float, float] | None],
    *,
    at: Mapping[str, float | str] | None = None,
    time_limit: float | None = None,
    resolution: float = 0.01,
    threads: int = 0,
    progress: Progress | None = None,
) -> AdmissibleRows:
    """Say for which rows of a study's actuators a design exists that keeps every limit at every pose; proved.

    Each row is asked about alone, for each kind of legs: the other kinds have no limits of actuators. Where none exists
    for a row, none exists for any combination with it; where one exists, a combination may still have none.

    Parameters
    ----------
    study : Study
        One with actuators.
    vary, at, resolution, threads, progress : optional, but for the first
        As in `admissible`. Forces and rates of rows count where the study states loads and speeds.
    time_limit : float, optional
        Seconds for all rows together; none by default. A row that was not decided is "undecided".

    Raises
    ------
    ValueError
        For a study without actuators, and as `admissible`.

    """
    if not instance("study", study, Study).actuators:
        raise ValueError("study: got one without actuators, expected a list of them")
    resolution = finite("resolution", resolution, 0.0, 1.0)
    threads = whole("threads", threads, 0, MOST_THREADS)
    end = perf_counter() + (LONGEST if time_limit is None else finite("time_limit", time_limit, 0.0))
    progress = progress_argument(progress)
    kinds = {"all": LEG_KINDS} if study.actuators_for == "all" else {kind: (kind,) for kind in LEG_KINDS}
    rows = [(kind, row) for kind in kinds for row in study.actuators]
    questions = [design_range(study.with_actuators(dict.fromkeys(kinds[kind], row)), vary, at) for kind, row in rows]
    of = questions[0].words + (f", at {held}" if (held := questions[0].held) else "")
    out, interrupted = list[AdmissibleRow](), True
    with suppress(KeyboardInterrupt):
        for n, ((kind, row), question) in enumerate(zip(rows, questions, strict=True)):
            seconds = max(end - perf_counter(), 0.0) / (len(rows) - n)
            words = part_of(progress, f"{row.name} for {kind} legs")
            answer = _core.any_admissible(
                question.for_core(), seconds=seconds, resolution=resolution, threads=threads, progress=words
            )
            design = {name: answer.design[k] for k, name in enumerate(question.vary)}
            out.append(AdmissibleRow(kind, row, answer.state, design if answer.state == EXISTS else None))
            if answer.interrupted:
                break
        else:
            interrupted = False
    out += [AdmissibleRow(kind, row, UNDECIDED, None) for kind, row in rows[len(out) :]]
    return AdmissibleRows(tuple(out), of, interrupted)
