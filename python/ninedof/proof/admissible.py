"""Sets of admissible designs: a box of some variables of a study, divided into what is proved inside and outside."""

from __future__ import annotations

import math
import os
from collections.abc import Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple, Protocol, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ninedof import _core
from ninedof.conditioning.conditioning import condition_number
from ninedof.design.changes import angles_in_radians, given_values
from ninedof.design.region_poses import configurations_at, places_o
from ninedof.design.study import Study
from ninedof.proof.machine_record import ProofPose
from ninedof.robot.configuration import Configuration
from ninedof.support.angles import plain_name
from ninedof.support.arguments import finite, instance, items, pair, path_argument, shown, table, text, whole
from ninedof.support.arrays import MOST_THREADS, Floats, as_floats
from ninedof.support.files import sha256, write_whole
from ninedof.support.progress import Progress, progress_argument
from ninedof.support.structs import Fixed, options_of
from ninedof.support.units import amount

INSIDE, OUTSIDE, UNDECIDED = "inside", "outside", "undecided"
STATES = (INSIDE, OUTSIDE, UNDECIDED)
MOST_VARIED = 4
ENOUGH = 1e-5  # of the volume: what is undecided below it is not looked at
AROUND_SECONDS = 20.0
LONGEST = 1e9  # seconds
METHOD = 3  # of the proofs: sets that another one proved are not gone on with
POSES, SIDE = 400, 25  # of the sample: poses of the region, designs along a side


class HasDesign(Protocol):
    """A result of a study: what `Result` has."""

    @property
    def study(self) -> Study:
        """The study."""

    @property
    def variables(self) -> Mapping[str, float] | None:
        """The design; None without one."""


class AdmissibleArguments(TypedDict, total=False):
    """Options of `admissible`, which says what they mean."""

    at: Mapping[str, float | str] | None
    condition_number: float | None
    time_limit: float | None
    resolution: float
    threads: int
    resume: AdmissibleSet | None
    progress: Progress | None


class Reason(NamedTuple):
    """Reason why no design of a box is admissible."""

    limit: str
    """As in `Study.constraints`; "no singularity" and "condition_number" too."""
    part: str
    """The leg, pair of legs or determinant; "" where the limit has none."""
    pose: ProofPose
    """Where all designs of the box break it; of a spread of lengths where the leg is longest."""


@dataclass(frozen=True)
class DesignRange:
    """The designs that are asked for, and what they have to keep."""

    study: Study
    vary: tuple[str, ...]
    """The variables that vary."""
    ranges: tuple[tuple[float, float], ...]
    """The ends of each; angles in radians."""
    at: Mapping[str, float]
    """All variables: of those that vary the design that is marked, or the middle."""
    condition_number: float | None
    """A bound besides the limits of the study."""
    moved: tuple[str, ...] = ()
    """The variables whose value in the result or the study lies outside of the range: `at` has the middle."""

    def for_core(self) -> _core.DesignQuestion:
        """Return the question as the core takes it."""
        names, region = list(self.study.variables), self.study.objective.region
        return _core.DesignQuestion(
            problem=self.study.problem(),
            region=[] if region is None else [region.for_core()],
            at=[self.at[name] for name in names],
            varied=[names.index(name) for name in self.vary],
            low=[low for low, _ in self.ranges],
            high=[high for _, high in self.ranges],
            condition=math.inf if self.condition_number is None else float(self.condition_number),
        )

    def values(self, names: Collection[str]) -> str:
        """Return values of variables in words."""
        shown = (f"{name} = {self.study.shown(name, self.at[name]):.5g}" for name in names)
        return ", ".join(amount(words, self.study.unit_of(name)) for name, words in zip(names, shown, strict=True))

    @property
    def held(self) -> str:
        """The values of the variables that do not vary, in words; without those that the study fixes at 0."""
        return self.values([name for name in self.study.variables if name not in self.vary and self.at[name] != 0.0])

    def sampled_condition(self, first: int, second: int) -> tuple[Floats, Floats, Floats] | None:
        """Return the worst condition number over a sample of poses, at designs of the plane of two of the variables.

        Values of the first variable (n,) and of the second (n,), and a row for each value of the second, NaN where
        there is no robot; None where the characteristic length depends on the design. Nothing of it is proved.
        """
        length = self.study.characteristic_length
        if not isinstance(length, float | int):
            return None
        problem = self.study.problem()
        x, y = (np.linspace(*self.ranges[k], SIDE) for k in (first, second))
        worst = np.full((SIDE, SIDE), np.nan)
        for n, m in np.ndindex(SIDE, SIDE):
            values = dict(self.at) | {self.vary[first]: float(x[m]), self.vary[second]: float(y[n])}
            row = [values.get(name, 0.0) for name in problem.names]
            with suppress(ValueError):  # no robot there
                worst[n, m] = np.max(condition_number(problem.geometry(row), self._poses(row), float(length)))
        return x, y, worst

    def _poses(self, row: list[float]) -> Configuration:
        every, region = Configuration(*self.study.problem().configurations(row)), self.study.objective.region
        if region is None:
            return every[1:] if len(every) > 1 else every
        return configurations_at(region, every[0], _core.even_poses(region.for_core(), POSES))[1]

    @property
    def digest(self) -> str:
        """Digest of the question: another run goes on with the same question only."""
        asked = (METHOD, self.study.to_dict(), self.vary, self.ranges, sorted(self.at.items()), self.condition_number)
        return sha256(repr(asked).encode()).hexdigest()

    @property
    def words(self) -> str:
        """The ranges in words."""
        parts = []
        for name, ends in zip(self.vary, self.ranges, strict=True):
            low, high = (f"{self.study.shown(name, end):g}" for end in ends)
            parts.append(f"{name} from {low} to {amount(high, self.study.unit_of(name))}")
        return ", ".join(parts)


