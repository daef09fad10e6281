"""The limits of a study as statements about extreme values over all poses, and the answers these give."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ninedof.design import limits
from ninedof.design.study import Study
from ninedof.proof.machine_record import LimitProof, Met
from ninedof.robot.configuration import Configuration
from ninedof.robot.geometry import Geometry
from ninedof.robot.leg_names import LEGS
from ninedof.support.margins import margin_of

Enclosure = tuple[float, float]
Key = tuple[Any, ...]
"""Where a limit holds, then kind, item, whether the greatest value is asked for, and the axis of a cone."""

DETERMINANTS = ("N", "B", "C")
PAIRS = [(k, (k + 1) % 3) for k in range(3)] + [(k, leg) for k in range(3) for leg in range(3, 9)]
OF_KIND = {
    "leg_length": range(9),
    "external_length": range(3),
    "upper_length": range(3, 6),
    "lower_length": range(6, 9),
}
BASE_LEGS, PLATFORM_LEGS = (0, 1, 2, 6, 7, 8), (0, 1, 2, 3, 4, 5)
RELATIVE = {"leg_length": 3e-5, "base_cone": 1e-5, "platform_cone": 1e-5, "clearance": 0.03, "determinant": 1e-3}
"""Width of enclosures, unless a limit lies inside: then the search goes on."""
SPREADS = ("leg_ratio", "stroke")  # the beginning of their names
NARROW = 1e-7  # of lengths that decide on a stroke


@dataclass(frozen=True)
class Extreme:
    """The greatest or least value of a number over all poses is in `value`; one end of it was met at a pose."""

    value: Enclosure
    at: Met | None
    boxes: int = 0


Extremes = Mapping[Key, Extreme]


class Plan:
    """Which extreme values the limits of a study ask for, and what follows from them."""

    def __init__(self, study: Study, geometry: Geometry, neutral: Configuration, tolerance: float) -> None:
        """Go through the limits."""
        self.requests: dict[Key, dict[str, Any]] = {}
        self.rows: list[Callable[[Extremes], LimitProof]] = []
        self._geometry, self._zp, self._zs = geometry, float(neutral.position[2]), float(neutral.internal_point[2])
        self._tolerance = tolerance
        self._exempt = pairs_sharing_a_joint(study, geometry)
        self.legs = [
            (self._ask("poses", "leg_length", k, False), self._ask("poses", "leg_length", k, True)) for k in range(9)
        ]
        self.determinants = [self._ask("poses", "determinant", k, False, 0.0) for k in range(3)]
        self._row("no singularity", "sign", "min", 0.0, self.determinants, [f"det {d}" for d in DETERMINANTS])
        for name, limit in limits.each(study.constraints):
            self._add(name, limit)

    def narrowed(self) -> list[Key]:
        """Ask for narrower enclosures of lengths; return what was asked for."""
        keys = [key for key in self.requests if key[1] == "leg_length"]
        self.requests |= {key: self.requests[key] | {"relative": NARROW} for key in keys}
        return keys

    def _ask(self, where: str, kind: str, item: int, greatest: bool, limit: float = math.nan, axis: Any = ()) -> Key:
        key = (where, kind, item, greatest, tuple(axis))
        old = self.requests.get(key)
        if old is None or math.isnan(old["limit"]):
            self.requests[key] = {
                "kind": kind,
                "item": item,
                "greatest": greatest,
                "relative": RELATIVE[kind],
                "limit": limit,
                "axis": list(axis),
            }
        elif not math.isnan(limit):  # two limits: narrow in any case
            self.requests[key] = old | {"relative": 1e-6}
        return key

    def _add(self, name: str, limit: limits.Limit) -> None:
        low, high, options = limits.parts(limit)
        kind, where = limits.ROWS[name].kind, limits.place(limit)
        label = limits.label(name, where)
        scale = self._scale(options.get("of", "length"))
        axis = limits.for_core(name, limit)["axis"]
        for side, given in (("min", low), ("max", high)):
            if not given:  # none, or at least 0
                continue
            bound, greatest = given * scale, side == "max"
            if name == "joint_spacing":  # of the largest radius of each body, if of a radius
                self._fixed(label, kind, side, given, self._spacing(options.get("of") == "radius"))
            elif name in FIXED:
                self._fixed(label, kind, side, bound, FIXED[name](self._geometry, self._zp, self._zs))
            elif name.startswith(SPREADS):
                self._spread(name, label, kind, side, bound, where)
            else:
                items, named, quantity = self._items(name)
                edge = bound * (1.0 + self._tolerance if greatest else 1.0 - self._tolerance)
                keys = [self._ask(where, quantity, k, greatest, edge, axis) for k in items]
                self._row(label, kind, side, bound, keys, named)

    def _items(self, name: str) -> tuple[Sequence[int], list[str], str]:
        if name in OF_KIND:
            return OF_KIND[name], [LEGS[k] for k in OF_KIND[name]], "leg_length"
        if name == "leg_clearance":
            items = [k for k in range(len(PAIRS)) if not self._exempt[k]]
            return items, [f"{LEGS[PAIRS[k][0]]}-{LEGS[PAIRS[k][1]]}" for k in items], "clearance"
        if name == "singularity_free":
            return range(3), [f"det {d}" for d in DETERMINANTS], "determinant"
        legs = BASE_LEGS if name == "base_cone" else PLATFORM_LEGS
        return range(6), [LEGS[k] for k in legs], name

    def _row(self, label: str, kind: str, side: str, bound: float, keys: Sequence[Key], named: Sequence[str]) -> None:
        def answer(found: Extremes) -> LimitProof:
            every = [(found[key], name) for key, name in zip(keys, named, strict=True)]
            if side == "max":
                worst, which = max(every, key=lambda pair: pair[0].value[0])
                value = worst.value[0], max(one.value[1] for one, _ in every)
            else:
                worst, which = min(every, key=lambda pair: pair[0].value[1])
                value = min(one.value[0] for one, _ in every), worst.value[1]
            at = () if worst.at is None else (worst.at,)
            return self._proof(label, kind, side, bound, value, at, which, sum(one.boxes for one, _ in every))

        if keys:
            self.rows.append(answer)

    def _spread(self, name: str, label: str, kind: str, side: str, bound: float, where: str) -> None:
        ends = [(self._ask(where, "leg_length", k, False), self._ask(where, "leg_length", k, True)) for k in range(9)]

        def answer(found: Extremes) -> LimitProof:
            pairs = [(found[a], found[b], name_) for (a, b), name_ in zip(ends, LEGS, strict=True)]
            if name == "leg_ratio":
                least = min((a for a, _, _ in pairs), key=lambda e: e.value[1])
                most = max((b for _, b, _ in pairs), key=lambda e: e.value[0])
                low = Extreme((min(a.value[0] for a, _, _ in pairs), least.value[1]), least.at)
                high = Extreme((most.value[0], max(b.value[1] for _, b, _ in pairs)), most.at)
                pairs = [(low, high, "all legs")]
            values = [(_spread_of(name == "stroke", a.value, b.value), a, b, leg) for a, b, leg in pairs]
            value, a, b, which = max(values, key=lambda v: v[0][0])
            value = value[0], max(v[0][1] for v in values)
            at = tuple(e.at for e in (b, a) if e.at is not None)
            return self._proof(label, kind, side, bound, value, at, which, sum(found[k].boxes for e in ends for k in e))

        self.rows.append(answer)

    def _fixed(self, label: str, kind: str, side: str, bound: float, values: Iterable[Enclosure]) -> None:
        """Of the design alone: values enclosed from exact fractions."""
        every = list(values)
        take = max if side == "max" else min
        value = take(v[0] for v in every), take(v[1] for v in every)
        self.rows.append(lambda _: self._proof(label, kind, side, bound, value, (), "", 0))

    def _proof(
        self,
        label: str,
        kind: str,
        side: str,
        bound: float,
        value: Enclosure,
        at: tuple[Met, ...],
        which: str,
        boxes: int,
    ) -> LimitProof:
        low, high = value
        if side == "max":
            edge = bound * (1.0 + self._tolerance)
            answer = "proved" if high <= edge else "violated" if low > edge else "undecided"
        else:
            edge = bound * (1.0 - self._tolerance)
            # A determinant of zero is a singularity.
            proved = low > 0.0 if bound == 0.0 else low >= edge
            answer = "proved" if proved else "violated" if high < edge or high <= 0.0 == bound else "undecided"
        margin = float(margin_of(kind, side, bound, high if side == "max" else low))
        return LimitProof(label, kind, side, bound, answer, (low, high), margin, which, at, boxes)

    def _scale(self, of: str) -> float:
        if of == "zp":
            return self._zp
        return max(_radii(_base(self._geometry) + _platform(self._geometry)))[1] if of == "radius" else 1.0

    def _spacing(self, of_radius: bool) -> Iterable[Enclosure]:
        for joints in (_base(self._geometry), _platform(self._geometry)):
            most = max(_radii(joints))[1] if of_radius else 1.0
            for k, a in enumerate(joints):
                for b in joints[:k]:
                    low, high = _root(sum((x - y) ** 2 for x, y in zip(a, b, strict=True)))
                    yield low / most * (1.0 - 1e-15), high / most * (1.0 + 1e-15)


def pairs_sharing_a_joint(study: Study, geometry: Geometry) -> list[bool]:
    """Return which pairs of legs share a joint in every design of the study."""
    problem = study.problem()
    others = [problem.geometry(list(x)) for x in problem.starts(4, 1)]
    return [all(_share(g, a, b) for g in (geometry, *others)) for a, b in PAIRS]


def _share(g: Geometry, a: int, b: int) -> bool:
    """Whether external leg a and leg b share a joint."""

    def same(x: Any, y: Any) -> bool:
        return bool(((x - y) ** 2).sum() <= 1e-24 * ((x**2).sum() + (y**2).sum()))

    if b < 3:
        return same(g.base_external[a], g.base_external[b]) or same(g.platform_external[a], g.platform_external[b])
    if b < 6:
        return same(g.platform_external[a], g.platform_internal[b - 3])
    return same(g.base_external[a], g.base_internal[b - 6])


def _spread_of(difference: bool, least: Enclosure, most: Enclosure) -> Enclosure:
    """Return the stroke, or its ratio, from enclosures of the shortest and the longest length."""
    if difference:
        low, high = most[0] - least[1], most[1] - least[0]
        room = 1e-15 * most[1]
        return low - room, high + room
    return most[0] / least[1] * (1.0 - 1e-15), (most[1] / least[0] if least[0] > 0.0 else math.inf) * (1.0 + 1e-15)


Joints = list[tuple[Fraction, ...]]


def _exact(*triples: Any) -> Joints:
    return [tuple(Fraction(float(x)) for x in joint) for triple in triples for joint in triple]


def _base(g: Geometry) -> Joints:
    return _exact(g.base_external, g.base_internal)


def _platform(g: Geometry) -> Joints:
    return _exact(g.platform_external, g.platform_internal)


def _root(square: Fraction | int) -> Enclosure:
    root = math.sqrt(square)
    return root * (1.0 - 1e-15), root * (1.0 + 1e-15)


def _radii(joints: Joints) -> list[Enclosure]:
    return [_root(x**2 + y**2) for x, y, _ in joints]


def _radius_ratio(g: Geometry) -> Enclosure:
    base, platform = max(_radii(_base(g))), max(_radii(_platform(g)))
    return base[0] / platform[1] * (1.0 - 1e-15), base[1] / platform[0] * (1.0 + 1e-15)


def _fraction(zp: float, zs: float) -> Enclosure:
    return zs / zp * (1.0 - 1e-15), zs / zp * (1.0 + 1e-15)


FIXED: dict[str, Callable[[Geometry, float, float], list[Enclosure]]] = {
    "radius_ratio": lambda g, zp, zs: [_radius_ratio(g)],
    "zs_fraction": lambda g, zp, zs: [_fraction(zp, zs)],
    "height": lambda g, zp, zs: [(zp, zp)],
    "footprint": lambda g, zp, zs: [max(_radii(_base(g)))],
    "joint_height": lambda g, zp, zs: [(abs(float(z)), abs(float(z))) for _, _, z in _base(g) + _platform(g)],
}
"""Limits of the design alone."""
