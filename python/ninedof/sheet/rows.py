"""The rows of a sheet: the nine legs, the limits of the study, the nearest singularities."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from ninedof import _core
from ninedof.design.limit_numbers import JOINTS
from ninedof.design.objective import CONDITION_LIMITS
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import LEGS, Geometry
from ninedof.robot.idle import idle_legs
from ninedof.singularity.singularity import mechanisms_of
from ninedof.support.arrays import Floats
from ninedof.support.margins import is_violated
from ninedof.support.structs import rows_of
from ninedof.support.units import amount, kind_unit
from ninedof.tables.numbers import load_text, short

MOTIONS = ("shift", "turn", "internal")


class NearSingularity(NamedTuple):
    """The nearest singularity for one way of moving."""

    motion: str
    """"shift": of the platform, O with it, or held where O is held over the poses. "turn": of the platform about its
    origin, O at rest. "internal": O alone."""
    distance: float
    """Length, or radians for a turn; infinite where none was found within four times the longest leg or half a turn."""
    mechanism: str
    """"n", "b" or "c": the determinant that is zero there; "" if none was found."""
    pose: int
    """The pose it is nearest to."""
    direction: tuple[float, ...]
    """Unit vector of the shift or axis of the turn, base axes."""
    position: tuple[float, ...]
    """p, Q and O where it is."""
    rotation: tuple[tuple[float, ...], ...]
    internal_point: tuple[float, ...]


def near_singularities(g: Geometry, c: Configuration, internal: str) -> dict[str, NearSingularity]:
    """Return the nearest singularity of a stack of poses, `nearest_singularity`, for each of MOTIONS."""
    out = {}
    for name, near in zip(MOTIONS, _core.nearest_singularities(g, c, internal == "held"), strict=True):
        there = near.configuration
        out[name] = NearSingularity(
            name,
            near.distance,
            str(mechanisms_of(near.mechanism)),
            near.pose,
            tuple(near.direction.tolist()),
            tuple(there.position.tolist()),
            tuple(map(tuple, there.rotation.tolist())),
            tuple(there.internal_point.tolist()),
        )
    return out


class LimitRow(NamedTuple):
    """One side of a limit beside the worst value of the design at the study's own poses."""

    name: str
    """As margins call it: `Limit.label`."""
    side: str
    """"min" or "max"."""
    limit: float
    """Angles in radians."""
    value: float
    """In the unit of the limit."""
    margin: float
    """As `margin_of`, negative if violated: `DesignPoint.margins`."""
    part: str
    """The leg, the pair of legs ("l1-q2") or the determinant that reaches it; "" for a limit without parts."""
    unit: str
    """"ratio", "length", "angle", "sign", "number", "rate" or "power" as in the table of constraints; "ratio" for a
    length over zp or a radius."""

    @property
    def violated(self) -> bool:
        """Whether the limit is violated beyond the tolerance, or nothing is known of it."""
        return is_violated(self.margin, self.unit, self.limit)


def limit_amount(row: LimitRow, value: float, unit: str, force_unit: str = "") -> str:
    """Return a value of a limit with its unit; an angle in degrees, forces, rates and powers as their tables do."""
    if row.unit == "angle":
        return f"{math.degrees(value):.2f}°"
    number = load_text if row.unit in ("number", "rate", "power") else short
    return amount(number(value), kind_unit(row.unit, unit, force_unit))


def limit_rows(study: Study, variables: Mapping[str, float]) -> tuple[LimitRow, ...]:
    """Return a row for each side of each limit, in the order of the study."""
    problem, x, rows = study.problem(), study.vector(variables), []
    for limit in study.limits:
        for side, bound in limit.sides.items():
            low, high = (bound, math.inf) if side == "min" else (0.0, bound)
            alone = problem.with_limits([study.limit_for_core(replace(limit, low=low, high=high))], math.inf, math.inf)
            rows.append(_row(side, bound, limit.kind, alone.evaluate(x)))
    for name in CONDITION_LIMITS:
        if (bound := getattr(study.objective, name)) is not None:
            alone = problem.with_limits([], *(bound if name == other else math.inf for other in CONDITION_LIMITS))
            rows.append(_row("max", bound, "ratio", alone.evaluate(x)))
    return tuple(rows)


def _row(side: str, bound: float, kind: str, point: _core.Evaluation) -> LimitRow:
    (one,) = point.margins
    return LimitRow(one.name, side, bound, one.limited, one.value, one.part, kind)


OF_EVERY_LEG = ("shortest", "longest", "neutral", "stroke", "stroke_ratio", "idle", "speed", "acceleration")
CONES = tuple(f"{body}_cone" for body in ("base", "platform"))
RANGES = ("twist_speed", "twist_acceleration")
LARGEST = ("speed", "acceleration", "power")