@dataclass(frozen=True, eq=False)
class AdmissibleSet:
    """A box of designs, divided into pieces. Lengths in the unit of the study, angles in radians."""

    of: DesignRange
    low: Floats
    """The lower ends of the pieces, shape (n, d); they are a partition of the box."""
    high: Floats
    """The upper ends."""
    state: NDArray[np.int8]
    """0 inside, 1 outside, 2 undecided, shape (n,)."""
    demand: NDArray[np.int32]
    """Of those outside the index into `demands`, else -1."""
    demands: tuple[tuple[str, str], ...]
    """All limits with their parts."""
    poses: Floats
    """Where it is broken: the number of a listed pose or -1, then shift, tilt about x and y, and yaw. The same again
    where the leg is shortest, of a spread of lengths. Shape (n, 14)."""
    shares: Mapping[str, float]
    """The shares of the volume: "inside", "outside", "undecided"."""
    designs: int
    """Boxes of designs that were looked at."""
    boxes: int
    """Boxes of poses, for a box of designs each."""
    seconds: float
    interrupted: bool = False

    @property
    def study(self) -> Study:
        """The study."""
        return self.of.study

    @property
    def vary(self) -> tuple[str, ...]:
        """The variables that vary."""
        return self.of.vary

    @property
    def inside(self) -> Floats:
        """Boxes of designs that keep every limit at every pose, proved, shape (n, d, 2)."""
        return self._boxes(0)

    @property
    def outside(self) -> Floats:
        """Boxes all designs of which break a limit at a pose, proved: see `reasons`."""
        return self._boxes(1)

    @property
    def undecided(self) -> Floats:
        """The other boxes."""
        return self._boxes(2)

    @cached_property
    def reasons(self) -> tuple[Reason, ...]:
        """Why each box outside is outside."""
        chosen = self.state == 1
        return tuple(
            Reason(self.demands[demand][0], self.demands[demand][1], _pose(row))
            for demand, row in zip(self.demand[chosen].tolist(), self.poses[chosen].tolist(), strict=True)
        )

    @cached_property
    def excluded(self) -> dict[str, float]:
        """The share of the volume that each limit excludes, the greatest first; a design counts for one limit only."""
        volume = np.prod(self.high - self.low, axis=1) / math.prod(high - low for low, high in self.of.ranges)
        out: dict[str, float] = {}
        for n, (limit, _) in enumerate(self.demands):
            share = float(volume[(self.state == 1) & (self.demand == n)].sum())
            if share > 0.0:
                out[limit] = out.get(limit, 0.0) + share
        return dict(sorted(out.items(), key=lambda item: -item[1]))

    def state_of(self, designs: ArrayLike) -> list[str]:
        """Return "inside", "outside" or "undecided" for designs of the box, shape (k, d) in the order of `vary`."""
        x = as_floats("designs", designs, (len(self.vary),))
        if x.ndim != 2:
            raise ValueError(f"designs: got shape {x.shape}, expected (k, {len(self.vary)})")
        out = []
        for row in x:
            there = np.flatnonzero(((self.low <= row) & (row <= self.high)).all(axis=1))
            if not there.size:
                raise ValueError(f"designs: got {shown(row.tolist())}, expected designs within the box")
            out.append(STATES[min(self.state[there])])
        return out

    def around(
        self, design: HasDesign | Mapping[str, float] | None = None, proportions: Mapping[str, float] | None = None
    ) -> dict[str, tuple[float, float]]:
        """Return how far each variable may go at once: the largest box around a design that is proved inside.

        Parameters
        ----------
        design : Result or mapping, optional
            The design; `at` by default.
        proportions : mapping, optional
            The half widths of the box by variable, up to a factor: tolerances of manufacture. By default the box for
            which the product of the room to all sides is greatest: there is room to each.

        Raises
        ------
        ValueError
            If the design is not inside: the message names the limit that it breaks, if that is proved.

        """
        values = self.of.at if design is None else _values(design)
        for name in set(self.study.variables) - set(self.vary):
            if name in values and abs(values[name] - self.of.at[name]) > 1e-9 * abs(self.of.at[name]):
                raise ValueError(f"design.{name}: got {values[name]:g}, expected {self.of.at[name]:g}, as in the set")
        missing = [name for name in self.vary if name not in values]
        if missing:
            raise ValueError(f"design: got no {missing[0]}, expected a value of {', '.join(self.vary)}")
        x = [finite(name, values[name]) for name in self.vary]
        half: list[float] = []
        if proportions is not None:
            given = table("proportions", proportions)
            if set(given) != set(self.vary):
                raise ValueError(f"proportions: got {shown(list(given))}, expected {', '.join(self.vary)}")
            half = [finite(f"proportions.{name}", given[name]) for name in self.vary]
        found, low, high, broken = _core.room_around(self.of.for_core(), x, half, seconds=AROUND_SECONDS)
        if found:
            return dict(zip(self.vary, zip(low, high, strict=True), strict=True))
        words = ", ".join(f"{name} = {value:g}" for name, value in zip(self.vary, x, strict=True))
        if broken >= 0:
            broke = " ".join(self.demands[broken]).strip().replace("_", " ")
            raise ValueError(f"design: got {words}, expected one that is inside: it breaks {broke}")
        raise ValueError(f"design: got {words}, expected one around which a box is proved to be inside")

    def __repr__(self) -> str:
        """Show the shares."""
        shares = ", ".join(f"{self.shares[name]:.2%} {name}" for name in STATES)
        return f"<AdmissibleSet of {', '.join(self.vary)}: {shares}>"

    def __str__(self) -> str:
        """Return it in sentences."""
        return "\n".join(self.sentences())

    def sentences(self) -> list[str]:
        """Return what is proved, in words."""
        most = self.of.condition_number
        bound = "" if most is None else f" and a condition number of at most {most:g}"
        held = f", at {self.of.held}" if self.of.held else ""
        inside, outside, undecided = (f"{self.shares[name]:.3%}" for name in STATES)
        out = [
            f"Proved, of all designs with {self.of.words}{held}: {inside} keep every limit{bound} at every pose, "
            f"{outside} break one; {undecided} are not decided."
        ]
        if self.study.tolerances:
            out.append("Of machines as they are drawn: the tolerances of the study are not looked at.")
        if self.of.moved:
            out.append(f"The design's {' and '.join(self.of.moved)} is outside of the range: the middle is marked.")
        if self.excluded:
            by = ", ".join(f"{name.replace('_', ' ')} {share:.2%}" for name, share in self.excluded.items())
            out.append(f"Excluded by: {by}.")
        return out

    def for_core(self) -> dict[str, Any]:
        """Return the pieces as the core takes them, for a run that goes on."""
        return {
            "low": self.low,
            "high": self.high,
            "state": self.state.tolist(),
            "demand": self.demand.tolist(),
            "poses": self.poses,
        }

    def save_certificate(self, path: str | os.PathLike[str]) -> Path:
        """Write a file that `check_certificate` and the program ninedof_check replay: the question, boxes, reasons."""
        shares = [self.shares[name] for name in STATES]
        data = _core.design_certificate(self.of.for_core(), self.for_core(), self.demands, shares)
        return write_whole(path_argument("path", path), data)

    def _boxes(self, state: int) -> Floats:
        chosen = self.state == state
        return np.stack([self.low[chosen], self.high[chosen]], axis=-1)


