"""Numbers over a box in balls of Arb with their slopes: bounds by the mean value theorem. Nothing is of the package.

A `Form` is an array; the last axis of its `x` holds each number in the middle of the box, over the box, and its slopes
along the coordinates over the box.
"""

import math
from functools import cache

import numpy as np
from flint import arb

_balls = np.frompyfunc(arb, 1, 1)
_square = np.frompyfunc(lambda v: (v.abs_lower() * v.abs_lower()).union(v.abs_upper() * v.abs_upper()), 1, 1)
_root = np.frompyfunc(lambda v: v.sqrt() if v > 0 else arb(0).union(v.abs_upper().sqrt()), 1, 1)
_share = np.frompyfunc(lambda v, size: v / size if size > 0 else arb(0, 1), 2, 1)
_sign = np.frompyfunc(lambda v: 1 if v > 0 else -1 if v < 0 else arb(0, 1), 1, 1)
_upper = np.frompyfunc(lambda v: v.abs_upper(), 1, 1)


def balls(values):
    """Floats or balls as an array of balls, exactly."""
    return np.asarray(_balls(np.asarray(values, object)), object)


class Form:
    __array_ufunc__ = None  # an array times a form is the form's product

    def __init__(self, x):
        self.x = x

    @classmethod
    def coordinates(cls, middles, ends, free):
        """Numbers between their ends, of which some are free."""
        x = np.full((len(ends), 2 + len(free)), arb(0), object)
        for k, (low, high) in enumerate(ends):
            x[k, :2] = arb(middles[k]), arb(low).union(arb(high))
        for slope, k in enumerate(free):
            x[k, 2 + slope] = arb(1)
        return cls(x)

    def __getitem__(self, key):
        return Form(self.x[(*(key if isinstance(key, tuple) else (key,)), slice(None))])

    def __add__(self, o):
        if isinstance(o, Form):
            return Form(self.x + o.x)
        return Form(self.x + balls(o)[..., None] * np.array([1, 1] + [0] * (self.x.shape[-1] - 2), object))

    def __mul__(self, o):
        if not isinstance(o, Form):
            return Form(self.x * balls(o)[..., None])
        out = self.x * o.x[..., 1:2] + self.x[..., 1:2] * o.x
        out[..., :2] = self.x[..., :2] * o.x[..., :2]
        return Form(out)

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self):
        return Form(-self.x)

    def __sub__(self, o):
        return self + -o

    def __rsub__(self, o):
        return -self + o

    def __truediv__(self, o):
        return self * o.of(lambda v: 1 / v, lambda v: -1 / (v * v))

    def __matmul__(self, matrix):
        return (self[..., None] * matrix).sum(-2)

    def __abs__(self):
        return self.of(abs, _sign)

    def of(self, f, derivative):
        out = self.x * np.asarray(derivative(self.x[..., 1]), object)[..., None]
        out[..., :2] = f(self.x[..., :2])
        return Form(out)

    def root(self):
        return self.of(np.sqrt, lambda v: 0.5 / np.sqrt(v))

    def log(self):
        return self.of(np.log, lambda v: 1 / v)

    def sum(self, axis=-1):
        return Form(self.x.sum(axis - 1 if axis < 0 else axis))

    def norm(self):
        """Of the vectors along the last axis, at zero too, where its slope is that along some unit vector."""
        size = np.asarray(_root(_square(self.x[..., :2]).sum(-2)))
        out = (_share(self.x[..., 1], size[..., 1:])[..., None] * self.x).sum(-2)
        out[..., :2] = size
        return Form(out)

    def unit(self):
        return self / self.norm()[..., None]

    def reshape(self, *shape):
        return Form(self.x.reshape(*shape, self.x.shape[-1]))

    @property
    def T(self):
        return Form(self.x.swapaxes(-2, -3))

    @property
    def middle(self):
        return self.x[..., 0].astype(float)

    def moves(self, half):
        """How far each coordinate moves each number, upper bounds."""
        return _upper(self.x[..., 2:]) * half

    def ends(self, half):
        """Lower and upper bounds of each number, the better ones of the mean value theorem and of the ball alone."""
        reach = self.moves(half).sum(-1) if len(half) else 0 * self.x[..., 0]
        both = np.stack([self.x[..., 0] - reach, self.x[..., 0] + reach, self.x[..., 1]], -1).reshape(-1, 3)
        out = [[_low(low, v), -_low(-high, -v)] for low, high, v in both]
        return np.moveaxis(np.array(out).reshape(*self.x.shape[:-1], 2), -1, 0)


def _low(*bounds):
    """A float with the sign of the best lower bound of a number that is known."""
    return max((float(b.lower()) for b in bounds if b.is_finite() and bounds[-1].is_finite()), default=-math.inf)


def stack(forms, join=np.stack):
    """Forms of one shape side by side, along a new first axis; with `np.concatenate` one after another."""
    return Form(join([one.x for one in forms]))


def dot(v, w):
    return (v * w).sum(-1)


def cross(v, w):
    i, j = [1, 2, 0], [2, 0, 1]
    return v[..., i] * w[..., j] - v[..., j] * w[..., i]


def det(rows):
    return dot(rows[..., 0, :], cross(rows[..., 1, :], rows[..., 2, :]))


def solve(columns, right):
    """x of sum x_k column_k = right, by Cramer's rule after a change of axes to near the identity."""
    change = np.linalg.pinv(np.nan_to_num(columns.middle))
    columns, right = columns @ change, right @ change
    minors = stack([cross(columns[(k + 1) % 3], columns[(k + 2) % 3]) for k in range(3)])
    return dot(minors, right[..., None, :]) / dot(minors[0], columns[0])


def turn(a):
    """The rotation matrix of a rotation vector."""
    k = stack([stack([0 * a[0], -a[2], a[1]]), stack([a[2], 0 * a[0], -a[0]]), stack([-a[1], a[0], 0 * a[0]])])
    s, c = (dot(a, a).of(lambda u, n=n: _series(u, n), lambda u, n=n: _series(u, n, 1)) for n in (1, 2))
    return k * s + k @ k * c + np.eye(3)


def about_z(angle):
    c, s = angle.of(np.cos, lambda v: -np.sin(v)), angle.of(np.sin, np.cos)
    return stack([stack([c, -s, 0 * c]), stack([s, c, 0 * c]), stack([0 * c, 0 * c, 0 * c + 1])])


@np.vectorize(otypes=[object])
def _series(u, shift, order=0):
    """The sum of (-u)^n / (2n + shift)!, or its derivative: sin(v)/v and (1 - cos v)/v^2 of u = v^2 up to 100."""
    total = arb(0) if abs(u) < 100 else arb.nan()
    for n in range(30, order - 1, -1):
        total = total * u + _term(n, shift, order)
    return total + arb(0, 1e-20)


@cache
def _term(n, shift, order):
    return arb((-1) ** n * n**order) / math.factorial(2 * n + shift)
