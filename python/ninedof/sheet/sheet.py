"""`sheet`: what a workshop and an engineer need of one design, over its poses."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, Unpack

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.design.domains.region_poses import o_is_placed, posed
from ninedof.design.limit_numbers import CLEARANCE, PARTS, compared, cone_limits
from ninedof.design.study import Study
from ninedof.design.tool import Tool
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry, triples
from ninedof.sheet.pose_words import turn_deg
from ninedof.sheet.region_look import SAMPLES, Looked, RegionSearch, look_over, robot_of
from ninedof.sheet.request import (
    Motion,
    SheetArguments,
    Weight,
    duty_of,
    load_rows,
    masses_besides_platform,
    motion_of,
    question_of,
    weight_of,
    with_duty,
)
from ninedof.sheet.rows import LegRow, LimitRow, NearSingularity, leg_rows, limit_rows, near_singularities
from ninedof.sheet.tables import lengths_table, limits_table, summary_parts, worst_table
from ninedof.singularity.singularity import singularity_margins
from ninedof.statics.accuracy import MOST_SAMPLES
from ninedof.statics.dynamics import masses_for_core
from ninedof.support.arguments import whole
from ninedof.support.arrays import Floats, all_finite, one_or_each
from ninedof.support.structs import options_of, plain_fields, rows_of
from ninedof.support.units import degrees_of, per, times, unit_argument, unit_of_forces, with_unit
from ninedof.tables.html import notebook
from ninedof.tables.table import plain_text


class Extreme(NamedTuple):
    """A worst value and the pose that has it: 0 is the neutral pose, then the others in their order."""

    value: float
    pose: int


class Clearance(NamedTuple):
    """The least distance between the axes of two legs that share no joint."""

    value: float
    pose: int
    legs: tuple[str, str]


class Determinant(NamedTuple):
    """One of the three determinants whose zeros are the singularities, over the poses."""

    value: float
    """Least modulus, 0 to 1."""
    pose: int
    changes_sign: bool
    """Whether its sign at some pose differs from that at the neutral one: a singularity lies between them."""


class Accuracy(NamedTuple):
    """Largest first-order errors over the poses for the given tolerances."""

    position: Extreme
    """Displacement of p."""
    rotation: Extreme
    """Angle of the platform, rad."""
    internal_point: Extreme
    """Displacement of O."""


class Stiffness(NamedTuple):
    """Least stiffness over directions and poses, O free to settle; 0 at a singular pose."""

    translation: Extreme
    """Force at p per displacement of p along it, the platform free to turn."""
    rotation: Extreme
    """Moment per radian about its axis, the platform free to shift."""


@dataclass(frozen=True, eq=False, repr=False)
class Sheet:
    """The engineering sheet of a design.

    Lengths in the unit of the design, angles in radians; in `to_dict` and CSV degrees.
    """

    geometry: Geometry
    configurations: Configuration
    """The neutral pose, then the study's, of a region those that ruled and those found to be worst: a stack. Poses
    below are indices into it."""
    characteristic_length: float
    motion: Motion
    """The platform speed behind the leg speeds, and how O moves in it."""
    loads: Floats
    """The loads behind the leg forces, rows (moment about p, force), base axes, shape (k, 6); a row of zeros where the
    weight is the only one."""
    weight: Weight | None
    """The weight that is added to each load at each pose."""
    legs: tuple[LegRow, ...]
    """The nine legs in the order of `leg_lengths`."""
    condition_number: Extreme
    """The worst."""
    mean_condition_number: float
    """Over the poses; of a region over the region, see `region`."""
    clearance: Clearance
    """Joints that coincide in this design count as one, unlike in the limit of a study that lets them part."""
    determinants: dict[str, Determinant]
    """By name: "det_b", "det_c", "det_n"."""
    nearest_singularity: str
    """The name of the determinant of least modulus."""
    singularities: dict[str, NearSingularity]
    """By way of moving: "shift", "turn", "internal"."""
    accuracy: Accuracy | None
    stiffness: Stiffness | None
    leg_stiffness: tuple[float, ...]
    """Of each leg, force/length, behind `stiffness`; empty without it."""
    limits: tuple[LimitRow, ...]
    """Each limit of the study beside the value at the study's own poses, of a region at its worst poses too; empty
    where the input has no study."""
    region: RegionSearch | None
    """The search of the region of the study; None without one."""
    unit: str = ""
    """Name of the length unit; "" without one."""
    cone_axes: dict[str, tuple[float, ...]] = field(default_factory=dict)
    """The axis from which the angles of each kind of joint are, "base_cone_external" and so on, in the frame of its
    body; () for the direction of each leg at the neutral pose."""
    leg_ranges: tuple[tuple[float, float], ...] | None = None
    """If O is placed anew at every pose of a region: the length that each leg keeps in all of it, empty if no limit
    compares poses. None for others."""
    has_leg_masses: bool = False
    """Whether the weights of legs and O of the study are added to each load too."""
    stated: tuple[str, ...] = ()
    """Tables of the study that gave options which were left out: "speeds", "loads", "masses", "tolerances"."""
    tool: Tool = field(default_factory=Tool)
    """Of the study: p and the frame of the platform in `geometry` are the tool's."""

    @property
    def force_unit(self) -> str:
        """The unit of forces: "N" where masses are stated and lengths have a unit, else ""."""
        return unit_of_forces(self.unit, self.weight is not None or self.has_leg_masses)

    @property
    def idle(self) -> tuple[str, ...]:
        """Names of the legs that have the same length at every pose; empty for a single pose."""
        return tuple(leg.name for leg in self.legs if leg.idle)

    def forces(self) -> Floats:
        """Return least and greatest force of each leg for each load, shape (loads, 2, 9)."""
        ends = np.array([leg.forces for leg in self.legs]).reshape(9, len(self.loads), 2)
        return np.ascontiguousarray(ends.transpose(1, 2, 0))

    def joints(self) -> list[tuple[str, Floats, Floats]]:
        """Return name, coordinates in the frame of its plate and those in the base frame at the neutral pose."""
        p, q = self.configurations.position[0], self.configurations.rotation[0]
        rows = []
        for triple, points in triples(self.geometry).items():
            for i, point in enumerate(points):
                moves = triple.startswith("platform")
                own = self.tool.own(point) if moves and self.tool else point
                rows.append((f"{triple}_{i + 1}", own, p + q @ point if moves else point))
        return rows

    def summary(self) -> str:
        """Return the sheet as lines of text, without joints and forces; angles in degrees."""
        parts = (*summary_parts(self), worst_table(self), *([limits_table(self)] if self.limits else []))
        return "\n".join(map(plain_text, parts))

    def __repr__(self) -> str:
        """Show the count of poses and the worst condition number."""
        where = f"{len(self.configurations)} poses"
        if self.region is not None:
            where = f"a region, {self.region.looked_at} poses looked at"
        return f"<Sheet over {where}: worst condition number {self.condition_number.value:.6g}>"

    def _repr_html_(self) -> str:
        return notebook(repr(self)[1:-1], lengths_table(self), worst_table(self))

    def to_dict(self) -> dict[str, Any]:
        """Return everything as plain values; names of angles end in _deg, those of poses are indices into "poses".

        "unit" names the length unit where there is one, "units" what goes with it, as {"speed": "mm/s"}.
        """
        c, motion = self.configurations, self.motion
        poses = {
            "position": c.position,
            "rotation": c.rotation,
            "rotation_deg": turn_deg(c, c.rotation[0]),
            "internal_point": c.internal_point,
        }
        out: dict[str, Any] = {
            "joints": {name: {"own_frame": own, "neutral_pose": at_neutral} for name, own, at_neutral in self.joints()},
            "poses": rows_of(poses),
            **plain_fields(self, "geometry", "configurations"),
        }
        out["motion"] = {
            "linear_speed": motion.linear_speed,
            "angular_speed_deg": degrees_of(motion.angular_speed),
            "internal": motion.internal,
            "twist": motion.twist,
            "twist_rate": None if motion.twist is None else motion.twist_rate,
        }
        _in_degrees(out["singularities"]["turn"], "distance")
        if self.accuracy is not None:
            turn = out["accuracy"].pop("rotation")
            out["accuracy"]["rotation_deg"] = turn | {"value": float(np.degrees(turn["value"]))}
        for row in out["limits"]:
            if row["unit"] == "angle":
                _in_degrees(row, "limit", "value")
        return {**out, "idle": list(self.idle), "units": self._units()}

    def _units(self) -> dict[str, str]:
        """Return the units by quantity; without forces and powers where masses and lengths name no unit of force."""
        unit, force, speed = self.unit, self.force_unit, per(self.unit, "s")
        units = {"length": unit, "speed": speed, "acceleration": per(unit, "s²"), "force": force}
        units |= {"power": times(force, speed), "moment": times(force, unit), "stiffness": per(force, unit)}
        return {quantity: name for quantity, name in units.items() if name}

    def to_csv(self) -> str:
        """Return the table of the legs as CSV text: one row for each leg, empty where a leg has no such joint.

        Names of columns are followed by their unit in brackets, where there is one: "shortest (mm)", "power (N mm/s)".
        Speeds, accelerations and powers are those at `platform_speed` and `platform_turn_deg`, the same in every row.
        """
        motion = self.motion
        at = {"platform_speed": motion.linear_speed, "platform_turn_deg": degrees_of(motion.angular_speed)}
        rows = [leg.flat() | at for leg in self.legs]
        import csv  # when it is needed, as it takes time to load

        text = io.StringIO()
        writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
        units = self._units()
        lengths = ("shortest", "longest", "neutral", "stroke", "permitted_shortest", "permitted_longest")
        of = {name: "length" if name in lengths else next((q for q in units if q in name), "") for name in rows[0]}
        writer.writerow({name: with_unit(name, units.get(quantity, "")) for name, quantity in of.items()})
        writer.writerows(rows)
        return text.getvalue()