@dataclass(frozen=True)
class LegRow:
    """One leg over the poses of a sheet."""

    name: str
    """l1 to l3 external, q1 to q3 upper internal, r1 to r3 lower internal."""
    shortest: float
    longest: float
    neutral: float
    """The length at the neutral pose."""
    stroke: float
    """longest - shortest."""
    stroke_ratio: float
    """longest / shortest."""
    idle: bool
    """Whether it has the same length at all poses, of which there are several."""
    speed: float
    """Largest rate over the directions of the motion and the poses."""
    acceleration: float
    """Bound of its acceleration over the same while the platform's velocities are constant."""
    base_cone: float | None
    """Largest angle at its base joint, base frame, rad, from the axis that a limit of the study has there, else from
    its direction at the neutral pose: `Sheet.cone_axes`. None without such a joint."""
    platform_cone: float | None
    """The same at its platform joint, platform frame."""
    forces: tuple[tuple[float, float], ...]
    """Least and largest force for each load, positive where the leg pushes."""
    power: float | None = None
    """Greatest of force times speed, at one pose and under one load; None without loads."""
    twist_speed: tuple[float, float] | None = None
    """Least and largest rate for the given twist; None without one."""
    twist_acceleration: tuple[float, float] | None = None
    """Least and largest acceleration for the given twist and its rate."""
    permitted: tuple[float, float] | None = None
    """The lengths that the limits of the study leave it and, if O is placed at every pose of a region and limits
    compare poses, between which placing O keeps it; None where nothing limits a leg. `shortest` and `longest` are
    those that the poses need."""

    @property
    def largest_force(self) -> float:
        """The greatest force, pushing or pulling, of all loads; 0 without any."""
        return max((abs(end) for ends in self.forces for end in ends), default=0.0)

    def flat(self) -> dict[str, Any]:
        """Return the columns of a table, angles in degrees, "" where a leg has no such joint."""
        row: dict[str, Any] = {"leg": self.name} | {name: getattr(self, name) for name in OF_EVERY_LEG}
        row["idle"] = int(self.idle)
        if self.permitted is not None:
            row |= dict(zip(("permitted_shortest", "permitted_longest"), self.permitted, strict=True))
        for name in CONES:
            angle = getattr(self, name)
            row[f"{name}_deg"] = "" if angle is None else float(np.degrees(angle))
        for name in RANGES:
            if (ends := getattr(self, name)) is not None:
                row |= {f"{name}_min": ends[0], f"{name}_max": ends[1]}
        if self.power is not None:
            row["power"] = self.power
        if self.forces:
            row["force_largest"] = self.largest_force
        for k, (low, high) in enumerate(self.forces):
            row |= {f"force_{k + 1}_min": low, f"force_{k + 1}_max": high}
        return row

    def to_dict(self) -> dict[str, Any]:
        """Return the row as plain values, angles in degrees and null where a leg has no such joint."""
        row = {k: None if v == "" else v for k, v in self.flat().items() if not k.startswith("force_")}
        return row | {"idle": self.idle, "forces": [{"min": low, "max": high} for low, high in self.forces]}


def leg_rows(
    g: Geometry, c: Configuration, numbers: Mapping[str, Floats], permitted: tuple[Floats, Floats] | None
) -> tuple[LegRow, ...]:
    """Return the nine rows over a stack of poses, the neutral one first, from the numbers of a sheet there.

    `permitted` has the lengths that the limits of a study leave the legs, 0 and infinity for all where nothing does.
    """
    lengths = leg_lengths(g, c)
    low, high = lengths.min(axis=0), lengths.max(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):  # a leg of length 0
        ratio = high / low
    forces = numbers.get("force", np.empty((len(c), 0))).reshape(len(c), -1, 9)
    columns: dict[str, Any] = {
        "name": LEGS,
        "shortest": low.tolist(),
        "longest": high.tolist(),
        "neutral": lengths[0].tolist(),
        "stroke": (high - low).tolist(),
        "stroke_ratio": ratio.tolist(),
        "idle": idle_legs(lengths).tolist(),
        "forces": [tuple(map(_ends, loads)) for loads in forces.T],
    }
    columns |= {name: numbers[name].max(axis=0).tolist() for name in LARGEST if name in numbers}
    columns |= {name: map(_ends, numbers[name].T) for name in RANGES if name in numbers}
    cones: dict[str, dict[str, Any]] = {name: dict.fromkeys(LEGS) for name in CONES}
    for name, (body, legs) in JOINTS.items():
        cones[f"{body}_cone"] |= zip(legs, numbers[name].max(axis=0).tolist(), strict=True)
    columns |= {name: angles.values() for name, angles in cones.items()}
    if permitted is not None and (permitted[0].any() or np.isfinite(permitted[1]).any()):
        columns["permitted"] = list(zip(*(ends.tolist() for ends in permitted), strict=True))
    return tuple(LegRow(**row) for row in rows_of(columns))


def _ends(values: Floats) -> tuple[float, float]:
    return float(values.min()), float(values.max())
