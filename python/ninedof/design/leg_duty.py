"""Loads, masses and speeds of a study, and the motion of O: for limits of forces, rates and powers of legs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from ninedof import _core
from ninedof.design.domains.poses import ZERO
from ninedof.design.duty import Loads, Masses, Speeds, duty
from ninedof.design.limits import Limit
from ninedof.design.objective import Objective
from ninedof.statics.dynamics import masses_for_core
from ninedof.support.arguments import choice
from ninedof.support.structs import StudyTable, entry

INTERNAL = ("least", "held", "shifted", "carried")
"""The motion of O with the platform."""


@dataclass(frozen=True)
class LegDuty(StudyTable):
    """The duty of the legs of a machine, masses in the frame of geometries."""

    loads: Loads = entry(duty(Loads), Loads())
    masses: Masses = entry(duty(Masses), Masses())
    speeds: Speeds = entry(duty(Speeds), Speeds())
    internal: str = entry(partial(choice, known=INTERNAL), "least")

    def for_core(self) -> _core.Duty:
        """Return the duty as the core takes it; a machine without wrenches has its weights alone."""
        speeds = {"linear_speed": self.speeds.linear, "angular_speed": self.speeds.angular}
        return _core.Duty(
            loads=self.loads.wrenches or [(0.0,) * 6],
            masses=masses_for_core(self.masses),
            gravity=self.loads.gravity,
            motion=_core.PlatformMotion(internal=self.internal, **speeds),
        )


def require_stated(limits: Sequence[Limit], states: Mapping[str, bool]) -> None:
    """Raise ValueError if a limit is about loads or speeds that a study does not state."""
    expected = {"loads": "wrenches in [loads], or [masses]", "speeds": "linear or angular in [speeds]"}
    for limit in limits:
        for table in limit.row.needs:
            if not states[table]:
                raise ValueError(f"constraints.{limit.name}: got a study without {table}, expected {expected[table]}")


def internal_motion(objective: Objective) -> str:
    """Return how O moves over the poses of a study, for its limits and for the sheet of its design.

    "held", "shifted", or "carried" where nothing turns; "least", where the rates of the legs are least, for one pose
    alone and where O is placed or follows no rule.
    """
    poses, region = objective.poses, objective.region
    turns = any(pose.rotation != ZERO for pose in poses)
    # Without a shift, shifted and held are the same.
    rules = {pose.internal_point for pose in poses if pose.position != ZERO or pose.internal_point != "shifted"}
    if region is not None:
        turns = turns or max(region.reach[3:]) > 0.0
        if max(region.reach[:3]) > 0.0 or region.internal_point == "best":
            rules.add(region.internal_point)
    if rules == {"shifted"}:
        return "shifted" if turns else "carried"
    return "held" if rules == {"held"} or (not rules and turns) else "least"