def sheet(design: Any, poses: Configuration | None = None, **options: Unpack[SheetArguments]) -> Sheet:
    """Return the engineering sheet of a design over its poses.

    Extremes are those over the listed poses, the neutral one included; between the poses nothing is looked at. Of the
    result of a region study they are those over the region: a dense sample is looked at, with descents from the worst
    of it for every number of the sheet. Where O is placed anew at every pose, the sample has 4000 poses, O is at each
    where the worst of the index and the limits is least, and descents follow the lengths of the legs alone. There O may
    jump from one place to another, and an internal leg with it: its extremes are those that were found.

    Parameters
    ----------
    design : Result, Candidate, DesignPoint, a design of a file, or Geometry
        The first three with the poses of their study, the neutral pose first: its limits are shown, and its region is
        looked over, but for a DesignPoint where O is placed anew at every pose and limits compare lengths. A design of
        a file has no study, and the neutral pose alone.
    poses : Configuration, shape (n,), optional
        In place of the study's; the neutral pose of the design stays the first. For a Geometry they are needed, and
        the first of them is the neutral one. No region is looked over then.
    linear_speed, angular_speed : float, optional
        Speed of the platform origin (length/time) and angular speed (rad/time); those of the study, which are those of
        its tool, or 1 and 0. The speed
        of a leg is the largest over all directions of both: linear_speed |a| + angular_speed |b| where the rate of
        the leg is a.pdot + b.omega. From rest the same holds for accelerations. The acceleration of a leg is the
        largest over all directions while both velocities are constant; where neither speed is 0, a bound of it: the sum
        of the 2-norms of the blocks of a quadratic form.
    internal : {"least", "held", "shifted", "carried"}, optional
        How O moves in it: so that the squared leg rates are least (`internal_velocity`), and so are the squared leg
        accelerations; not at all; with p, s - p constant in base axes; or as a point of the
        platform. By default as the limits of the study of a result have it; of other designs, and of `poses`, as the
        poses show: "held" where O has one place in all of several poses, "carried" where it has one place in the
        platform, "shifted" where s - p is constant, "least" otherwise.
    loads : array_like, shape (6,) or (k, 6), optional
        (moment about p, force) on the platform, base axes; the forces of the legs are those of `leg_forces`. Those of
        the study by default.
    leg_errors, joint_errors : float or array_like, optional
        Tolerances of `error_bounds`, those of the study by default; without both the sheet has no accuracy.
    leg_stiffness : float or array_like of shape (9,), optional
        That of `stiffness`, force/length; without it the sheet has no stiffness.
    characteristic_length : float or str, optional
        For the condition numbers; a kind is taken at the neutral pose, and where it has no value there, at a singular
        one, they are infinite. That of the design by default, 1 for a Geometry.
    twist, twist_rate : array_like, shape (6,), optional
        A given motion (omega, pdot), base axes, rad/time and length/time, and its time derivative, 0 by default: the
        sheet then has the least and largest rate and acceleration of each leg, with all terms of the velocities.
    mass, centre, gravity : float, array_like of shape (3,), array_like of shape (3,), optional
        Mass of the platform and its centre in the frame of the plate, its origin by default. Gravity is force per mass,
        base axes: (0, 0, -9.81) by default gives newtons for kilograms, in any unit of length. Those of the study where
        it has them. The weight is added to every load, and is a load alone where none is given.
    samples : int
        Half of the poses of the sample of a region, and even poses for the mean; 10000 by default.
    unit : str, optional
        Name of the length unit; that of the study or the design file by default. With one, times are in seconds: the
        speed of a leg is labelled mm/s. The unit of forces is the caller's and has no name.

    Raises
    ------
    ValueError
        If there is no design (a result without a candidate), or an argument does not fit.

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> one = nd.sheet(g, nd.Configuration.neutral(zp=[3.9, 3.7, 4.1], zs=2.4))
    >>> leg = one.legs[0]
    >>> leg.name, round(leg.shortest, 4), round(leg.longest, 4), round(leg.stroke_ratio, 4)
    ('l1', 4.7049, 5.0255, 1.0682)
    >>> one.idle  # O stays where it is
    ('r1', 'r2', 'r3')

    """
    duty = duty_of(design)
    values, stated = with_duty(options_of(sheet, SheetArguments, options, samples=SAMPLES), duty)
    g, c, length = robot_of(design, poses, values["characteristic_length"])
    weight = weight_of(duty, values["mass"], values["centre"], values["gravity"])
    study: Study | None = getattr(design, "study", None)
    rule = "" if study is None or poses is not None else study.leg_duty.internal  # as the limits of the study have it
    motion, bodies = motion_of(values, c, rule), masses_besides_platform(duty)
    weighs = weight is not None or bodies is not None
    loads = load_rows(np.zeros(6) if values["loads"] is None and weighs else values["loads"])
    count = whole("samples", values["samples"], 1, MOST_SAMPLES)
    question = question_of(g, c[0], duty, motion)
    question.loads = list(loads)
    if weight is not None:
        question.weight = _core.Weight(**weight._asdict())
    if bodies is not None:
        question.masses = masses_for_core(bodies)
        question.gravity = duty.loads.gravity if weight is None else weight.gravity
    question.errors = _tolerances(values["leg_errors"], values["joint_errors"])
    of_legs = values["leg_stiffness"]
    locked = None if of_legs is None else _of_each("leg_stiffness", of_legs, 9)
    if locked is not None:
        question.leg_stiffness = locked
    question.characteristic_length = length if np.isfinite(length) else None
    looked = look_over(design, c, question, count) if poses is None else Looked(c)
    c, region = looked.configurations, looked.search
    numbers = _core.sheet_numbers(question, c)
    kappa = numbers["condition_number"][:, 0] if "condition_number" in numbers else np.full(len(c), np.inf)
    determinants = _determinants(g, c)
    return Sheet(
        geometry=g,
        configurations=c,
        characteristic_length=length,
        motion=motion,
        loads=loads,
        weight=weight,
        legs=leg_rows(g, c, numbers, getattr(design, "permitted_lengths", None)),
        condition_number=extreme(kappa, np.argmax),
        mean_condition_number=float(kappa.mean()) if region is None else region.mean,
        clearance=_clearance(numbers[CLEARANCE]),
        determinants=determinants,
        nearest_singularity=min(determinants, key=lambda name: determinants[name].value),
        singularities=near_singularities(g, c, motion.internal),
        accuracy=Accuracy(*(extreme(x, np.argmax) for x in numbers["error"].T)) if "error" in numbers else None,
        stiffness=Stiffness(*(extreme(x, np.argmin) for x in numbers["stiffness"].T))
        if "stiffness" in numbers
        else None,
        leg_stiffness=() if locked is None else tuple(locked.tolist()),
        limits=() if study is None else limit_rows(posed(_judged(duty, design), looked.worst), design.variables),
        region=region,
        unit=duty.unit if values["unit"] is None else unit_argument(values["unit"]),
        cone_axes={name: () if one is None else one.axis for name, one in cone_limits(duty).items()},
        leg_ranges=looked.leg_ranges,
        has_leg_masses=bodies is not None,
        stated=stated,
        tool=duty.tool,
    )


