"""The engineering sheet as tables of the page: the same numbers as `ninedof sheet`."""

from __future__ import annotations

from collections.abc import Iterator

from ninedof.report.markup import Html, beside, joined, paragraphs, table
from ninedof.report.numbers import degrees, short
from ninedof.sheet.limit_rows import limit_amount
from ninedof.sheet.pose_words import pose_words, vector_words
from ninedof.sheet.sheet import Sheet
from ninedof.sheet.words import MECHANISMS, PERMITTED, WAYS, lengths_title, motion_words, over, region_words
from ninedof.support.margins import margin_words
from ninedof.support.units import amount, per, with_unit


def sheet_part(found: Sheet) -> Html:
    """Return the sheet."""
    return joined(
        paragraphs(region_words(found)),
        _limits(found),
        beside(_lengths(found), _motions(found)),
        paragraphs(motion_words(found), "note"),
        _worst(found),
        _joints(found),
    )


def _lengths(found: Sheet) -> Html:
    names = ("shortest", "longest", "neutral", "stroke", *(PERMITTED if found.leg_ranges else ()))
    head = ("leg", *(with_unit(name, found.unit) for name in names), "ratio")
    longest, ratios = [leg.longest for leg in found.legs], [leg.stroke_ratio for leg in found.legs]
    rows: list[tuple[str, ...]] = []
    for k, leg in enumerate(found.legs):
        rows += [()] if k in (3, 6) else []
        lengths = (leg.shortest, leg.longest, leg.neutral, leg.stroke)
        rows.append(
            (
                leg.name,
                *(short(x, longest) for x in (*lengths, *(leg.permitted or ()))),
                short(leg.stroke_ratio, ratios),
            )
        )
    return table(lengths_title(found), head, rows)


def _motions(found: Sheet) -> Html:
    units = (("speed", per(found.unit, "s")), ("acceleration", per(found.unit, "s²")))
    head = ("leg", *(with_unit(name, unit) for name, unit in units), "base cone", "platform cone")
    rows: list[tuple[str, ...]] = []
    for k, leg in enumerate(found.legs):
        rows += [()] if k in (3, 6) else []
        cones = degrees(leg.base_cone), degrees(leg.platform_cone)
        rows.append((leg.name, f"{leg.speed:.5g}", f"{leg.acceleration:.5g}", *cones))
    return table(f"Legs {over(found)}: speeds and cones", head, rows)


def _worst(found: Sheet) -> Html:
    one = len(found.configurations) == 1
    rows = list(_worst_rows(found))
    caption = "At the neutral pose" if one else f"Worst {over(found)}"
    shown = table(
        caption,
        ("", "value", "pose", "there"),
        [(label, value, _name(pose), words) for label, value, pose, words in rows],
        (3,),
    )
    used = sorted({pose for _, _, pose, _ in rows if pose > 0})
    poses = [
        (_name(k), pose_words(found.configurations[k], found.configurations.rotation[0], found.unit)) for k in used
    ]
    return joined(shown, table("These poses", ("pose", "position, O and turn"), poses, (1,)) if poses else Html())


def _worst_rows(found: Sheet) -> Iterator[tuple[str, str, int, str]]:
    """Yield label, value, pose and remark; pose -1 where none belongs to it."""
    worst = found.condition_number
    yield "condition number", f"{worst.value:.6f}", worst.pose, ""
    if len(found.configurations) > 1:
        look = found.region
        spread = "" if look is None else f"± {look.mean_error:.1g}, even over the region"
        yield "mean condition number", f"{found.mean_condition_number:.6f}", -1, spread
    clear = found.clearance
    yield "leg clearance", amount(short(clear.value), found.unit), clear.pose, " and ".join(clear.legs)
    for name, det in sorted(found.determinants.items(), key=lambda item: item[1].value):
        words = MECHANISMS[name] + ", CROSSED between poses" * det.changes_sign
        yield f"|det {name[-1].upper()}|", f"{det.value:.6f}", det.pose, words
    for name, near in found.singularities.items():
        far = degrees(near.distance) if name == "turn" else amount(short(near.distance), found.unit)
        way = f"{'about' if name == 'turn' else 'toward'} {vector_words(round(x, 3) for x in near.direction)}"
        label = f"nearest singularity: {WAYS[name]}"
        if near.mechanism:
            yield label, far, near.pose, f"det {near.mechanism.upper()} = 0 {way}"
        else:
            yield label, "none found", -1, ""


def _name(pose: int) -> str:
    return "" if pose < 0 else f"pose {pose}" if pose else "neutral"


def _limits(found: Sheet) -> Html:
    if not found.limits:
        return Html()
    where = "at its poses" if found.region is None else "over its region"
    rows = []
    for row in found.limits:
        allowed, here = (limit_amount(row, value, short, found.unit) for value in (row.limit, row.value))
        rows.append((row.name.replace("_", " "), row.side, allowed, here, margin_words(row.margin, row.unit)))
    return table(f"Limits of the study, {where}", ("limit", "", "allowed", "here", "margin"), rows, (1,))


def _joints(found: Sheet) -> Html:
    own = (with_unit(name, found.unit) for name in ("x", "y", "z"))
    head = ("joint", *own, *(with_unit(f"neutral {name}", found.unit) for name in ("x", "y", "z")))
    rows: list[tuple[str, ...]] = []
    joints = list(found.joints())
    among = [float(x) for _, body, placed in joints for x in (*body, *placed)]
    for k, (name, body, placed) in enumerate(joints):
        rows += [()] if k and k % 3 == 0 else []
        rows.append((name.replace("_", " "), *(short(float(x), among) for x in (*body, *placed))))
    return table("Joints in the frame of base or platform, and in base axes at the neutral pose", head, rows)
