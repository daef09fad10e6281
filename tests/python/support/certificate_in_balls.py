"""A third reader of certificates: leaves of the tree in balls of 120 bits, by the formulas of docs/theory/proof.md."""

import math
import struct

from flint import arb, ctx

U, X, ETA, O, TAU, Y, Z = range(7)


def ball(low, high):
    low, high = arb(low), arb(high)
    return ((low + high) / 2).union(low).union(high)


def parts(path):
    """The lines of a certificate by their first word, and the bytes of its tree."""
    head, _, rest = path.read_bytes().partition(b"\ntree ")
    words = [line.split() for line in head.decode().splitlines()[2:]]
    return words, rest.partition(b"\n")[2]


def leaves(root, tree, hexagonal=True):
    """(box as ends, code, weights) of every leaf; a box holds pairs of floats."""
    at, ahead = 0, [root]
    while ahead:
        box = ahead.pop()
        code = tree[at]
        at += 1
        if code < 7:
            low, high = box[code]
            middle = min(max(math.sqrt(low) * math.sqrt(high), low), high)
            for half in ((middle, high), (low, middle)):
                cut = list(box)
                cut[code] = half
                if hexagonal:
                    cut[Y] = cut[X]
                ahead.append(cut)
            continue
        count = {16: 0, 17: 0, 18: 2, 19: 4}[code]
        yield box, code, struct.unpack(f"<{count}f", tree[at : at + 4 * count])
        at += 4 * count
    assert at == len(tree)


class Slope:
    """A ball and its derivatives along the logarithms of the coordinates."""

    def __init__(self, value, along=None):
        self.value, self.along = arb(value), along or [arb(0)] * 7

    def __add__(self, other):
        other = other if isinstance(other, Slope) else Slope(other)
        return Slope(self.value + other.value, [a + b for a, b in zip(self.along, other.along, strict=True)])

    __radd__ = __add__

    def __mul__(self, other):
        other = other if isinstance(other, Slope) else Slope(other)
        pairs = zip(self.along, other.along, strict=True)
        return Slope(self.value * other.value, [a * other.value + b * self.value for a, b in pairs])

    __rmul__ = __mul__

    def __sub__(self, other):
        return self + (-1) * other

    def __rsub__(self, other):
        return (-1) * self + other

    def inverse(self):
        return Slope(1 / self.value, [-a / self.value**2 for a in self.along])

    def __truediv__(self, other):
        return self * (other.inverse() if isinstance(other, Slope) else 1 / arb(other))

    def root(self):
        r = self.value.sqrt()
        return Slope(r, [a / (2 * r) for a in self.along])

    def log(self):
        return Slope(self.value.log(), [a / self.value for a in self.along])


def logarithms(box):
    """log sigma: axial max and min, transverse max and min."""
    v = [Slope(b, [b if j == k else arb(0) for j in range(7)]) for k, b in enumerate(box)]
    u, x, eta, o, tau = v[:5]
    y, z = (x, Slope(1)) if len(box) == 5 else v[5:]
    c = (1 - tau * tau) / (1 + tau * tau)
    s2 = 4 * tau * tau / ((1 + tau * tau) * (1 + tau * tau))
    q, t = (1 + o).inverse(), o / (1 + o)
    n = (x - 1) * (x - 1) + 2 * x * (1 - c) + eta * eta
    up, low = q * eta, t * eta
    w0 = (2 + z * z / (up * up) + y * y / (low * low)).inverse()
    w1 = (2 + up * up / (z * z) + low * low / (y * y)).inverse()
    stretch = 1 + up * up * u * u
    h2 = (t + q * x * c) * (t + q * x * c) + q * q * x * x * s2
    p = 1 - c * x + q * eta * eta * u * u
    axial = (3 * u * u * x * x * s2 / n, 3 * eta * eta / n, 3 * w0)
    slant = (p * p + x * x * s2) / (n * stretch)
    transverse = (1.5 * u * u * eta * eta * h2 / (n * stretch), 1.5 * slant, 1.5 * stretch * w1)
    out = []
    for g2, f2, w2 in (axial, transverse):
        g, w = g2.root(), w2.root()
        top = 0.5 * (((g + w) * (g + w) + f2).root() + ((g - w) * (g - w) + f2).root())
        out += [top.log(), (g * w / top).log()]
    return out


def excluded(ends, target, weights):
    """Whether no design of the box has a condition number below the target, by the weights of a combination."""
    middles = [math.sqrt(a) * math.sqrt(b) for a, b in ends]
    box, point = [ball(a, b) for a, b in ends], [arb(m) for m in middles]
    a, b = (arb(w) for w in weights[:2])
    mix = (1 - a, -(1 - b), a, -b)
    at_middle = sum((w * row.value for w, row in zip(mix, logarithms(point), strict=True)), arb(0))
    slopes = logarithms(box)
    for k, m in enumerate(middles):
        slope = sum((w * row.along[k] for w, row in zip(mix, slopes, strict=True)), arb(0))
        reach = max((box[k] / m).log().abs_upper(), (m / box[k]).log().abs_upper())
        at_middle -= slope.abs_upper() * reach
    return at_middle.lower() >= arb(target).log()


def closed(ends, target, weights, depth=15):
    """The same, cutting the box where one look is not enough."""
    ctx.prec = 120
    if excluded(ends, target, weights):
        return True
    if depth == 0:
        return False
    k = max(range(len(ends)), key=lambda k: math.log(ends[k][1] / ends[k][0]))
    low, high = ends[k]
    middle = math.sqrt(low) * math.sqrt(high)
    halves = ([*ends[:k], half, *ends[k + 1 :]] for half in ((low, middle), (middle, high)))
    return all(closed(half, target, weights, depth - 1) for half in halves)
