"""What following a trajectory needs of the legs, and what it meets."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ninedof import _core
from ninedof.motion.trajectory import Trajectory
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import TRIPLES, Geometry, triples
from ninedof.robot.idle import idle_names
from ninedof.robot.leg_names import LEGS
from ninedof.singularity.singularity import SingularityMargins
from ninedof.support.arrays import Floats
from ninedof.support.files import Arrays, Saved, from_json_array, json_array
from ninedof.support.margins import TOLERANCE
from ninedof.support.short import short_repr
from ninedof.support.units import unit_entry

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

    FORMAT = "ninedof-motion-1"

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
    """For the given load, positive if the leg pushes, shape (n, 9); None without a load."""
    tracked: bool
    """Whether `track` returns every pose from its leg lengths, to 1e-9 and each step with its proof."""
    tracked_until: float
    """The time of the last pose before one that it does not reach or returns differently, as beyond a singularity."""
    tracking_error: float
    """Largest difference of a pose that `track` reached: of Q, and of p and O over the largest leg length."""
    unit: str = ""
    """Name of the length unit; "" without one."""

    @property
    def time(self) -> Floats:
        """Shape (n,)."""
        return self.trajectory.time  # type: ignore[no-any-return]

    @property
    def leg_margins(self) -> Floats:
        """What each leg leaves of its nearer limit, in parts of it, shape (n, 9); infinite without limits."""
        return _core.leg_margins(self.leg_lengths, *self.limits)

    @cached_property
    def breaks(self) -> tuple[LimitBreak, ...]:
        """Stretches of time in which a leg passes its limit (by more than 1e-6 of it), and singularities passed."""
        determinants = np.stack(self.singularity_margins)
        entries = _core.limit_breaks(self.time, self.leg_lengths, *self.limits, determinants)
        return tuple(LimitBreak(*entry) for entry in entries)

    @property
    def idle_legs(self) -> tuple[str, ...]:
        """Legs whose length never changes."""
        return idle_names(self.leg_lengths)

    def to_dict(self) -> dict[str, Any]:
        """Return a summary as plain values: extremes of each leg, the worst poses, limits that break, the check."""
        worst = int(np.argmax(self.condition_number))
        margins = np.abs(np.stack(self.singularity_margins))
        near = np.unravel_index(int(np.argmin(margins)), margins.shape)
        columns = {
            "shortest": self.leg_lengths.min(axis=0),
            "longest": self.leg_lengths.max(axis=0),
            "speed": np.abs(self.leg_rates).max(axis=0),
            "acceleration": np.abs(self.leg_accelerations).max(axis=0),
            "low": self.limits[0],
            "high": self.limits[1],
            "margin": self.leg_margins.min(axis=0),
        }
        if self.leg_forces is not None:
            columns["push"] = self.leg_forces.max(axis=0, initial=0.0)
            columns["pull"] = (-self.leg_forces).max(axis=0, initial=0.0)
        legs = {leg: {name: float(values[k]) for name, values in columns.items()} for k, leg in enumerate(LEGS)}
        return {
            **unit_entry(self.unit),
            "poses": len(self.time),
            "begin": float(self.time[0]),
            "end": float(self.time[-1]),
            "closed": self.trajectory.closed,
            "internal_point": self.internal_point,
            "legs": legs,
            "idle_legs": list(self.idle_legs),
            "characteristic_length": self.characteristic_length,
            "condition_number": {
                "first": float(self.condition_number[0]),
                "last": float(self.condition_number[-1]),
                "worst": float(self.condition_number[worst]),
                "at": float(self.time[worst]),
            },
            "nearest_singularity": {
                "determinant": list(DETERMINANTS.values())[near[0]],
                "value": float(margins[near]),
                "at": float(self.time[near[1]]),
            },
            "breaks": [broken._asdict() for broken in self.breaks],
            "tracked": self.tracked,
            "tracked_until": self.tracked_until,
            "tracking_error": self.tracking_error,
        }

    def __repr__(self) -> str:
        """Show the number of poses and what is not kept."""
        broken = sorted({entry.limit for entry in self.breaks})
        return f"<Followed: {len(self.time)} poses, {'breaks ' + ', '.join(broken) if broken else 'within limits'}>"

    def _contents(self) -> dict[str, Any]:
        moving = self.trajectory
        arrays = {**triples(self.geometry), "time": moving.time, "position": moving.position}
        arrays |= {"rotation": moving.rotation, "o": self.configurations.internal_point}
        arrays |= {"limits": np.stack(self.limits), "singularity_margins": np.stack(self.singularity_margins)}
        others = [f.name for f in fields(self) if f.name not in (*arrays, "geometry", "trajectory", "configurations")]
        values = {name: getattr(self, name) for name in others}
        words = {name: value for name, value in values.items() if not isinstance(value, np.ndarray)}
        arrays |= {name: value for name, value in values.items() if name not in words}
        return {"words": json_array({"format": self.FORMAT, **words}), **arrays}

    @classmethod
    def _made(cls, contents: Arrays) -> Followed:
        data: dict[str, Any] = dict(contents)
        words = from_json_array(data.pop("words"))
        if words.pop("format") != cls.FORMAT:
            raise ValueError
        geometry = Geometry(**{name: data.pop(name) for name in TRIPLES})
        moving = Trajectory(data.pop("time"), data.pop("position"), data.pop("rotation"), words["unit"])
        poses = Configuration(moving.position, moving.rotation, data.pop("o"))
        low, high = data.pop("limits")
        margins = SingularityMargins(*data.pop("singularity_margins"))
        known = {"limits": (low, high), "singularity_margins": margins, **words, **data}
        return cls(geometry=geometry, trajectory=moving, configurations=poses, **known)


def stretches(
    name: str, time: Floats, values: Floats, margin: Floats, tolerance: float = TOLERANCE
) -> list[LimitBreak]:
    """Return the stretches of a margin that is negative beyond the tolerance."""
    return [LimitBreak(*entry) for entry in _core.stretches(name, time, values, margin, tolerance)]
