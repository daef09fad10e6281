"""A rule for O that is nearly as good as O placed anew at every pose.

Polynomials of rising degree are fitted to the best O of sampled poses; then the worst of the index and of all limits
over these poses is lowered: it is smoothed, and Newton's method goes down with less and less smoothing. Poses where a
proof of the rule fails join. Nothing here is proved: proofs take the rule as it is.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from ninedof.design.region_placed import Placing
from ninedof.design.region_stack import configurations_at, samples
from ninedof.proof.point_rule import PointRule
from ninedof.proof.rule_rows import WEIGHT, Rows, first_samples, middles_of, of_spread
from ninedof.robot.geometry import Geometry
from ninedof.support.arrays import Floats

MOST_TERMS = 150
DEGREES = range(1, 7)
GOOD = 1e-2  # of the index: a rule so near the best O is not made finer
GAIN = 2e-3  # by which a higher degree has to be better
DENSE = 10_000  # half of each of two kinds
JOINED = 100  # of the dense sample, at most
CAUTION = 0.1  # of what was passed, is left too from then on
ROUNDS = 8  # of proofs of limits, and poses that join
FIRST_SMOOTHINGS, SMOOTHINGS = (5e-2, 1e-2), (3e-3, 1e-3)
STEPS, TRIES = 15, 20  # for each, at most; of a step, each shorter than that before
STIFFNESS = 3.0  # what bends cost, in squares of zp: rules that wind are hard to prove, and worse between samples
WINDOW = 8.0  # smoothings below the largest row: others weigh next to nothing
LEAST_FALL = 0.03  # of a step, in smoothings: less ends the steps


@dataclass(frozen=True)
class Checked:
    """What a proof of a rule has met."""

    index: float
    """The logarithm of the index, less that of the goal."""
    passed: float
    """The part of itself by which a limit is passed."""
    poses: Floats
    """Where: coordinates in the region, shape (n, 6)."""

    @property
    def excess(self) -> float:
        """Both, limits weighted."""
        return max(self.index, WEIGHT * self.passed)


def fit_rule(
    place: Placing,
    geometry: Geometry,
    check: Callable[[PointRule], Checked] | None = None,
    threads: int = 0,
    say: Callable[[str], object] = str,
) -> PointRule:
    """Return a rule for O over the region of a study, of the lowest degree that is good.

    `check` looks for poses where the rule is worse than it is at the sampled ones. `say` is told what begins.
    """
    fit = _fitted(Rows(place, geometry, threads), say)
    best: tuple[tuple[bool, float], PointRule] | None = None
    for turn in range(ROUNDS if check else 0):
        rule = fit.rule()
        say(f"checking the rule for O, round {turn + 1} of at most {ROUNDS}")
        found = check(rule)  # type: ignore[misc]
        rank = found.passed > 0.0, found.excess  # limits come first
        if best is None or rank < best[0]:
            best = rank, rule
        if (found.passed <= 0.0 and found.index <= fit.worst() + GAIN) or turn == ROUNDS - 1:
            break
        if found.passed > 0.0 and found.index > GOOD:  # a goal out of reach would count for more than limits
            fit.rows.goal = math.log(place.objective) + found.index
        say(f"mending the rule for O, round {turn + 1} of at most {ROUNDS}")
        fit.rows.margin += CAUTION * max(found.passed, 0.0)
        fit.join(np.concatenate([found.poses, fit.passed()]))
        for smoothing in SMOOTHINGS:
            fit.lower(smoothing)
    return fit.rule() if best is None else best[1]


def _fitted(rows: Rows, say: Callable[[str], object]) -> _Fit:
    """Return the fit of the lowest degree that is good at the sampled poses."""
    first = first_samples(rows.region)
    say(f"placing O at {len(first)} poses")
    near, shifts = rows.best(first)
    best: _Fit | None = None
    for degree in DEGREES:
        powers = _powers(rows.coordinates(near), degree)
        if best is not None and (len(powers) > MOST_TERMS or len(powers) == best.terms):
            break
        say(f"fitting a rule for O of degree {degree}")
        fit = _Fit(rows, powers, near, shifts)
        for smoothing in FIRST_SMOOTHINGS:
            fit.lower(smoothing)
        if best is not None and fit.worst() > best.worst() - GAIN:
            break
        best = fit
        if fit.worst() < 2.0 * GOOD:
            for smoothing in SMOOTHINGS:
                fit.lower(smoothing)
            if fit.worst() < GOOD:
                break
    assert best is not None
    return best


class _Fit:
    """Coefficients of given terms that make the worst row least, over poses that become more."""

    def __init__(self, rows: Rows, powers: Floats, near: Floats, shifts: Floats) -> None:
        self.rows, self._powers = rows, powers
        x = rows.coordinates(near)
        self._scale = np.where(abs(x).max(axis=0) > 0.0, 2.0 ** np.ceil(np.log2(abs(x).max(axis=0) + 1e-300)), 1.0)
        self._near, self._terms = near, self._of(x)
        self._c = np.linalg.lstsq(self._terms, shifts, rcond=1e-9)[0]
        length = rows.lengths(near, self._terms @ self._c)[0]
        self._middles = [middles_of(spread, length) for spread in rows.spreads]

    def rule(self) -> PointRule:
        """Return the rule."""
        r = self.rows
        return PointRule.of(r.neutral, self._scale.tolist(), self._powers.tolist(), (r.zp * self._c).tolist())

    @property
    def terms(self) -> int:
        """How many terms there are."""
        return len(self._powers)

    def worst(self) -> float:
        """Return the worst row."""
        return max(float(value.max()) for value in self._largest())

    def passed(self) -> Floats:
        """Return the poses of a dense sample that are worse than those taken."""
        rows = self.rows
        dense = configurations_at(rows.region, rows.neutral, samples(rows.region, DENSE))[0]
        terms = self._of(rows.coordinates(dense))
        worst = np.max([value.max(axis=1) for value, *_ in self._values(dense, terms)], axis=0)
        order = np.argsort(-worst)[:JOINED]
        return np.asarray(dense[order[worst[order] > self.worst()]])

    def join(self, near: Floats) -> None:
        """Take further poses of the region."""
        self._near = np.concatenate([self._near, near])
        self._terms = np.concatenate([self._terms, self._of(self.rows.coordinates(near))])

    def _of(self, x: Floats) -> Floats:
        u = x / self._scale
        return np.asarray(np.prod(u[:, None, :] ** self._powers[None], axis=2))

    def _values(self, near: Floats, terms: Floats) -> Iterator[tuple[Floats, Floats, int, float]]:
        """Yield rows (n, r) and slopes (n, r, 3), then the number of the first middle and its sign, if it has one."""
        shift = terms @ self._c
        yield (*self.rows.single(near, shift), -1, 0.0)
        if not (rows := self.rows).spreads:
            return
        length, slope = self.rows.lengths(near, shift)
        first = 0
        for spread, middles in zip(self.rows.spreads, self._middles, strict=True):
            value = of_spread(spread, length)
            by = slope / length[..., None] if spread.logarithm else slope / spread.size
            kept = slice(0 if spread.common else 3, 9)
            for sign in (1.0, -1.0):
                away = sign * (value - middles) - spread.half + 0.5 * rows.margin
                yield WEIGHT * away[:, kept], WEIGHT * sign * by[:, kept], first + kept.start, -WEIGHT * sign
            first += 9

    def _largest(self) -> list[Floats]:
        return [value for value, *_ in self._values(self._near, self._terms)]

    def lower(self, smoothing: float) -> None:
        """Lower the worst row, smoothed, by damped steps of Newton's method without its second derivatives."""
        damping = 1e-2
        terms = self._c.size
        middles = 9 * len(self._middles)
        spread = self._terms.T @ self._terms / len(self._terms)
        spread += 1e-9 * np.trace(spread) / len(spread) * np.eye(len(spread))
        metric = np.zeros((terms + middles,) * 2)
        metric[:terms, :terms] = np.kron(spread, np.eye(3))
        metric[range(terms, terms + middles), range(terms, terms + middles)] = 1e-2
        stiff = STIFFNESS * np.repeat(np.maximum(self._powers.sum(axis=1) - 1, 0) ** 2, 3)
        for _ in range(STEPS):
            every = list(self._values(self._near, self._terms))
            most = max(float(value.max()) for value, *_ in every)
            value, jacobian = self._jacobian(every, most - WINDOW * smoothing, terms, middles)
            weight = np.exp((value - most) / smoothing)
            flat = self._c.ravel()
            soft = most + smoothing * math.log(weight.sum()) + 0.5 * float(stiff @ flat**2)
            weight /= weight.sum()
            mean = weight @ jacobian
            bend = ((jacobian.T * weight) @ jacobian - np.outer(mean, mean)) / smoothing
            mean[:terms] += stiff * flat
            bend[range(terms), range(terms)] += stiff
            start = self._c.copy(), [m.copy() for m in self._middles]
            for _ in range(TRIES):
                way: Floats = np.asarray(np.linalg.solve(bend + damping * metric, -mean), dtype=float)
                self._c = start[0] + way[:terms].reshape(-1, 3)
                self._middles = self._moved(start[1], way[terms:])
                rows = self._largest()
                top = max(float(r.max()) for r in rows)
                total = sum(float(np.exp((r[r > top - WINDOW * smoothing] - top) / smoothing).sum()) for r in rows)
                lower = soft - top - smoothing * math.log(total) - 0.5 * float(stiff @ self._c.ravel() ** 2)
                if lower > 0.0:
                    damping = max(damping / 5.0, 1e-6)
                    break
                damping *= 8.0
            else:
                self._c, self._middles = start
                return
            if lower < LEAST_FALL * smoothing:
                return

    def _moved(self, middles: list[Floats], way: Floats) -> list[Floats]:
        out = []
        for k, (spread, old) in enumerate(zip(self.rows.spreads, middles, strict=True)):
            step = way[9 * k : 9 * k + 9]
            out.append(old + (step.sum() if spread.common else step))
        return out

    def _jacobian(
        self, every: list[tuple[Floats, Floats, int, float]], least: float, terms: int, middles: int
    ) -> tuple[Floats, Floats]:
        values, parts = [], []
        for value, slope, first, sign in every:
            pose, row = np.nonzero(value > least)
            part = np.zeros((len(pose), terms + middles))
            part[:, :terms] = np.einsum("nm,ni->nmi", self._terms[pose], slope[pose, row]).reshape(len(pose), terms)
            if first >= 0:
                part[range(len(pose)), terms + first + row] = sign
            values.append(value[pose, row])
            parts.append(part)
        return np.concatenate(values), np.concatenate(parts)


def _powers(x: Floats, degree: int) -> Floats:
    """Return the powers of all terms up to a degree of the coordinates that move, shape (m, 6)."""
    moving = [k for k in range(6) if np.ptp(x[:, k]) > 0.0]
    out = []
    for total in range(degree + 1):
        for some in itertools.combinations_with_replacement(moving, total):
            out.append([some.count(k) for k in range(6)])
    return np.array(out)