def admissible(
    of: Study | HasDesign,
    vary: Collection[str] | Mapping[str, tuple[float, float] | None],
    **options: Unpack[AdmissibleArguments],
) -> AdmissibleSet:
    """Divide a box of designs into what keeps every limit at every pose, what breaks one, and the rest; proved.

    Merlet's parameter space for this machine: all designs that fulfil a requirement, in place of one optimum.

    Parameters
    ----------
    of : Study or Result
        The limits, the region or the poses, and the values of the variables that do not vary. The region has to say
        where O is; poses without a choice of O. A limit of the condition number needs a characteristic length that is
        a number.
    vary : names, or mapping of names to (low, high)
        One to four variables of the family; the ends of the study's bounds where none are given. Angles in radians, or
        in degrees with _deg behind the name.
    at : mapping, optional
        Values of variables, in place of those of the study or the result, or changes of these: {"zs": "+10%"}.
    condition_number : float, optional
        A bound of the condition number besides the limits.
    time_limit : float, optional
        Seconds; none by default. What is proved by then is returned, as after Ctrl-C.
    resolution : float
        Boxes are not divided below this part of each range. What is proved of the parts of the last ones is finer.
    threads : int
        0: one per processor. The result does not depend on it, but for a time limit.
    resume : AdmissibleSet, optional
        An earlier one of the same question, whose undecided boxes are gone on with.
    progress : callable, optional
        Called as progress(boxes of designs, 0, undecided share).

    Returns
    -------
    AdmissibleSet

    Raises
    ------
    ValueError
        For a variable that is unknown, fixed or without finite ends, one that is free and has no value, and for what
        has no bounds over boxes of designs; the message names it.

    Notes
    -----
    Limits are compared exactly, without the tolerance of an optimizer: an optimum on a limit lies on the boundary.
    Source: docs/theory/admissible.md; Merlet's parameter-space approach is the paper's reference 1.

    Examples
    --------
    >>> import ninedof as nd
    >>> study = nd.Study(variables={"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0})
    >>> found = nd.admissible(study, ("a2", "b1"), at={"zp": 4.9752, "zs": 3.1681}, condition_number=3.911)
    >>> f"{found.shares['inside']:.1%}"
    '18.2%'

    """
    chosen = options_of("admissible", AdmissibleArguments, options, resolution=0.01, threads=0)
    asked = design_range(of, vary, chosen["at"], chosen["condition_number"])
    seconds = LONGEST if chosen["time_limit"] is None else finite("time_limit", chosen["time_limit"], 0.0)
    resolution = finite("resolution", chosen["resolution"], 0.0, 1.0)
    threads = whole("threads", chosen["threads"], 0, MOST_THREADS)
    resume, begin = chosen["resume"], perf_counter()
    if resume is not None and instance("resume", resume, AdmissibleSet).of.digest != asked.digest:
        raise ValueError("resume: got the designs of another question, expected those of this one")
    found = _core.admissible_designs(
        asked.for_core(),
        threads=threads,
        seconds=min(seconds, LONGEST),
        resolution=resolution,
        undecided=ENOUGH,
        earlier=None if resume is None else resume.for_core(),
        progress=progress_argument(chosen["progress"]),
    )
    return AdmissibleSet(
        asked,
        low=found["low"],
        high=found["high"],
        state=found["state"],
        demand=found["demand"],
        demands=found["demands"],
        poses=found["poses"],
        shares=Fixed({name: found[name] for name in STATES}),
        designs=found["looked_at"] + (0 if resume is None else resume.designs),
        boxes=found["boxes"] + (0 if resume is None else resume.boxes),
        seconds=perf_counter() - begin + (0.0 if resume is None else resume.seconds),
        interrupted=found["interrupted"],
    )


