"""Interval operations against balls of 200 bits (Arb through python-flint): what they enclose, and how tightly.

Not a digit is shared with the package: Arb has its own arithmetic and functions.
"""

from pathlib import Path

import flint
import numpy as np
import pytest
from flint import arb
from numpy.testing import assert_array_equal
from sizes import size

from ninedof import _core

COUNT = size(10_000, 72_000)  # of each operation: 140 thousand operations, or a million
BINARY = {
    "add": lambda x, y: x + y,
    "subtract": lambda x, y: x - y,
    "multiply": lambda x, y: x * y,
    "divide": lambda x, y: x / y,
    "min": lambda x, y: x.min(y),
    "max": lambda x, y: x.max(y),
}
UNARY = {
    "negative": lambda x: -x,
    "abs": abs,
    "square": lambda x: x * x,
    "sqrt": lambda x: x.sqrt(),
    "exp": lambda x: x.exp(),
    "log": lambda x: x.log(),
    "sin": lambda x: x.sin(),
    "cos": lambda x: x.cos(),
    "atan": lambda x: x.atan(),
    "acos": lambda x: x.acos(),
}
MOST_ULPS = {"exp": 8.0, "log": 8.0, "sin": 8.0, "cos": 8.0, "atan": 16.0, "acos": 21.0}
EXACT = {**BINARY, **UNARY}
INF = np.inf
TINY, HUGE, LEAST = np.finfo(float).tiny, np.finfo(float).max, np.finfo(float).smallest_subnormal
HARD = [0.0, -0.0, LEAST, 3 * LEAST, TINY, np.nextafter(TINY, 0), 1.0, np.nextafter(1, 0), np.nextafter(1, 2), 1e-162]
HARD += [np.pi / 2, np.pi, 1.5 * np.pi, 1e8, 2.0**30, 709.78, 745.2, 1e154, 1.5e154, HUGE, np.nextafter(HUGE, 0), 1e300]


@pytest.fixture(autouse=True)
def _bits():
    flint.ctx.prec = 200


def numbers(rng, count):
    """Finite doubles of every size and sign, moderate ones, and hard ones."""
    kind = rng.integers(4, size=count)
    sign = rng.choice([-1.0, 1.0], size=count)
    with np.errstate(over="ignore"):
        spread = np.ldexp(rng.uniform(1.0, 2.0, size=count), rng.integers(-1080, 1024, size=count))
    moderate = np.ldexp(rng.uniform(1.0, 2.0, size=count), rng.integers(-6, 7, size=count))
    return sign * np.select([kind == 0, kind == 1], [spread, rng.choice(HARD, size=count)], moderate)


def intervals(rng, count):
    """Lower and upper ends, and a finite number in each: points, narrow, wide and unbounded intervals."""
    x, other = numbers(rng, count), numbers(rng, count)
    kind = rng.integers(5, size=count)
    with np.errstate(over="ignore"):
        near = np.nextafter(x, rng.choice([-INF, INF], size=count))
    far = np.select([kind <= 1, kind == 2, kind == 3], [x, near, other], rng.choice([-INF, INF], size=count))
    lo, hi = np.minimum(x, far), np.maximum(x, far)
    inside = np.where(np.isfinite(far), np.clip(0.5 * x + 0.5 * far, lo, hi), x)
    return lo, hi, np.where(rng.uniform(size=count) < 0.7, x, inside)


def defined(name, x, y):
    parts = {"divide": y != 0.0, "sqrt": x >= 0.0, "log": x > 0.0, "acos": np.abs(x) <= 1.0}
    return parts.get(name, np.full(x.shape, True))


def operated(name, a, b=None):
    b = a if b is None else b
    return _core.interval_operations(name, np.stack([a[0], a[1], b[0], b[1]], axis=-1)).T


def numbers_left_out(exact, lo, hi):
    """A ball that lies wholly outside is a number left out; an infinite end leaves out none."""
    return [
        (low, value, high)
        for low, value, high in zip(lo.tolist(), exact, hi.tolist(), strict=True)
        if (low != -INF and value < low) or (high != INF and value > high)
    ]


def exact_values(name, x, y):
    xs = [arb(v) for v in x.tolist()]
    if name in UNARY:
        return [UNARY[name](v) for v in xs]
    return [BINARY[name](v, arb(w)) for v, w in zip(xs, y.tolist(), strict=True)]


