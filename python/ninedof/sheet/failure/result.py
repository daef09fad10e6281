"""The result of `failure`: a machine with one leg that fails."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from ninedof.design.duty import Masses
from ninedof.robot.configuration import Configuration, poses_of
from ninedof.robot.geometry import Geometry
from ninedof.sheet.failure.tables import failure_parts, free_table, locked_table
from ninedof.sheet.region_look import RegionSearch
from ninedof.sheet.sheet import Extreme
from ninedof.support.arrays import Floats
from ninedof.support.structs import plain_fields
from ninedof.support.units import unit_of_forces
from ninedof.tables.html import notebook
from ninedof.tables.table import plain_text


class LockedLegs(NamedTuple):
    """One leg, or two, locked at the lengths that they have at a pose."""

    legs: tuple[str, ...]
    freedoms: int
    """Of the six of the platform, how many are left: an external leg takes one, an internal leg none."""
    controlled: bool
    """Whether all six are left at every pose."""
    condition_number: float
    """The worst with these legs locked; infinite where control is lost."""
    remaining: float
    """The worst over the freedoms that are left: the same where all six are.

    Infinite above 1e6: a search comes that near to a pose where a motion is lost, never onto it."""
    pose: int
    """The worst place."""
    ratio: float
    """Of `remaining` to the worst of the machine with nine legs."""
    share: float | None
    """Of the even poses of the region at which the condition number is at most the bound; None without a region."""
    share_from_home: float | None
    """The same if the legs stay at the lengths of the neutral pose, O moved to the nearest point that allows them; for
    one internal leg, None for others."""


class LegLoad(NamedTuple):
    """One load, and one leg that carries nothing."""

    carries: float
    """Force in the leg while it works: the largest modulus over the poses."""
    borne: bool
    """Whether that is nothing at every pose: then the other eight bear the load as before."""
    largest: float
    """The largest force in the other legs, modulus, over the poses where the load is borne; NaN where it nowhere is."""


class FreeLeg(NamedTuple):
    """One leg that carries nothing, the eight others locked: one motion is left to itself."""

    leg: str
    twist: tuple[float, ...]
    """That motion at the neutral pose for a unit rate of the leg: (omega, pdot), base axes, rad and lengths for each
    unit of its length. NaN at a singular pose."""
    internal_point: tuple[float, float, float]
    """The motion of O beside it."""
    size: float
    """Of the twist (l_c omega, pdot): its column of J'."""
    share: float
    """Of the largest of the nine columns, at the neutral pose; a column of 0 would leave the platform at rest."""
    least: Extreme
    """Least size over the poses."""
    largest: Extreme
    """Largest size over the poses."""
    loads: tuple[LegLoad, ...]
    """For each load."""


@dataclass(frozen=True, eq=False, repr=False)
class Failure:
    """The machine with one leg that fails: condition numbers, limits and poses that are left."""

    geometry: Geometry
    configurations: Configuration
    """The neutral pose, then the study's, of a region those that are worst: a stack. Poses are indices into it."""
    characteristic_length: float
    healthy: Extreme
    """The worst condition number of the machine with nine legs at work."""
    bound: float
    """The condition number that shares of a region are about."""
    locked: tuple[LockedLegs, ...]
    """Each leg."""
    pairs: tuple[LockedLegs, ...]
    """Each pair of legs; empty where they were not asked for."""
    free: tuple[FreeLeg, ...]
    """Each leg."""
    relative_manipulability: Floats
    """At each pose, of each leg, shape (n, 9): the part of the manipulability that is left with it locked, 0 to 1.

    The squares of a row add to 3."""
    loads: Floats
    """Rows (moment about p, force), base axes, shape (k, 6)."""
    masses: Masses | None
    """Of the study, whose weights act beside each load; None without any."""
    region: RegionSearch | None
    """The search of the region of the study; None without one."""
    leg_ranges: tuple[tuple[float, float], ...] | None = None
    """Not None if O is placed anew at every pose of a region: the length that each leg keeps there."""
    unit: str = ""
    """Name of the length unit; "" without one."""

    @property
    def force_unit(self) -> str:
        """The unit of forces: "N" where masses are stated and lengths have a unit, else ""."""
        return unit_of_forces(self.unit, self.masses is not None)

    @property
    def worst(self) -> LockedLegs:
        """The one internal leg whose locking is worst."""
        return max(self.locked[3:], key=lambda one: one.condition_number)

    def summary(self) -> str:
        """Return tables and sentences as lines of text."""
        return "\n".join(map(plain_text, failure_parts(self)))

    def __repr__(self) -> str:
        """Show the worst condition numbers."""
        worst = self.worst
        return (
            f"<Failure: condition number {self.healthy.value:.6g} with nine legs, "
            f"{worst.condition_number:.6g} with {worst.legs[0]} locked>"
        )

    def _repr_html_(self) -> str:
        return notebook(repr(self)[1:-1], locked_table(self, self.locked), free_table(self))

    def to_dict(self) -> dict[str, Any]:
        """Return everything as plain values; poses are indices into "poses"."""
        own = plain_fields(self, "geometry", "configurations", "leg_ranges")
        return {"poses": poses_of(self.configurations), **own}