def design_range(
    of: Study | HasDesign,
    vary: Collection[str] | Mapping[str, tuple[float, float] | None],
    at: Mapping[str, float | str] | None = None,
    condition_number: float | None = None,
    most: int = MOST_VARIED,
) -> DesignRange:
    """Return what `admissible` is asked for, checked; it says what the arguments mean. `most` variables may vary."""
    study, values = _asked(of, at)
    expected = f"names of one to {most} variables"
    given = (
        {_name(name): ends for name, ends in vary.items()}
        if isinstance(vary, Mapping)
        else dict.fromkeys(map(_name, items("vary", vary, expected)))
    )
    if not 1 <= len(given) <= most:
        raise ValueError(f"vary: got {shown(vary)}, expected {expected}")
    ends = angles_in_radians(study, {name: two for name, two in given.items() if two is not None}, _ends)
    names = tuple(dict.fromkeys(map(plain_name, given)))
    ranges = tuple(_range(study, name, ends.get(name)) for name in names)
    known, moved = set(values), list[str]()
    for name, (low, high) in zip(names, ranges, strict=True):
        if not low <= values.get(name, math.nan) <= high:
            values[name] = 0.5 * (low + high)
            moved += [name] if name in known else []
    missing = [name for name in study.variables if name not in values]
    if missing:
        raise ValueError(f"at: got no {missing[0]}, expected a value: it is free in the study and does not vary")
    if condition_number is not None:
        condition_number = finite("condition_number", condition_number, 1.0)
    return DesignRange(study, names, ranges, Fixed(values), condition_number, tuple(moved))


