"""A sheet in plain text."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from ninedof.redundancy.rules import WORDS
from ninedof.sheet.limit_rows import limit_amount
from ninedof.support.margins import margin_words
from ninedof.support.units import amount, per, times

HEAD = ("leg", "shortest", "longest", "neutral", "stroke", "ratio", "speed", "accel.", "base cone", "platf. cone")
WIDTH = 12
MOTIONS = {"shift": "shift", "internal": "O alone"}
WAYS = {"shift": "shift of the platform", "turn": "turn about its origin", "internal": "O alone"}
PERMITTED = ("at least", "at most")
MECHANISMS = {
    "det_b": "O in the plane of the lower internal joints",
    "det_c": "O in the plane of the upper internal joints",
    "det_n": "the platform turns about a line through O",
}


def sheet_words(found: Any) -> list[str]:
    """Return the lines of `Sheet.summary`; takes a Sheet."""
    unit = found.unit
    lines = ["".join(f"{name:>{WIDTH}}" if k else f"{name:<4}" for k, name in enumerate(HEAD))]
    if unit:
        units = ("", *[f"({unit})"] * 4, "", f"({unit}/s)", f"({unit}/s²)")
        lines.append("".join(f"{name:>{WIDTH}}" if k else f"{name:<4}" for k, name in enumerate(units)))
    for leg in found.legs:
        numbers = (leg.shortest, leg.longest, leg.neutral, leg.stroke, leg.stroke_ratio, leg.speed, leg.acceleration)
        cones = ("-" if a is None else f"{math.degrees(a):.2f} deg" for a in (leg.base_cone, leg.platform_cone))
        cells = (*(f"{x:.6g}" for x in numbers), *cones)
        lines.append(f"{leg.name:<4}" + "".join(f"{cell:>{WIDTH}}" for cell in cells))
    if found.idle:
        lines.append(
            f"{', '.join(found.idle)} never move over {'these poses' if found.region is None else 'the region'}"
        )
    worst, mean, clear = found.condition_number, found.mean_condition_number, found.clearance
    near = found.determinants[found.nearest_singularity]
    lines += [
        f"condition number {worst.value:.6f} at worst ({_pose(worst.pose)}), {mean:.6f} on average",
        f"least clearance {amount(f'{clear.value:.6g}', unit)}, {' and '.join(clear.legs)} ({_pose(clear.pose)})",
        f"least determinant |{_det(found.nearest_singularity)}| = {near.value:.6f} ({_pose(near.pose)})",
    ]
    far = found.singularities
    turn = f"{math.degrees(far['turn'].distance):.2f} deg ({_det(far['turn'].mechanism)})"
    others = {name: far[key] for key, name in MOTIONS.items()}
    away = (f"{name} {amount(f'{at.distance:.6g}', unit)} ({_det(at.mechanism)})" for name, at in others.items())
    lines.append(f"nearest singularity: {', '.join(away)}, turn {turn}")
    if found.region is not None:
        lines.insert(0, f"over {found.region.region}; {found.region.looked_at} poses looked at")
    crossed = [_det(name) for name, one in found.determinants.items() if one.changes_sign]
    if crossed:
        lines.append(f"a singularity lies between poses: {', '.join(crossed)} changes sign")
    if found.accuracy is not None:
        a = found.accuracy
        turn = f"{math.degrees(a.rotation.value):.4g} deg"
        shift, of_o = (amount(f"{x.value:.4g}", unit) for x in (a.position, a.internal_point))
        lines.append(f"errors: position {shift}, rotation {turn}, O {of_o}")
    if found.stiffness is not None:
        s = found.stiffness
        shifting = amount(f"{s.translation.value:.4g}", per("force", unit))
        turning = amount(f"{s.rotation.value:.4g}", times("force", unit))
        lines.append(f"least stiffness: {shifting}, turning {turning} per rad")
    return lines + [
        f"{row.name} {row.side} {limit_amount(row, row.limit, '{:.6g}'.format, unit, ' deg')}: "
        f"{limit_amount(row, row.value, '{:.6g}'.format, unit, ' deg')}, margin {margin_words(row.margin, row.unit)}"
        for row in found.limits
    ]


def region_words(found: Any) -> Iterator[str]:
    """Yield a sentence on how the region was looked over, if there is one; takes a Sheet."""
    if (look := found.region) is not None:
        how = "a sample and descents from the worst of it"
        how += "" if found.leg_ranges is None else " for the lengths of the legs"
        yield f"Region: {look.region}. Poses looked at: {look.looked_at}, {how}."
    if found.leg_ranges is not None:
        yield "O is placed anew at every pose, where the worst of the index and the limits is least."
        if found.leg_ranges:
            yield (
                "Placing O keeps each leg between its permitted lengths. Shortest and longest are those that the "
                "region was found to need."
            )


def over(found: Any) -> str:
    """Return which poses a sheet is over."""
    if found.region is not None:
        return "over the region"
    count = len(found.configurations)
    return f"over {count} poses" if count > 1 else "at the neutral pose"


def lengths_title(found: Any) -> str:
    """Return the title of the table of lengths; takes a Sheet."""
    permitted = ", and permitted (at least, at most)" if found.leg_ranges else ""
    return f"Legs {over(found)}: lengths{permitted and ' needed'}{permitted}"


def motion_words(found: Any) -> Iterator[str]:
    """Yield how speeds, accelerations and cones of a sheet are meant, and which legs never move."""
    linear, angular = found.motion.linear_speed, math.degrees(found.motion.angular_speed)
    most = "no more than that" if linear * angular else "the largest"
    yield (
        f"Speed: the largest in any direction for a platform speed of {amount(f'{linear:g}', per(found.unit, 's'))}, "
        f"turning {angular:g}° per {'second' if found.unit else 'time unit'}, "
        f"{_where_o(found.motion.internal)}. Acceleration: {most} while both are constant. Cones: from the direction "
        "at the neutral pose."
    )
    if found.idle:
        yield f"{', '.join(found.idle)} never move {over(found)}."


def _det(name: str) -> str:
    return f"det {name[-1].upper()}" if name else "none found"


def _pose(k: int) -> str:
    return f"pose {k}" if k else "neutral pose"


def _where_o(internal: str) -> str:
    return "O moves for the least leg rates" if internal == "least" else f"O {WORDS[internal]}"
