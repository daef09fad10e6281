"""Results of optimizations: distinct local optima and the end of the search."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from ninedof.design.design_point import DERIVED, design_point
from ninedof.design.domains.region_poses import o_is_placed, posed
from ninedof.design.duty import Tolerances
from ninedof.design.study import Study
from ninedof.design.variables import changed_variables
from ninedof.optimize.actuator_choice import ActuatorChoice
from ninedof.optimize.candidate import Candidate, OfStudy, RegionReport, best_of, candidate_at, candidate_from
from ninedof.optimize.reserve import Reserve, certified, largest, machine_of
from ninedof.optimize.tables import agreement_sentence, candidates_table, internal_point_words, summary_lines
from ninedof.proof.machine import machine_digest
from ninedof.proof.machine_file import machine_file
from ninedof.proof.machine_record import MachineCertificate
from ninedof.proof.optimum_proof import OptimumProof
from ninedof.robot.configuration import Configuration
from ninedof.sheet.sheet import Sheet, sheet
from ninedof.support.arguments import instance, path_argument
from ninedof.support.kept.files import write_whole
from ninedof.support.structs import entries_of, plain_fields, within
from ninedof.tables.html import notebook

T = TypeVar("T")


class Status(StrEnum):
    """The end of an optimization."""

    OPTIMAL = "optimal"
    """Feasible and stationary by independent checks of the design."""
    UNBOUNDED = "unbounded"
    """No least value: the objective keeps falling as the variables in `causes` grow."""
    INFEASIBLE = "infeasible"
    """No design found satisfies all limits: those in `causes` exclude each other, and fewer of them do not."""
    STOPPED = "stopped"
    """Interrupted, or no design passed the checks. The best design found is returned, but it is not an optimum."""


class _OfBest(property, Generic[T]):
    """A property of the best candidate of a result; None without one."""

    def __init__(self, get: Callable[[Candidate], T], doc: str) -> None:
        super().__init__(lambda result: get(result.best) if result.best else None, doc=doc)

    if TYPE_CHECKING:

        def __get__(self, result: Any, owner: type | None = None) -> T | None: ...  # type: ignore[override]


@dataclass(frozen=True)
class Result(OfStudy):
    """The result of an optimization. Properties of a design are those of the best candidate, or None without one."""

    status: Status
    reason: str
    """One sentence. Of an infeasible study: how far each limit alone would have to give; angles in degrees."""
    causes: tuple[str, ...]
    """Variables or constraints behind "unbounded" or "infeasible"; a variable stands for its bounds."""
    candidates: tuple[Candidate, ...]
    """Distinct local optima, best first; of many with the same objective, four. Designs that differ by a reflection, a
    rotation about z or the numbering of their joints count as one, and so do those that differ in size where only the
    shape matters, or in a variable without effect. At poses that do not decide, their condition numbers may differ."""
    evaluations: int
    starts_done: int
    """Over all rounds; more than the study's `starts` where few agreed, see `optimize`."""
    seconds: float
    study: Study = field(metadata=DERIVED)
    interrupted: bool = False
    """Whether Ctrl-C ended the run."""
    runs_abandoned: int = field(default=0, kw_only=True)
    """Starts among those done that were given up after a short run."""
    region: RegionReport | None = field(default=None, kw_only=True)
    """Of a region study: what was looked at, and the worst that was found."""
    proof: OptimumProof | None = field(default=None, kw_only=True)
    """The proof about every design of the study, with `certify`."""
    actuators: ActuatorChoice | None = field(default=None, kw_only=True)
    """Of a study with actuators: the rows of its legs. `study` then has their limits in the place of the catalogue."""
    reserve: Reserve | None = field(default=None, kw_only=True)
    """Of a study with tolerances: what the search kept of its limits, so that every machine within them keeps them."""
    runs_completed: int | None = field(default=None, kw_only=True)
    """Starts followed to their end in the round that found the best design, where that is known; warm starts, which are
    no evidence, are not counted."""

    def __post_init__(self) -> None:
        """Let every candidate know the study, so that its sheet, payload, export, ... are as the result's."""
        own = tuple(replace(one, study=self.study, region=self.region) for one in self.candidates)
        object.__setattr__(self, "candidates", own)

    @property
    def best(self) -> Candidate | None:
        """The best candidate."""
        return self.candidates[0] if self.candidates else None

    @property
    def confidence(self) -> float:
        """Fraction of the starts followed to their end that reached the best candidate, from 0 to 1; 0 without one.

        It is no probability that the best candidate is the best of all, and starts given up after a short run have no
        part in it: see `agreement`.
        """
        return min(1.0, self.best.reached / self._completed) if self.best and self._completed > 0 else 0.0

    @property
    def agreement(self) -> str:
        """Sentence on starts that arrived, were followed and given up, and on optima that they may have missed."""
        if not self.study.has_free_variables and self.best:
            return "no variable is free: this is the design of the study, and no other was looked for"
        arrived = min(self.best.reached, self._completed) if self.best else 0
        return agreement_sentence(self._completed, arrived, self.runs_abandoned, self.status == Status.OPTIMAL)

    @property
    def _completed(self) -> int:
        return self.starts_done - self.runs_abandoned if self.runs_completed is None else self.runs_completed

    objective = _OfBest(lambda c: c.objective, "Objective of the best candidate.")
    condition_number = _OfBest(
        lambda c: c.condition_number, "Worst condition number of the best candidate over the poses of the study."
    )
    neutral_condition_number = _OfBest(lambda c: c.neutral_condition_number, "The same at its neutral pose alone.")
    conditions = _OfBest(lambda c: c.conditions, "Its condition numbers at the poses of the objective.")
    characteristic_length = _OfBest(lambda c: c.characteristic_length, "Characteristic length of the best candidate.")
    variables = _OfBest(lambda c: c.variables, "Variables of the best candidate by name, angles in radians.")
    geometry = _OfBest(lambda c: c.geometry, "Geometry of the best candidate.")
    configuration = _OfBest(lambda c: c.configuration, "Neutral configuration of the best candidate.")
    configurations = _OfBest(
        lambda c: c.configurations, "Neutral configuration and poses of the best candidate: a stack."
    )
    active = _OfBest(lambda c: c.active, "Active bounds and constraints of the best candidate.")
    prices = _OfBest(lambda c: c.prices, "Its shadow prices: per cent of the objective for 1 % of each active limit.")
    optimality_residual = _OfBest(lambda c: c.optimality_residual, "Stationarity of the best candidate.")
    constraint_violation = _OfBest(lambda c: c.constraint_violation, "Violation of the best candidate.")

    @property
    def lower_bound(self) -> float | None:
        """The proved bound that no condition number of the study is below; None without a proof."""
        return None if self.proof is None else self.proof.lower_bound

    @property
    def words(self) -> str:
        """Name of `objective`: that of the study, or that at a few poses of a region which does not keep it between."""
        over = self.region
        if over is None or (over.looked_at > 0 and (self.status != Status.STOPPED or over.is_settled)):
            return self.study.words
        return self.study.objective.worded(self.study.unit, len(self.solved.objective.poses))

    def to_dict(self) -> dict[str, Any]:
        """Return every field but the study as plain values, and the confidence; the candidates come last."""
        out = plain_fields(self)
        candidates = out.pop("candidates")
        return out | {"confidence": self.confidence, "candidates": candidates}

    @cached_property
    def internal_points(self) -> str:
        """Place of O at the poses of the study, and legs that never move because of it; "" with fewer than two."""
        return internal_point_words(self)

    def __repr__(self) -> str:
        """Show the status, and the objective and active limits of the best candidate."""
        if self.best is None:
            return f"<Result: {self.status}, causes: {', '.join(self.causes) or 'none found'}>"
        value = f"{self.words} = {self.best.objective:.6f}"
        return f"<Result: {self.status}, {value}, limits reached: {', '.join(self.best.active) or 'nothing'}>"

    def _repr_html_(self) -> str:
        if not self.candidates:
            return notebook(f"{self.status}: {self.reason}", f"causes: {', '.join(self.causes) or 'none found'}")
        return notebook(f"{self.status}: {self.reason}", candidates_table(self))

    def sheet(self, poses: Configuration | None = None, **options: Any) -> Sheet:
        """Return the engineering sheet of the best candidate: `ninedof.sheet` with its arguments."""
        return sheet(self, poses, **options)

    def with_changes(self, **changes: float | str) -> Result:
        """Return what the result would be with other values of the variables of its best design.

        Nothing is optimized, and limits and bounds of variables may be violated; `compare` shows which limits. A free
        characteristic length and free offsets of O keep their values.

        Parameters
        ----------
        **changes
            A variable of the family, or "characteristic_length" if that is free, to its new value or to a change of it:
            a2=900.0, a2="+10%", theta_z_deg=30.0.

        Returns
        -------
        Result
            One candidate, status "stopped". Of a region study it is not yet looked at over the region, which
            `compare` and `sheet` do.

        Raises
        ------
        ValueError
            Without a design; for an unknown variable; if there is no such design, as with a negative side; if the
            study places O anew over a region and compares leg lengths there.

        """
        best, region = best_of(self), self.region
        if region is not None and region.leg_ranges:
            raise ValueError(
                "changes: got a study that places O in a region and compares leg lengths there, expected another one: "
                "optimize it with fixed variables"
            )
        values = changed_variables(self.study, best.variables, changes)
        # Where O is placed anew, the poses that ruled have it where the old design wants it.
        imposed = () if region is None or o_is_placed(self.study) else region.poses
        problem = posed(self.study, imposed).problem()
        with within(", ".join(changes), ": "):  # plates without a size
            point = design_point(problem, [values[name] for name in problem.names])
        if region is not None:
            region = RegionReport(imposed, 0, 0, point.objective, region.objective_at, math.nan, "")
        reason = f"changed, not optimized: {', '.join(f'{name} = {change}' for name, change in changes.items())}"
        candidates = (candidate_at(point, math.inf),)
        return Result(Status.STOPPED, reason, (), candidates, 1, 0, 0.0, self.study, region=region)

    def certify(self, **options: Any) -> MachineCertificate:
        """Prove the limits of the study at every pose of its region, and enclose the worst condition number there.

        Parameters
        ----------
        **options
            condition_number : a bound of the condition number to be proved too. gap : relative width of the enclosure
            of the worst one, 0.05. time_limit : seconds for it, 300. slack : by which limits may be violated, relative,
            1e-6. tolerance : of joints and legs as built, those of the study if left out. threads : 0, one per
            processor. rule : where O is, where the study places it anew at every pose of a region; fitted to the best O
            if left out. resume : an earlier certificate to go on with. progress : called with boxes done, 0 and the
            worst condition number met; one with a method `phase` is told what begins. keep : called every 20 seconds
            with the certificate so far, which `resume` goes on with.

        Returns
        -------
        MachineCertificate
            Of each limit: proved, violated or undecided.

        Raises
        ------
        ValueError
            Without a design; for a bad option.

        """
        return certified(self, options)

    def save_certificate(self, certificate: MachineCertificate, path: str | os.PathLike[str]) -> Path:
        """Write a file that `check_certificate` and the program ninedof_check replay: this machine, and its limits.

        Parameters
        ----------
        certificate : MachineCertificate
            Of this design, as it is drawn: without tolerances, and O shifted or held in a region.
        path : path

        Returns
        -------
        Path
            Of the file. It has every limit with the slack of the certificate, and the bound of the condition number.

        Raises
        ------
        ValueError
            If a limit is not proved, for a certificate of another machine, or where the file cannot say what is proved.

        """
        if not self.is_certified_by(certificate):
            raise ValueError("certificate: got one of another machine, expected one of this design")
        data = machine_file(self.study, self.variables or {}, machine_of(self)[2], certificate)
        return write_whole(path_argument("path", path), data)

    def largest_tolerance(self, **options: Any) -> Tolerances:
        """Return the largest tolerances of manufacture with which `certify` proves all limits.

        Joints and legs are in the ratio of the study's tolerances, with which the search begins, or alike.

        Parameters
        ----------
        **options
            condition_number, slack, threads, rule, progress : as those of `certify`, no slack by default. time_limit :
            seconds, 60: a limit has a twelfth of it in each proof, and as much as in `certify` in that of the study's
            own tolerances.

        Returns
        -------
        Tolerances
            To 5 %, or smaller ones where the time ended a proof: nothing says so; a longer `time_limit` may prove
            larger ones. `Tolerances()`, both zero and false, where none is proved: a limit leaves no reserve, or the
            time was too short. An optimum
            lies on its limits, unless the study has tolerances, for which `optimize` leaves a reserve. The limit is
            `min(result.certify().limits, key=lambda limit: limit.margin).name`.

        Raises
        ------
        ValueError
            Without a design; for a bad option.
        KeyboardInterrupt
            With the largest tolerances proved so far.

        """
        return largest(self, options)[0]

    def is_certified_by(self, certificate: MachineCertificate) -> bool:
        """Whether a certificate is one of this design at these poses, as `certify` returned it."""
        instance("certificate", certificate, MachineCertificate)
        machine = machine_digest(self.study, *machine_of(self), certificate.tolerances) if self.candidates else None
        return certificate.machine == machine

    def summary(self) -> str:
        """Return a few lines: status, objective, active limits and their prices, what the starts show."""
        return "\n".join(summary_lines(self))


def with_fixed_design(result: Result) -> Result:
    """Return a result without a design with the one design of its study, if no variable is free, whatever it violates.

    It is for showing the indices and margins of that design; the result itself has no best design. A design that is
    singular at every pose is no robot and has none: the reason of the result says so.
    """
    study = result.study
    if result.candidates or study.free_variables:
        return result
    try:
        point = study.evaluate({})
    except ValueError:
        return result
    return replace(result, candidates=(candidate_at(point, math.nan),))


def result_from(study: Study, data: Mapping[str, Any]) -> Result:
    """Return the result of a mapping as `Result.to_dict` makes it."""
    entries = entries_of(Result, data, skipped=["candidates", "study"])
    region = entries.get("region")
    problem = (study if region is None else posed(study, region.poses)).problem()
    candidates = tuple(candidate_from(problem, entry) for entry in data["candidates"])
    return Result(**entries, candidates=candidates, study=study)
