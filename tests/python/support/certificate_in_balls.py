"""A third reader of certificates: leaves of the tree in balls of 120 bits, by the formulas of docs/theory/proof.md."""

import math
import struct

import numpy as np
from balls import Form
from flint import arb, ctx

U, X, ETA, O, TAU, Y, Z = range(7)


def parts(path):
    """The lines of a certificate by their first word, and the bytes of its tree."""
    head, _, rest = path.read_bytes().partition(b"\ntree ")
    words = [line.split() for line in head.decode().splitlines()[2:]]
    return words, rest.partition(b"\n")[2]


def leaves(root, tree, hexagonal=True):
    """(box as ends, code, weights, weights of limits) of every leaf; a box holds pairs of floats.

    The limits are those of the external and the upper leg, of R, zp, zs and the radii of internal joints.
    """
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
        assert code in (16, 17, 18, 19)
        limits = np.zeros(7)
        count = 2 if code > 17 else 0
        weights, at = struct.unpack_from(f"<{count}f", tree, at), at + 4 * count
        if code == 19:
            which = [k for k in range(8) if tree[at] >> k & 1]
            limits[which] = struct.unpack_from(f"<{len(which)}f", tree, at + 1)
            at += 1 + 4 * len(which)
        yield box, code, weights, limits
    assert at == len(tree)


def logarithms(v):
    """log sigma of forms of five or seven coordinates: axial max and min, transverse max and min."""
    u, x, eta, o, tau = (v[k] for k in range(5))
    one = 0 * x + 1
    y, z = (v[Y], v[Z]) if len(v.x) > 5 else (x, one)
    c = (1 - tau * tau) / (1 + tau * tau)
    s2 = 4 * tau * tau / ((1 + tau * tau) * (1 + tau * tau))
    t = o / (1 + o)
    q = one / (1 + o)
    n = (x - 1) * (x - 1) + 2 * x * (1 - c) + eta * eta
    up, low = q * eta, t * eta
    w0 = one / (2 + z * z / (up * up) + y * y / (low * low))
    w1 = one / (2 + up * up / (z * z) + low * low / (y * y))
    stretch = 1 + up * up * u * u
    h2 = (t + q * x * c) * (t + q * x * c) + q * q * x * x * s2
    p = 1 - c * x + q * eta * eta * u * u
    axial = (3 * u * u * x * x * s2 / n, 3 * eta * eta / n, 3 * w0)
    slant = (p * p + x * x * s2) / (n * stretch)
    transverse = (1.5 * u * u * eta * eta * h2 / (n * stretch), 1.5 * slant, 1.5 * stretch * w1)
    out = []
    for g2, f2, w2 in (axial, transverse):
        g, w = root(g2), root(w2)
        top = 0.5 * (root((g + w) * (g + w) + f2) + root((g - w) * (g - w) + f2))
        out += [log(top), log(g * w / top)]
    return out


def log_sizes(v):
    """Of R, zp and zs of hexagons."""
    u, x, eta, o = (log(v[k]) for k in range(4))
    return u + x, u + eta, u + eta + o - log(v[O] + 1)


def root(v):
    return v.of(np.sqrt, lambda x: 0.5 / np.sqrt(x))


def log(v):
    return v.of(np.log, lambda x: 1 / x)


def excluded(ends, target, weights, limits=(), bounds=()):
    """Whether no design of the box has a condition number below the target, by the weights of a combination.

    Of hexagons also by weights of limits, and the ends of R, zp and zs.
    """
    middles = [math.sqrt(a) * math.sqrt(b) for a, b in ends]
    v = Form.coordinates(middles, ends, range(len(ends)))
    v.x[:, 2:] *= v.x[:, 1:2]  # slopes along the logarithms
    half = [
        max((arb(b) / m).log().abs_upper(), (m / arb(a)).log().abs_upper())
        for (a, b), m in zip(ends, middles, strict=True)
    ]
    a, b = (arb(w) for w in weights[:2])
    mix = sum(w * row for w, row in zip((1 - a, -(1 - b), a, -b), logarithms(v), strict=True))
    for weight, size, ends_of in zip(limits[2:5], log_sizes(v), bounds, strict=True) if any(limits) else ():
        if weight:
            mix = mix + arb(weight) * (size + -arb(ends_of[int(weight > 0)]).log())
    return (mix - arb(target).log()).over(np.array(half)) >= 0


def closed(ends, target, weights, depth=15, **limited):
    """The same, cutting the box where one look is not enough."""
    ctx.prec = 120
    if excluded(ends, target, weights, **limited):
        return True
    if depth == 0:
        return False
    k = max(range(len(ends)), key=lambda k: math.log(ends[k][1] / ends[k][0]))
    low, high = ends[k]
    middle = math.sqrt(low) * math.sqrt(high)
    halves = ([*ends[:k], half, *ends[k + 1 :]] for half in ((low, middle), (middle, high)))
    return all(closed(half, target, weights, depth - 1, **limited) for half in halves)