def _tolerances(legs: ArrayLike | None, joints: ArrayLike | None) -> _core.Tolerances | None:
    if legs is None and joints is None:
        return None
    return _core.Tolerances(
        legs=_of_each("leg_errors", 0.0 if legs is None else legs, 9),
        joints=_of_each("joint_errors", 0.0 if joints is None else joints, 12),
    )


def _judged(study: Study, design: Any) -> Study:
    """Return the study without the limits that a design point does not know: of lengths compared, O being placed."""
    if not o_is_placed(study) or getattr(design, "region", None) is not None:
        return study
    unknown = compared(study)
    return replace(study, constraints={name: one for name, one in study.constraints.items() if name not in unknown})


def _of_each(name: str, value: ArrayLike, count: int) -> Floats:
    return all_finite(name, one_or_each(name, value, count))


def extreme(values: Floats, place: Callable[[Floats], Any]) -> Extreme:
    """Return the value at the pose that np.argmin or np.argmax selects, with that pose."""
    at = int(place(values))
    return Extreme(float(values[at]), at)


def _clearance(distances: Floats) -> Clearance:
    """Return the least of distances at poses, shape (n, pairs), infinite for pairs that may meet."""
    pose, pair = divmod(int(np.argmin(distances)), distances.shape[1])
    one, other = sorted(PARTS[CLEARANCE][pair].split("-"))  # "l3-l1" as l1 and l3
    return Clearance(float(distances[pose, pair]), pose, (one, other))


def _determinants(g: Geometry, c: Configuration) -> dict[str, Determinant]:
    margins = singularity_margins(g, c)
    determinants = {}
    for name in ("det_b", "det_c", "det_n"):
        values = np.asarray(getattr(margins, name))
        changes = bool(np.any(values * np.sign(values[0]) <= 0.0))
        determinants[name] = Determinant(*extreme(np.abs(values), np.argmin), changes)
    return determinants


def _in_degrees(row: dict[str, Any], *names: str) -> None:
    """Replace angles by those in degrees, behind the other entries."""
    row |= {f"{name}_deg": float(np.degrees(row.pop(name))) for name in names}
