"""A study over a region of poses with O placed anew at every pose.

A design is good if there is a range of lengths for each leg, allowed by the limits that compare poses, such that at
every pose some O keeps the index, the limits and the ranges. The exchange is that of `exchange`, and a search places O
at each pose that it looks at.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np

from ninedof import _core
from ninedof.design.leg_limits import leg_limits_of
from ninedof.design.pose import Pose
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.optimize.exchange import DENSE, MOST_ROUNDS, NEAR, QUICK, SAME, At, Solve, first_poses, optimize_region
from ninedof.optimize.pieces import Pieces
from ninedof.optimize.region_report import PASSED, RegionReport, posed
from ninedof.optimize.result import Candidate, Result, Status
from ninedof.optimize.warm import Warm
from ninedof.support.arrays import Floats

Shift = tuple[float, float, float]
"""Of s from its neutral position, in zp."""
Place = tuple[At, Shift]
"""A pose of a region with O."""

LOOSE = 1e-6  # the excess that ends the rounds of the quick solver
NEARLY = 1e-5  # the violation up to which an end of the quick solver is a design
BRANCH = 0.2  # of the region: nearer poses do not join together
MOST_JOINED = 16  # in a round
IDLE = -0.03  # a pose where O leaves so much to spare does not rule
DECIDING = -1e-4  # one where it leaves less takes part when O is a variable
NEIGHBOURS = 0.05  # of the region: of nearer poses only the worst does, since two of them say nearly the same
SAME_END = 1e-6  # of logarithms of the index: starts that agree
SETTLED = 12  # rounds after which poses are added only, so that the exchange comes to an end
SHARE = 8  # one start in so many is run with O placed; the others with O shifted


@dataclass(frozen=True)
class Design:
    """A design and O at each of its poses, those of the study first."""

    x: tuple[float, ...]
    shifts: tuple[Shift, ...]
    log_objective: float = math.inf


@dataclass(frozen=True)
class Look:
    """A search of the region, O being placed at every pose."""

    worse: tuple[Place, ...]
    """Where the design is worse than it may be, the worst first."""
    excess: tuple[float, ...]
    """At the poses that rule: what O leaves there, negative where there is something to spare."""
    looked_at: int
    log_objective: float
    objective_at: Place
    margin: float
    limit: str


class _Program:
    """What stays the same in all rounds."""

    def __init__(self, study: Study, threads: int, pieces: Pieces) -> None:
        self.pieces = pieces
        region = study.objective.region
        assert region is not None
        self.study, self.region, self.threads = study, region, threads
        self.plain = replace(study, objective=replace(study.objective, poses=(), region=None)).problem()
        self.listed = len(study.objective.poses)
        self.height = list(self.plain.names).index("zp")

    def posed(self, ruling: Sequence[Place]) -> Study:
        return posed(self.study, tuple(self.pose(at) for at, _ in ruling))

    def pose(self, at: At, shift: Shift | None = None, zp: float = 1.0) -> Pose:
        position, rotation, _ = _core.region_pose(self.region.for_core(), at)
        if shift is None:
            return Pose(position, rotation, "best", self.region.unit)
        size = zp if self.region.unit == "length" else 1.0
        x, y, z = (size * v for v in shift)
        return Pose(position, rotation, (x, y, z), self.region.unit)

    def shifted(self, at: At, x: Sequence[float]) -> Shift:
        size = x[self.height] if self.region.unit == "length" else 1.0
        a, b, c = (float(v) / size for v in _core.region_pose(self.region.for_core(), at)[0])
        return a, b, c

    def of_candidate(self, best: Candidate, poses: int) -> Design:
        """Return a candidate with O at the listed and `poses` further poses."""
        shifts = tuple(_shift(best.variables, k) for k in range(self.listed + poses))
        return Design(tuple(best.variables[name] for name in self.plain.names), shifts, math.log(best.objective))

    def variables(self, design: Design) -> dict[str, float]:
        """Return the variables by name, with O at every pose."""
        out = dict(zip(self.plain.names, design.x, strict=True))
        for k, shift in enumerate(design.shifts):
            out |= {f"pose{k + 1}.s_{axis}": v for axis, v in zip("xyz", shift, strict=True)}
        return out

    def solve(self, ruling: Sequence[Place], given: Sequence[Design], starts: int) -> list[Design]:
        """Return the feasible ends of the quick solver, best first."""
        entries = [(list(d.x), [list(s) for s in d.shifts]) for d in given]
        how = (starts, self.study.seed, self.threads)
        found = self.pieces.plain(lambda: _core.optimize_placed(self.posed(ruling).problem(), entries, *how))
        ends = [
            Design(tuple(x), tuple(_shifted_by(shift) for shift in shifts), index)
            for x, shifts, index, violation in found
            if violation <= NEARLY
        ]
        return sorted(ends, key=lambda d: d.log_objective)

    def common_range(self, ruling: Sequence[Place], design: Design) -> tuple[tuple[float, float], ...]:
        """Return the least and greatest length of each leg that all limits allow; nothing if none compares poses."""
        zp = design.x[self.height]
        return tuple(_core.common_range(self.plain, zp, self._lengths(ruling, design), *leg_limits_of(self.study, zp)))

    def look(self, ruling: Sequence[Place], design: Design, samples: int, seed: int, passed: float) -> Look:
        """Search the region for where a design is worst although O is placed."""
        known = self.placed(ruling, design)
        ranges = _core.leg_ranges(self.plain, design.x[self.height], self._lengths(ruling, design))
        region = self.region.for_core()
        found = self.pieces.plain(
            lambda: _core.search_region_placed(
                self.plain, region, design.x, design.log_objective, ranges, known, samples, seed, self.threads
            )
        )
        ends = sorted(found["ends"], key=lambda end: -end[2])
        worst = max(ends, key=lambda end: end[3])
        margin, limit = min(((end[4], end[5]) for end in ends), default=(math.inf, ""))
        return Look(
            tuple(_place(end) for end in ends if end[2] > passed),
            tuple(found["at_known"]),
            found["poses"],
            worst[3],
            _place(worst),
            margin,
            limit,
        )

    def kept(self, ruling: Sequence[Place], design: Design, look: Look, idle: float) -> list[int]:
        """Return the poses where O leaves less than -`idle` to spare or a leg is longest or shortest, and the first."""
        lengths = self._lengths(ruling, design)
        extreme = (lengths >= lengths.max(axis=0) * (1.0 - NEAR)) | (lengths <= lengths.min(axis=0) * (1.0 + NEAR))
        ends = extreme.any(axis=1)[self.listed :]
        return [k for k, excess in enumerate(look.excess) if k == 0 or ends[k] or excess > idle]

    def placed(self, ruling: Sequence[Place], design: Design) -> list[Place]:
        """Return the poses with O where the design has it."""
        return [(at, shift) for (at, _), shift in zip(ruling, design.shifts[self.listed :], strict=True)]

    def deciding(self, ruling: Sequence[Place], design: Design, look: Look) -> list[Place]:
        """Return the poses that decide the design, of neighbours only the worst."""
        places = self.placed(ruling, design)
        out: list[Place] = []
        for k in sorted(self.kept(ruling, design, look, DECIDING), key=lambda k: -look.excess[k]):
            if not self._beside(places[k], out):
                out.append(places[k])
        return out

    def replaced(self, ruling: Sequence[Place], design: Design, look: Look) -> list[Place]:
        """Return the poses with those where the design is worse, which take the place of their neighbours."""
        new = self.joined((), look)
        return [place for place in self.placed(ruling, design) if not self._beside(place, new)] + new

    def _beside(self, place: Place, others: Iterable[Place]) -> bool:
        return any(self.apart(place[0], other) <= NEIGHBOURS for other, _ in others)

    def joined(self, ruling: Sequence[Place], look: Look) -> list[Place]:
        """Return the poses with those where the design is worse, far enough from each other."""
        new: list[Place] = []
        for at, shift in look.worse:
            if len(new) == MOST_JOINED:
                break
            if any(self.apart(at, other) <= SAME for other, _ in ruling):
                continue
            if all(self.apart(at, other) > BRANCH for other, _ in new):
                new.append((at, shift))
        return [*ruling, *new]

    def apart(self, one: At, other: At) -> float:
        """Return the distance of two poses in parts of the region."""
        return float(np.max(np.abs(np.subtract(one, other)) / np.maximum(self.region.reach, 1e-300)))

    def named(self, there: Study, design: Design) -> dict[str, float]:
        """Return the variables of a design that a study with poses has."""
        names = set(there.problem().names)
        return {name: value for name, value in self.variables(design).items() if name in names}

    def _lengths(self, ruling: Sequence[Place], design: Design) -> Floats:
        there = self.posed(ruling)
        point = there.evaluate(self.named(there, design))
        return np.asarray(leg_lengths(point.geometry, point.configurations[1:]))


def optimize_placed(
    study: Study, solve: Solve, warm: Warm | Iterable[Warm] | None, threads: int, pieces: Pieces
) -> Result:
    """Solve a region study with O placed at every pose: `solve` as in `exchange.optimize_region`, `pieces` kept.

    The start is the optimum with O shifted, so that the result is not worse than that. While poses join, a quick solver
    is used that places O inside; at the end `solve` has O at the ruling poses as variables, and its checks decide.
    """
    begin = perf_counter()
    program = _Program(study, threads, pieces)
    shifted = _shifted(study, solve, warm, threads, pieces)
    if shifted.interrupted:
        return shifted
    state = _State(shifted, *_first(program, shifted))
    try:
        for state.rounds in range(1, MOST_ROUNDS + 1):
            if not _round(program, solve, state):
                break
        interrupted = state.found is not None and state.found.interrupted
    except KeyboardInterrupt:
        interrupted = True
    if interrupted or state.found is None or state.found.best is None:
        result = _unfinished(program, solve, state, interrupted)
    else:
        result = _finished(program, state)
    return replace(result, study=study, evaluations=state.evaluations, seconds=perf_counter() - begin)


@dataclass
class _State:
    """Where the exchange is."""

    shifted: Result
    ruling: list[Place]
    given: list[Design]
    found: Result | None = None
    look: Look | None = None
    design: Design | None = None
    """The one that was looked at last, with its poses."""
    imposed: tuple[Place, ...] = ()
    rounds: int = 0
    all_starts: bool = True
    thorough: bool = False
    """Whether all starts have been run with all poses."""
    exact: bool = False
    """Whether O is a variable at every pose."""
    tried: int = 0
    reached: int = 0

    def __post_init__(self) -> None:
        """Count what was spent already."""
        self.evaluations = self.shifted.evaluations


def _round(program: _Program, solve: Solve, state: _State) -> bool:
    """Solve with the poses that rule, look between them, and add some; False at the end."""
    imposed = tuple(state.ruling)
    if state.exact:
        state.found = solve(program.posed(imposed), 0, [program.variables(state.given[0])])
        state.evaluations += state.found.evaluations
        if state.found.best is None or state.found.interrupted:
            return False
        design = program.of_candidate(state.found.best, len(imposed))
    else:
        starts = math.ceil(program.study.starts / SHARE) if state.all_starts else 0
        ends = program.solve(imposed, state.given, starts)
        if not ends:
            return False
        design = ends[0]
        if starts:
            state.tried = len(state.given) + starts
            state.reached = sum(end.log_objective <= design.log_objective + SAME_END for end in ends)
    state.imposed, state.design, state.look = imposed, design, None
    look = program.look(imposed, design, QUICK, state.rounds, PASSED if state.exact else LOOSE)
    if state.exact and not look.worse:
        look = program.look(imposed, design, DENSE, state.rounds, PASSED)
    state.look = look
    if state.exact and not look.worse:
        return False
    known = [at for at, _ in imposed]
    nothing_new = all(any(program.apart(at, other) <= SAME for other in known) for at, _ in look.worse)
    if state.exact and nothing_new:
        return False  # the same problem again
    done = nothing_new and (state.thorough or program.study.starts == 1)
    if state.exact:
        state.ruling = program.replaced(imposed, design, look)
    elif done:
        state.ruling = program.deciding(imposed, design, look)
    else:
        # Poses that are far from deciding anything leave: at first all, once they go round in circles none.
        idle = -math.inf if state.rounds > SETTLED else IDLE
        places = program.placed(imposed, design)
        state.ruling = program.joined([places[k] for k in program.kept(imposed, design, look, idle)], look)
    state.given = [Design(design.x, (*design.shifts[: program.listed], *(shift for _, shift in state.ruling)))]
    state.all_starts = nothing_new and not done and not state.exact
    state.thorough |= state.all_starts
    state.exact |= done
    return True


def _finished(program: _Program, state: _State) -> Result:
    """Return the result of the last round without the poses that are far from deciding anything."""
    found, look, design = state.found, state.look, state.design
    assert found is not None
    assert look is not None
    assert design is not None
    best = found.candidates[0]
    if look.worse:
        reason = f"after {state.rounds} rounds the design is still worse between the poses than at them"
        found = replace(found, status=Status.STOPPED if found.status == Status.OPTIMAL else found.status, reason=reason)
    elif found.status == Status.STOPPED:
        reason = (
            f"no limit is passed in the region, but the test of stationarity leaves {best.optimality_residual:.1e}: "
            "a slightly better design may exist"
        )
        found = replace(found, reason=reason)
    kept = program.kept(state.imposed, design, look, -NEAR)
    numbers = [*range(program.listed), *(program.listed + k for k in kept)]
    ruling = [state.imposed[k] for k in kept]
    fewer = Design(design.x, tuple(design.shifts[k] for k in numbers), design.log_objective)
    best = replace(
        best,
        variables=program.named(program.posed(ruling), fewer),
        conditions=tuple(best.conditions[k] for k in numbers),
        configurations=best.configurations[[0, *(k + 1 for k in numbers)]],
        reached=state.reached,
    )
    worst_at = program.pose(*look.objective_at, zp=design.x[program.height])
    report = RegionReport(
        tuple(program.pose(at) for at, _ in ruling),
        state.rounds,
        look.looked_at,
        math.exp(look.log_objective),
        worst_at,
        look.margin,
        look.limit,
        leg_ranges=program.common_range(state.imposed, design),
    )
    abandoned = max(program.study.starts - state.tried, 0)
    return replace(
        found,
        region=report,
        candidates=(best,),
        starts_done=state.tried + abandoned,
        runs_abandoned=abandoned,
        runs_completed=state.tried,
    )


def _unfinished(program: _Program, solve: Solve, state: _State, interrupted: bool) -> Result:
    """Return the optimum with O shifted, or why there is no design."""
    shifted = state.shifted
    reason = "interrupted while O was being placed; the design is the optimum with O shifted"
    if shifted.best is None or shifted.region is None:
        if interrupted:
            return replace(shifted, status=Status.STOPPED, interrupted=True, reason=reason.partition(";")[0])
        found = solve(program.posed(state.ruling), program.study.starts, None)
        if found.best is None:
            return found
        reason = (
            "the quick solver found no design with O placed, although there is one at the first poses: raise starts"
        )
        return replace(found, status=Status.STOPPED, reason=reason, candidates=())
    if not interrupted:
        reason = "no start with O placed passed the checks; the design is the optimum with O shifted"
    report = replace(shifted.region, looked_at=0)
    return replace(shifted, status=Status.STOPPED, interrupted=interrupted, reason=reason, region=report)


def _shifted(study: Study, solve: Solve, warm: Warm | Iterable[Warm] | None, threads: int, pieces: Pieces) -> Result:
    region = study.objective.region
    assert region is not None
    with_shifted = replace(study.objective, region=replace(region, internal_point="shifted"))
    found = optimize_region(replace(study, objective=with_shifted), solve, warm, threads, pieces)
    return replace(found, study=study)


def _first(program: _Program, shifted: Result) -> tuple[list[Place], list[Design]]:
    """Return the poses of the first round and the design to start from, if there is one."""
    every = first_poses(program.region)
    best = shifted.best
    if best is None:
        return [(at, (0.0, 0.0, 0.0)) for at in every], []
    x = tuple(best.variables[name] for name in program.plain.names)
    ruling = [(at, program.shifted(at, x)) for at in every]
    listed = [_shift(best.variables, k) for k in range(program.listed)]
    return ruling, [Design(x, (*listed, *(shift for _, shift in ruling)))]


def _place(end: Sequence[Any]) -> Place:
    return tuple(end[0]), _shifted_by(end[1])


def _shifted_by(shift: Sequence[float]) -> Shift:
    x, y, z = shift
    return x, y, z


def _shift(variables: Mapping[str, float], k: int) -> Shift:
    x, y, z = (variables.get(f"pose{k + 1}.s_{axis}", 0.0) for axis in "xyz")
    return x, y, z
