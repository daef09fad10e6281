"""The items of limits at a pose, legs and pairs of legs; the limits of a study scaled."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from ninedof import _core
from ninedof.design.limits import ROWS, Limit
from ninedof.design.objective import CONDITION_LIMITS
from ninedof.design.study import Study
from ninedof.robot.geometry import Geometry

PARTS: dict[str, tuple[str, ...]] = _core.limit_parts
"""The limits that have a value at every pose, and their items: legs, pairs of legs "l1-q2", determinants "det N"."""
CONES = tuple(name for name in PARTS if ROWS[name].is_angle)
JOINTS = {name: (ROWS[name].body, PARTS[name]) for name in CONES if len(PARTS[name]) == 3}
"""The limits on the cones of one kind of joint, and the body and the legs there: external and internal joints of each
body, which may be of two makes and mounted in two ways."""
CLEARANCE = next(name for name, parts in PARTS.items() if "-" in parts[0])
"""The limit on the distance of pairs of legs."""
REGULAR = next(name for name in PARTS if ROWS[name].kind == "sign")
"""The limit on determinants."""
FORCES = "number"  # the kind of limits on forces of legs
SPREADS: dict[str, tuple[str, ...]] = _core.limits_over_lengths
"""The limits of the longest and shortest lengths over all poses, and the legs that have one each; () for one that all
legs share."""


def compared(study: Study) -> list[str]:
    """Return the names of the limits of a study that compare its poses."""
    return list(dict.fromkeys(limit.name for limit in study.limits if limit.name in SPREADS and limit.at == "poses"))


def cone_limits(study: Study | None) -> dict[str, Limit | None]:
    """Return the limit on the cone of each of the `JOINTS` in a study, None without one.

    That on these joints, else one on all joints of their body; at the poses rather than at the neutral one.
    """
    out: dict[str, Limit | None] = dict.fromkeys(JOINTS)
    limits = () if study is None else study.limits
    for limit in sorted(limits, key=lambda one: (one.at == "poses", one.name in JOINTS)):
        out |= {name: limit for name in JOINTS if limit.name in CONES and name.startswith(limit.name)}
    return out


def exempt_pairs(g: Geometry, study: Study | None = None) -> list[bool]:
    """Return which pairs of legs need not keep a distance: they share a joint.

    Where a study limits the distance, in every design of it, as joints that coincide in this one alone collide; else in
    this robot.
    """
    limited = study is not None and CLEARANCE in study.constraints
    return study.problem().exempt_pairs() if study is not None and limited else _core.pairs_sharing_a_joint(g)


def apart(g: Geometry, study: Study | None = None) -> list[int]:
    """Return the indices of the pairs of legs that are to keep a distance: those that are not exempt."""
    return [k for k, meet in enumerate(exempt_pairs(g, study)) if not meet]


def crossed(study: Study, factor: Callable[[str, str], float]) -> set[str]:
    """Return the limits whose ends, each times factor(label, side), leave no number between them."""
    return {
        one.label for one in study.limits if one.low * factor(one.label, "min") > one.high * factor(one.label, "max")
    }


def with_scaled_limits(study: Study, factor: Callable[[str, str], float]) -> Study:
    """Return a study with each end of its limits times factor(label, side); an angle is at most pi.

    The limits of the condition number have the names of the objective's fields as labels.
    """
    constraints = dict[str, list[Limit]]()
    for limit in study.limits:
        most = math.pi if limit.row.is_angle else math.inf
        high = min(limit.high * factor(limit.label, "max"), max(most, limit.high))
        scaled = replace(limit, low=limit.low * factor(limit.label, "min"), high=high)
        constraints.setdefault(limit.name, []).append(scaled)
    bounds = {name: getattr(study.objective, name) for name in CONDITION_LIMITS}
    bound_changes = {name: bound * factor(name, "max") for name, bound in bounds.items() if bound is not None}
    return replace(study, constraints=constraints, objective=replace(study.objective, **bound_changes))
