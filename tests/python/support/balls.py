"""Numbers over a box in balls of Arb with their slopes: bounds by the mean value theorem. Nothing is of the package.

A `Form` is an array; the last axis of its `x` holds each number in the middle of the box, over the box, and its slopes
along the coordinates over the box.
"""

import numpy as np
from flint import arb, arb_mat

UNIT = arb(0, 1)
_balls = np.frompyfunc(arb, 1, 1)
_root = np.frompyfunc(lambda v: v.nonnegative_part().sqrt(), 1, 1)
_share = np.frompyfunc(lambda v, size: (v / size).intersection(UNIT) if size > 0 else UNIT, 2, 1)
_meet = np.frompyfunc(lambda v, w: v.intersection(w) if v.is_finite() and w.is_finite() else w, 2, 1)
_sign, _sine = np.frompyfunc(arb.sgn, 1, 1), np.frompyfunc(arb.sinc, 1, 1)
_larger, _either = np.frompyfunc(arb.max, 2, 1), np.frompyfunc(arb.union, 2, 1)
_size = np.vectorize(lambda v: float(v.abs_upper()), otypes=[float])


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
        x = balls(np.zeros((len(ends), 2 + len(free))))
        x[:, 0], x[:, 1] = balls(middles), [arb(low).union(arb(high)) for low, high in ends]
        x[free, 2 + np.arange(len(free))] = arb(1)
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

    def sum(self, axis=-1):
        return Form(self.x.sum(axis - 1 if axis < 0 else axis))

    def norm(self):
        """Of the vectors along the last axis, at zero too, where its slope is that along some unit vector."""
        size = np.asarray(_root((self.x[..., :2] * self.x[..., :2]).sum(-2)))
        out = (_share(self.x[..., 1], size[..., 1:])[..., None] * self.x).sum(-2)
        out[..., :2] = size
        return Form(out)

    def unit(self):
        return self / self.norm()[..., None]

    def max(self):
        """The greatest of a vector; its slopes are those of any number that may be it."""
        most = _larger.reduce(self.x[:, :2])
        out = _either.reduce(self.x[~(self.x[:, 1] < most[1])])
        out[:2] = most
        return Form(out)

    def reshape(self, *shape):
        return Form(self.x.reshape(*shape, self.x.shape[-1]))

    @property
    def T(self):
        return Form(self.x.swapaxes(-2, -3))

    @property
    def middle(self):
        return self.x[..., 0].astype(float)

    def moves(self, half):
        """About how far each coordinate moves each number."""
        return _size(self.x[..., 2:] * half)

    def over(self, half):
        """Balls of the numbers over the box: what the mean value theorem and the formula itself both allow."""
        return _meet(self.x[..., 0] + (self.x[..., 2:] * half * UNIT).sum(-1), self.x[..., 1])

    def tight(self, half):
        """The same numbers, over the box as the mean value theorem has them."""
        out = self.x.copy()
        out[..., 1] = self.over(half)
        return Form(out)


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


def solve(a, b):
    """x of a x = b, a being near the identity after a change of rows; nan where its balls may be singular."""
    change = arb_mat(np.linalg.pinv(np.nan_to_num(a.middle)).tolist())
    a, b = ([change * arb_mat(layer.tolist()) for layer in np.moveaxis(one.x, -1, 0)] for one in (a, b))
    inverse = [layer.inv(nonstop=True) for layer in a[:2]]
    x = [inverse[k] * b[k] for k in (0, 1)]
    slopes = [inverse[1] * (right - left * x[1]) for left, right in zip(a[2:], b[2:], strict=True)]
    return Form(np.stack([np.array(layer.tolist(), object) for layer in (*x, *slopes)], -1))


def _sinc(v):
    """Its slope is -v / 3 + v^3 / 30 at most, and -v / 3 at least: it is -t sin(v t), t from 0 to 1, summed."""
    return v.of(_sine, lambda v: v**3 * (arb(1, 1) / 60) - v * (arb(1) / 3))


def turn(a):
    """The rotation matrix of a rotation vector."""
    k = stack([stack([0 * a[0], -a[2], a[1]]), stack([a[2], 0 * a[0], -a[0]]), stack([-a[1], a[0], 0 * a[0]])])
    s, c = _sinc(a.norm()), _sinc(a.norm() * 0.5)
    return k * s + k @ k * (c * c * 0.5) + np.eye(3)


def about_z(angle):
    c, s = angle.of(np.cos, lambda v: -np.sin(v)), angle.of(np.sin, np.cos)
    return stack([stack([c, -s, 0 * c]), stack([s, c, 0 * c]), stack([0 * c, 0 * c, 0 * c + 1])])
