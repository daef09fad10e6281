"""Inverse kinematics along a trajectory: rates, accelerations and limits of the legs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike

from ninedof import _core
from ninedof.conditioning.characteristic_length import length_at
from ninedof.motion.tables import FORCES, POWERS, WORKS, motion_tables
from ninedof.motion.trajectory import Trajectory
from ninedof.redundancy.redundancy import leg_limits
from ninedof.redundancy.rules import RULES
from ninedof.robot.configuration import Configuration, single
from ninedof.robot.designs import HasRobot, robot_of
from ninedof.robot.geometry import LEGS, Geometry, triples
from ninedof.robot.idle import idle_names, unloaded_names
from ninedof.singularity.singularity import SingularityMargins
from ninedof.statics.dynamics import GRAVITY, gravity_for_core, inverse_dynamics
from ninedof.support.arguments import choice, finite, instance, items, vector
from ninedof.support.arrays import Floats, all_finite, as_floats, broadcast_leading
from ninedof.support.kept.files import Saved
from ninedof.support.structs import entries_of, from_core, options_of, plain_fields
from ninedof.support.text import short_repr
from ninedof.support.units import metres, unit_entry, unit_of_forces
from ninedof.tables.html import notebook

PATH = ("time", "position", "rotation")
ROBOT = ("geometry", "trajectory", "configurations")
DETERMINANTS = {"det_n": "det N", "det_b": "det B", "det_c": "det C"}


@short_repr
class LimitBreak(NamedTuple):
    """A stretch of time in which a limit is not kept."""

    limit: str
    """"l1 low" or "q2 high": the leg is shorter or longer than its limit. "det B": a singularity is passed. Of a study
    "base_cone l1 max"."""
    begin: float
    """Time, interpolated linearly between poses."""
    end: float
    worst: float
    """The leg length or the value that is limited, 0 for a determinant that changes its sign."""
    at: float
    """The time of the worst."""


@dataclass(frozen=True, eq=False, repr=False)
class Followed(Saved):
    """A motion along a trajectory, legs in the order of `leg_lengths`."""

    KIND = "motion"

    geometry: Geometry
    trajectory: Trajectory
    configurations: Configuration
    """The poses with O, shape (n,)."""
    internal_point: str | float
    """The rule for O."""
    leg_lengths: Floats
    """Shape (n, 9)."""
    leg_rates: Floats
    """Length/time, shape (n, 9)."""
    leg_accelerations: Floats
    """Length/time^2, shape (n, 9)."""
    velocity: Floats
    """Angular velocity of the platform and velocities of p and O, base frame, shape (n, 9)."""
    acceleration: Floats
    """Their time derivatives, shape (n, 9)."""
    characteristic_length: float
    condition_number: Floats
    """Shape (n,); infinite where singular."""
    singularity_margins: SingularityMargins
    """As `singularity_margins`, each of shape (n,)."""
    limits: tuple[Floats, Floats]
    """Least and greatest length of each leg, shapes (9,)."""
    leg_forces: Floats | None
    """For load and masses, positive if the leg pushes, shape (n, 9), of k loads (k, n, 9); None without both."""
    tracked: bool
    """Whether `track` returns every pose from its leg lengths, to 1e-9 and each step with its proof."""
    tracked_until: float
    """The time of the last pose before one that it does not reach or returns differently, as beyond a singularity."""
    tracking_error: float
    """Largest difference of a pose that `track` reached: of Q, and of p and O over the largest leg length."""
    unit: str = ""
    """Name of the length unit; "" without one."""
    force_unit: str = ""
    """"N" for masses in kilograms and lengths with a unit; "": that of the load, or what goes with the masses."""
    gravity: tuple[float, float, float] = GRAVITY
    """Of weights, m/s^2 where lengths have a unit, base frame."""
    study_breaks: tuple[LimitBreak, ...] | None = None
    """Stretches in which other limits of the study are violated, see `path_limits`; None where none was held."""

    @property
    def time(self) -> Floats:
        """Shape (n,)."""
        return self.trajectory.time  # type: ignore[no-any-return]

    @property
    def leg_margins(self) -> Floats:
        """Distance of each leg from its nearer limit, in parts of it, shape (n, 9); infinite without limits."""
        return _core.leg_margins(self.leg_lengths, *self.limits)

    @cached_property
    def breaks(self) -> tuple[LimitBreak, ...]:
        """Stretches of time in which limits are violated, of legs by more than 1e-6 of it, and singularities passed.

        Other limits than those of legs are held for a design of a study: `study_breaks`.
        """
        determinants = np.stack(self.singularity_margins)
        entries = _core.limit_breaks(self.time, self.leg_lengths, *self.limits, determinants)
        breaks = [*(from_core(LimitBreak, entry) for entry in entries), *(self.study_breaks or ())]
        return tuple(sorted(breaks, key=lambda one: (one.begin, one.limit)))

    @property
    def idle_legs(self) -> tuple[str, ...]:
        """Legs whose length never changes."""
        return idle_names(self.leg_lengths)

    @property
    def unloaded_legs(self) -> tuple[str, ...]:
        """Legs whose force is 0 all along: backlash decides where in it they are. Empty without a load and masses."""
        return () if self.leg_forces is None else unloaded_names(self.leg_forces.reshape(-1, 9))

    @property
    def leg_powers(self) -> Floats | None:
        """Force times rate, shaped as forces, positive where the actuator does work; in watts for `force_unit` "N"."""
        if self.leg_forces is None:
            return None
        with np.errstate(over="ignore", invalid="ignore"):
            return self._watts * self.leg_forces * self.leg_rates

    @cached_property
    def drives(self) -> dict[str, Floats]:
        """Of each leg over the path: "push", "pull", "rms", "power", "braking", "work", "returned", shapes (9,).

        Greatest forces, root of the mean square of the force over time, greatest power forth and back, and their
        integrals over time, force and power linear between poses: joules where `force_unit` is "N". Of several loads
        each figure is the largest. Empty without forces.
        """
        if self.leg_forces is None:
            return {}
        loads = self.leg_forces.reshape(-1, len(self.time), 9)
        each = [_core.drive_figures(self.time, forces, self.leg_rates) for forces in loads]
        scales = dict.fromkeys(FORCES, 1.0) | dict.fromkeys(POWERS + WORKS, self._watts)
        return {name: scale * np.max([getattr(one, name) for one in each], axis=0) for name, scale in scales.items()}

    @property
    def load_count(self) -> int:
        """The number of loads that the forces are for, each on its own: 1 also for masses alone, 0 without forces."""
        return 0 if self.leg_forces is None else self.leg_forces.size // (9 * len(self.time))

    @property
    def _watts(self) -> float:
        return metres(self.unit) if self.force_unit else 1.0

    def to_dict(self) -> dict[str, Any]:
        """Return a summary as plain values: extremes of each leg, the worst poses, limits that break, the check."""
        kappa, margins = self.condition_number, np.abs(np.stack(self.singularity_margins))
        worst = int(np.argmax(kappa))
        near = np.unravel_index(int(np.argmin(margins)), margins.shape)
        columns = {
            "shortest": self.leg_lengths.min(axis=0),
            "longest": self.leg_lengths.max(axis=0),
            "speed": np.abs(self.leg_rates).max(axis=0),
            "acceleration": np.abs(self.leg_accelerations).max(axis=0),
            "low": self.limits[0],
            "high": self.limits[1],
            "margin": self.leg_margins.min(axis=0),
            **self.drives,
        }
        return {
            **unit_entry(self.unit),
            "poses": len(self.time),
            "begin": float(self.time[0]),
            "end": float(self.time[-1]),
            "closed": self.trajectory.closed,
            "internal_point": self.internal_point,
            "legs": {leg: {name: float(x[k]) for name, x in columns.items()} for k, leg in enumerate(LEGS)},
            "idle_legs": list(self.idle_legs),
            "unloaded_legs": list(self.unloaded_legs),
            **({"force_unit": self.force_unit} if self.force_unit else {}),
            **({"loads": self.load_count} if self.load_count > 1 else {}),
            "characteristic_length": self.characteristic_length,
            "condition_number": {
                "first": float(kappa[0]),
                "last": float(kappa[-1]),
                "worst": float(kappa[worst]),
                "at": float(self.time[worst]),
            },
            "nearest_singularity": {
                "determinant": list(DETERMINANTS.values())[near[0]],
                "value": float(margins[near]),
                "at": float(self.time[near[1]]),
            },
            "breaks": [entry._asdict() for entry in self.breaks],
            "tracked": self.tracked,
            "tracked_until": self.tracked_until,
            "tracking_error": self.tracking_error,
        }

    def __repr__(self) -> str:
        """Show the number of poses and what is not kept."""
        if breaks := sorted({entry.limit for entry in self.breaks}):
            words = f"breaks {', '.join(breaks)}"
        elif self.study_breaks is not None:
            words = "within limits"
        else:
            low, high = self.limits
            bounded = np.isfinite(high).any() or (np.asarray(low) > 0.0).any()
            words = "legs within their lengths, no other limit looked at" if bounded else "no limits given"
        return f"<Followed: {len(self.time)} poses, {words}>"

    def _repr_html_(self) -> str:
        return notebook(repr(self), *motion_tables(self.to_dict()))

    def _saved(self) -> dict[str, Any]:
        path = {name: getattr(self.trajectory, name) for name in PATH}
        robot = {"geometry": triples(self.geometry), "path": path, "o": self.configurations.internal_point}
        return plain_fields(self, *ROBOT) | robot

    @classmethod
    def _restored(cls, entries: dict[str, Any]) -> Followed:
        path = Trajectory(**entries["path"], unit=entries.get("unit", ""))
        c = Configuration(path.position, path.rotation, entries["o"])
        return cls(Geometry(**entries["geometry"]), path, c, **entries_of(cls, entries, skipped=ROBOT))


class FollowDuty(TypedDict, total=False):
    """Loads and masses that the legs bear in `follow`, where the options are described."""

    load: tuple[ArrayLike | None, ArrayLike | None]
    masses: Any
    gravity: ArrayLike | None


def follow(
    geometry: Geometry | HasRobot,
    trajectory: Trajectory,
    home: Configuration | None = None,
    internal_point: str | float | None = None,
    limits: tuple[ArrayLike, ArrayLike] | None = None,
    characteristic_length: float | str | None = None,
    **duty: Unpack[FollowDuty],
) -> Followed:
    """Return lengths, rates and accelerations of the legs along a trajectory, and what limits it.

    Velocity and acceleration of platform and O are those of the polynomial of degree four through the five nearest
    poses; the rates of the legs follow from them in closed form. The poses are not smoothed: errors of rounding in a
    file of few digits show in the accelerations. As a check the lengths are tracked back from the first pose.

    Parameters
    ----------
    geometry : Geometry, Result or Design
        A design stands for its geometry, its home and its characteristic length, one of a study, as a Result, also for
        the leg lengths that the study permits, the rule for O of its region, its loads, masses and gravity; all limits
        of its study are held along the path, as `path_limits` does. Of a DesignPoint the limits on lengths are: the
        others are those of `path_limits(point.study, motion, point.configuration)`.
    trajectory : Trajectory
    home : Configuration
        The neutral configuration, a single one: it says where O is. Needed with a Geometry.
    internal_point : {"carried", "shifted", "held", "best"} or float
        O along the trajectory. "carried", the default: as a point of the platform, so that O keeps its side of the
        upper internal joints on every trajectory; while the platform does not turn, the upper internal legs do not
        move. "shifted": with p, s - p as at home in base axes, as regions of studies have it.
        "held": where it is at home; the lower internal legs never move. `idle_legs` names such legs. A number:
        this fraction of the way from the centroid of the internal joints of the base to that of the platform. "best":
        `best_internal_path` within the limits, at 201 poses, with a cubic spline between them.
    limits : (low, high), optional
        Least and greatest leg lengths, each a number or shape (9,). None by default. They are reported, and respected
        by "best" only.
    characteristic_length : float or str
        Length l_c of the condition number, or a kind of `characteristic_length`, taken at home; 1 by default, of a
        design its own.
    load : (force, moment), optional
        On the platform at its origin, base axes, for the leg forces: each of shape (3,) or (n, 3), or None. Several
        loads, each on its own: (k, 1, 3) or (k, n, 3). None by default, of a study its wrenches.
    masses : Masses, optional
        Weights and inertia of all bodies in the motion are added to the load, as in `inverse_dynamics`: in newtons for
        kilograms where the path or the design has a length unit, time in seconds. In the frame of the geometry, that of
        the tool. None by default, of a study its masses.
    gravity : array_like, shape (3,)
        Force per mass, base axes; (0, 0, -9.81) by default, of a study its own. Of the masses only.

    Raises
    ------
    ValueError
        If an argument does not fit, or no position of O is allowed at a pose with "best".

    Examples
    --------
    >>> import ninedof as nd
    >>> g = nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)
    >>> home = nd.Configuration.neutral(3.9828, 2.4432)
    >>> circle = nd.Trajectory.circle(home, radius=0.5, duration=2.0, points=201)
    >>> motion = nd.follow(g, circle, home, limits=(2.0, 5.2))
    >>> motion
    <Followed: 201 poses, breaks l1 high, l2 high, l3 high>
    >>> motion.leg_rates.shape, motion.tracked, motion.tracking_error < 1e-9
    ((201, 9), True, True)

    """
    instance("trajectory", trajectory, Trajectory)
    bears = options_of(follow, FollowDuty, duty, load=(None, None))
    ends, masses, gravity = items("load", bears["load"], "force and moment", 2), bears["masses"], bears["gravity"]
    rule, lc, design = internal_point, characteristic_length, geometry
    study: Any = None if isinstance(design, Geometry) else getattr(design, "study", None)
    own: str = "" if isinstance(design, Geometry) else getattr(study or design, "unit", "")
    if own and trajectory.unit and own != trajectory.unit:
        raise ValueError(f"trajectory: got lengths in {trajectory.unit}, expected {own} as in the design")
    path, unit = trajectory, trajectory.unit or own
    if isinstance(design, Geometry):
        g = design
    else:
        g, home = robot_of(design), design.configuration if home is None else home
        limits = getattr(design, "permitted_lengths", None) if limits is None else limits
        lc = design.characteristic_length if lc is None else lc
    if study:
        rule = study.objective.region.internal_point if rule is None and study.objective.region else rule
        ends = ends if any(end is not None for end in ends) else wrenches_along(study.loads.wrenches)
        masses = study.masses.seen_from(study.tool) if masses is None and study.masses else masses
        gravity = study.loads.gravity if gravity is None else gravity
    rule, lc = "carried" if rule is None else rule, 1.0 if lc is None else lc
    if home is None:
        raise ValueError("home: got none, expected the neutral configuration of a Geometry")
    single(g, home, "home")
    rule = choice("internal_point", rule, RULES) if isinstance(rule, str) else finite("internal_point", rule)
    lc = length_at(g, home, lc)
    bounds, forces = leg_limits(limits), None
    gravity = GRAVITY if gravity is None else gravity
    gravity_for_core(gravity, unit)  # refuses what is no gravity, even where nothing weighs
    motion = _core.follow(g, home, path.time, path.position, path.rotation, rule, bounds, lc)
    c = Configuration(path.position, path.rotation, motion.internal_point)
    if masses is not None or any(end is not None for end in ends):
        speeds = (motion.velocity, motion.acceleration)
        forces = inverse_dynamics(g, c, speeds, masses, gravity, _loads(*ends), unit).forces
    followed = from_core(
        Followed,
        motion,
        geometry=g,
        trajectory=path,
        configurations=c,
        internal_point=rule,
        characteristic_length=lc,
        singularity_margins=SingularityMargins(*motion.singularity_margins),
        limits=bounds,
        leg_forces=forces,
        tracked=motion.tracked == len(path),
        tracked_until=float(path.time[motion.tracked - 1]),
        unit=unit,
        force_unit=unit_of_forces(unit, masses is not None),
        gravity=vector("gravity", gravity),
        study_breaks=None,
    )
    held = getattr(design, "path_limits", None)  # of a study; a geometry has none
    return replace(followed, study_breaks=held(followed, home).breaks) if study and held else followed


def wrenches_along(wrenches: Sequence[Sequence[float]]) -> tuple[Floats | None, Floats | None]:
    """Return force and moment for `follow` of wrenches, moment first, each a load on its own; None without any."""
    if not wrenches:
        return None, None
    rows = np.array(wrenches)[:, None] if len(wrenches) > 1 else np.array(wrenches[0])
    return rows[..., 3:], rows[..., :3]


def _loads(force: Any, moment: Any) -> Floats:
    """Return moment and force, shape (6,) or (n, 6), of k loads (k, 1, 6) or (k, n, 6)."""
    parts = {"moment": moment, "force": force}
    arrays = {name: (as_floats(name, np.zeros(3) if x is None else x, (3,)), 1) for name, x in parts.items()}
    for name, (array, _) in arrays.items():
        all_finite(f"load ({name})", array)
    shape, rows = broadcast_leading(arrays)
    if len(shape) > 2 or 0 in shape:
        raise ValueError(f"load: got stacks of shape {shape}, expected one load, or one for each pose")
    return np.concatenate(rows, axis=-1)