@pytest.mark.parametrize("name", EXACT)
def test_every_value_is_enclosed_and_points_tightly(name):
    rng = np.random.default_rng([16, *name.encode()])
    a, b = intervals(rng, COUNT), intervals(rng, COUNT)
    lo, hi = operated(name, a, b)
    assert np.all(lo <= hi)  # false for NaN
    meant = defined(name, a[2], b[2])
    lo, hi = lo[meant], hi[meant]
    left_out = numbers_left_out(exact_values(name, a[2][meant], b[2][meant]), lo, hi)
    assert not left_out, left_out[:3]

    points = (a[0] == a[1])[meant] & ((b[0] == b[1])[meant] | (name in UNARY))
    periodic = name in ("sin", "cos")
    largest = np.maximum(np.abs(lo), np.abs(hi))
    looked_at = points & (largest < 0.5 * HUGE) & ~(periodic & (np.abs(a[2][meant]) >= 2.0**30))
    assert looked_at.mean() > 0.05
    ulps = (hi[looked_at] - lo[looked_at]) / np.spacing(largest[looked_at])
    assert ulps.max() <= MOST_ULPS.get(name, 4.0)


def hard_arguments(name, rng, count):
    """Where a function is hardest: beside its zeros and poles, beside the seams of its formula, tiny and huge."""
    sizes = np.ldexp(rng.uniform(1.0, 2.0, count), rng.integers(-1074, -20, count))
    turns = rng.integers(1, 2 ** rng.integers(1, 30, count)) * (np.pi / 2.0)
    near_one = 1.0 - np.ldexp(rng.uniform(0.5, 1.0, count), -rng.integers(0, 53, count))
    beside = {
        "sin": [turns, turns / 2.0, sizes],
        "cos": [turns, turns / 2.0, sizes],
        "exp": [rng.integers(0, 1420, count) * (np.log(2.0) / 2.0), rng.uniform(700.0, 746.0, count), sizes],
        "log": [near_one, 2.0 - near_one, np.sqrt(2.0) * np.ldexp(1.0, rng.integers(-1074, 1023, count)), sizes],
        "atan": [rng.integers(0, 6, count) / 4.0, np.ldexp(sizes, 1000), rng.uniform(0.0, 3.0, count), sizes],
        "acos": [near_one, sizes, rng.uniform(0.0, 1.0, count)],
    }[name]
    x = np.choose(rng.integers(len(beside), size=count), beside)
    x = x + rng.integers(-3, 4, count) * np.spacing(np.minimum(x, 1e308))
    return x if name == "log" else x * rng.choice([-1.0, 1.0], count)


@pytest.mark.parametrize("name", MOST_ULPS)
def test_functions_at_their_hardest_arguments(name):
    x = hard_arguments(name, np.random.default_rng([17, *name.encode()]), size(100_000, 400_000))
    x = x[defined(name, x, x) & np.isfinite(x)]
    lo, hi = operated(name, (x, x))
    left_out = numbers_left_out(exact_values(name, x, x), lo, hi)
    assert not left_out, left_out[:3]
    largest = np.maximum(np.abs(lo), np.abs(hi))
    normal = (largest > 2.0 * TINY) & (largest < 0.5 * HUGE)
    if name in ("sin", "cos"):
        normal &= np.abs(x) < 2.0**30
    assert normal.mean() > 0.5
    assert ((hi - lo)[normal] / np.spacing(largest[normal])).max() <= MOST_ULPS[name]


def test_published_vectors_of_ieee_1788():
    """The tightest results lie within ours, and the ends of ours beside them where a division is not by zero."""
    text = (Path(__file__).parent / "itf1788.txt").read_text(encoding="utf-8")
    cases = [line.split() for line in text.splitlines() if not line.startswith("#")]
    assert len(cases) == 476
    for name, *ends in cases:
        *operands, low, high = (float(x) if "x" not in x else float.fromhex(x) for x in ends)
        a, b = operands[:2], operands[-2:]
        (lo,), (hi,) = operated(name, ([a[0]], [a[1]]), ([b[0]], [b[1]]))
        assert lo <= low, (name, *ends)
        assert high <= hi, (name, *ends)
        if name == "divide" and b[0] <= 0.0 <= b[1]:
            continue
        for ours, tightest in ((lo, low), (hi, high)):
            if abs(tightest) < 1e308 and not (name in ("sin", "cos") and max(map(abs, a)) >= 2.0**30):
                assert abs(ours - tightest) <= MOST_ULPS.get(name, 4.0) * np.spacing(abs(tightest)), (name, *ends)


def test_what_is_not_defined_anywhere_gives_all_numbers():
    everything = [[-INF], [INF]]
    one, zero, below = ([1.0], [1.0]), ([0.0], [0.0]), ([-2.0], [-1.0])
    assert_array_equal(operated("divide", one, zero), everything)
    assert_array_equal(operated("log", zero), everything)
    assert_array_equal(operated("sqrt", below), everything)