def _values(of: HasDesign | Mapping[str, float]) -> Mapping[str, float]:
    values = getattr(of, "variables", of)
    if values is None:
        raise ValueError("design: got a result without a design, expected one with a best candidate")
    return table("design", values)


def _asked(of: Study | HasDesign, at: Mapping[str, float | str] | None) -> tuple[Study, dict[str, float]]:
    """Return the study and the known values of its variables."""
    study = of if isinstance(of, Study) else getattr(of, "study", None)
    if not isinstance(study, Study):
        raise ValueError(f"of: got {shown(of)}, expected a Study or a Result")
    study.require_no_choice()
    values = {name: ends for name, ends in study.variables.items() if not isinstance(ends, tuple)}
    if of is not study:
        values |= {name: x for name, x in _values(of).items() if name in study.variables}  # type: ignore[arg-type]
    values |= given_values(study, values, {} if at is None else table("at", at), "at")
    region = study.objective.region
    if region is not None and not places_o(region):
        raise ValueError('internal_point: got "best", expected a region that says where O is: "shifted" or "held"')
    return study, values


def _name(name: object) -> str:
    return text("vary", name)


def _ends(name: str, ends: object) -> tuple[float, float]:
    low, high = (finite(f"vary.{name}", end) for end in pair(f"vary.{name}", ends, "(low, high)"))
    return low, high


def _range(study: Study, name: str, ends: tuple[float, float] | None) -> tuple[float, float]:
    if name not in study.variables:
        raise ValueError(f"vary: got {shown(name)}, expected variables of the study: {', '.join(study.variables)}")
    bounds = study.variables[name] if ends is None else ends
    if not isinstance(bounds, tuple):
        raise ValueError(f"vary.{name}: got a variable that is fixed in the study, expected its ends (low, high) too")
    low, high = _ends(name, bounds)
    if not low < high:
        raise ValueError(f"vary.{name}: got ({low:g}, {high:g}), expected low < high")
    return low, high


def _pose(row: list[float]) -> ProofPose:
    listed, x, y, z, tilt_x, tilt_y, yaw = row[:7]
    if listed >= 0:
        return ProofPose(listed=int(listed))
    return ProofPose((x, y, z), (tilt_x, tilt_y, 0.0), yaw)
