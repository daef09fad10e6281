"""A second checker of certificates of sets, machines and optima over poses: balls of 80 bits and exact rationals.

Written from docs/certificate.md alone, with formulas of its own. It shares nothing with the package, the core or their
checker, and is slow: for small files. numpy proposes directions and vectors, of which nothing is believed.
"""

import math
import zlib
from fractions import Fraction

import numpy as np
from flint import arb, ctx

FIRST = "ninedof certificate of designs 1\nchecksum "
PLATES = ("base_external", "base_internal", "platform_external", "platform_internal")
POSE = 6  # coordinates of a pose; of a spread two poses come before the design
KNOWN = (
    "leg_length external_length upper_length lower_length base_cone platform_cone leg_clearance singularity_free stroke"
)
KNOWN = set(f"{KNOWN} stroke_ratio leg_ratio condition_number height zs_fraction footprint radius_ratio".split())
CUTS = 20_000


class Refused(Exception):
    """The file is no proof."""


def need(true, why):
    if not true:
        raise Refused(why)


def number(word):
    need(word in ("inf", "-inf") or word.lstrip("-").startswith("0x"), f"{word} is no number")
    try:
        return float.fromhex(word)
    except ValueError:
        raise Refused(f"{word} is no number") from None


class Form:
    """A number over a box: its ball, its slopes along the coordinates that move it, its ball in the middle."""

    __slots__ = ("at", "slope", "v")

    def __init__(self, v, slope=None, at=None):
        self.v, self.slope = arb(v), slope or {}
        self.at = self.v if at is None else at

    def __add__(self, o):
        o = o if isinstance(o, Form) else Form(o)
        slope = dict(self.slope)
        for k, x in o.slope.items():
            slope[k] = slope[k] + x if k in slope else x
        return Form(self.v + o.v, slope, self.at + o.at)

    __radd__ = __add__

    def __mul__(self, o):
        if not isinstance(o, Form):
            return Form(self.v * o, {k: x * o for k, x in self.slope.items()}, self.at * o)
        slope = {k: x * o.v for k, x in self.slope.items()}
        for k, x in o.slope.items():
            slope[k] = slope[k] + x * self.v if k in slope else x * self.v
        return Form(self.v * o.v, slope, self.at * o.at)

    __rmul__ = __mul__

    def __neg__(self):
        return self * -1

    def __sub__(self, o):
        return self + -o

    def __rsub__(self, o):
        return -self + o

    def of(self, f, derivative):
        d = derivative(self.v)
        return Form(f(self.v), {k: x * d for k, x in self.slope.items()}, f(self.at))

    def root(self):
        return self.of(lambda x: x.sqrt(), lambda x: 1 / (2 * x.sqrt()))

    def inverse(self):
        return self.of(lambda x: 1 / x, lambda x: -1 / (x * x))

    def ends(self, half):
        """Bounds by the mean value theorem, or of the ball alone where that is better; None where nothing is known."""
        if not (self.v.is_finite() and self.at.is_finite()):
            return -math.inf, math.inf
        reach = sum((x.abs_upper() * half[k] for k, x in self.slope.items()), arb(0))
        low, high = (self.at - reach).lower(), (self.at + reach).upper()
        low, high = max(low, self.v.lower()), min(high, self.v.upper())
        return (low, high) if low.is_finite() and high.is_finite() else (-math.inf, math.inf)


def series(u, shift, order=0):
    """The sum of (-u)^n / (2n + shift)!, or its derivative: sin(v)/v and (1 - cos v)/v^2 of u = v^2 up to 12."""
    terms = [arb(-1) ** n / arb(math.factorial(2 * n + shift)) for n in range(30)]
    if order:
        terms = [n * x for n, x in enumerate(terms)][1:]
    total = arb(0)
    for x in reversed(terms):
        total = total * u + x
    return total + arb(0, 1e-20)


def dot(v, w):
    return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]


def cross(v, w):
    return [v[(k + 1) % 3] * w[(k + 2) % 3] - v[(k + 2) % 3] * w[(k + 1) % 3] for k in range(3)]


def plus(v, w, s=1):
    return [a + s * b for a, b in zip(v, w, strict=True)]


def scaled(s, v):
    return [s * a for a in v]


def unit(v):
    return scaled(dot(v, v).root().inverse(), v)


def times(q, v):
    """Columns of a matrix times a vector."""
    return [q[0][k] * v[0] + q[1][k] * v[1] + q[2][k] * v[2] for k in range(3)]


def turn(a):
    """Columns of the rotation by a vector."""
    u = dot(a, a)
    s, c = (u.of(lambda x, k=k: series(x, k), lambda x, k=k: series(x, k, 1)) for k in (1, 2))
    out = []
    for k in range(3):
        e = [Form(float(i == k)) for i in range(3)]
        once = cross(a, e)
        out.append(plus(plus(e, scaled(s, once)), scaled(c, cross(a, once))))
    return out


def about_z(angle):
    c, s = (angle.of(f, g) for f, g in ((arb.cos, lambda x: -x.sin()), (arb.sin, arb.cos)))
    return [[c, s, Form(0)], [-s, c, Form(0)], [Form(0), Form(0), Form(1)]]


class File:
    """The question and the boxes, each number exact."""

    def __init__(self, data):
        text = data.decode("ascii")
        need(text.startswith(FIRST), "no certificate of designs")
        checksum, _, body = text[len(FIRST) :].partition("\n")
        need(checksum == f"{zlib.crc32(body.encode()):x}", "the checksum does not agree")
        self.lines = {}
        for line in body.splitlines():
            key, *words = line.split(" ")
            self.lines.setdefault(key, []).append(words)
        try:
            self._read()
        except (KeyError, IndexError, TypeError):
            raise Refused("a line is missing, or too short") from None
        except ValueError as error:
            raise Refused(str(error)) from None

    def _read(self):
        lines = self.lines
        self.family = lines["family"][0][0]
        self.variables = [(name, number(low), number(high)) for name, low, high in lines["variable"]]
        need([v[0] for v in self.variables] == self.names(), "the variables are not those of the family")
        need(all(-math.inf < low <= high < math.inf for _, low, high in self.variables), "a variable has no bounds")
        self.varied = [k for k, (_, low, high) in enumerate(self.variables) if low < high]
        self.tool = [number(w) for w in lines["tool"][0]]
        self.length = number(lines["characteristic_length"][0][0])
        shape, *rest = lines["region"][0]
        self.shape, self.region = shape, [number(w) for w in rest[:5]]
        need(shape in ("none", "box", "ball", "cylinder", "path") and min(self.region) >= 0.0, "no region")
        self.shifted, self.in_zp = rest[5] == "shifted", rest[6] == "zp"
        self.corners = [[number(w) for w in words] for words in lines.get("corner", [])]
        self.poses = [([number(w) for w in words[:9]], words[9] == "zp") for words in lines.get("pose", [])]
        self.limits = [
            (w[0], number(w[1]), number(w[2]), w[3], w[4] == "neutral", [number(x) for x in w[5:8]])
            for w in lines.get("limit", [])
        ]
        self.exempt = {int(w[0]) for w in lines.get("exempt", [])}
        self.shares = [number(w) for w in lines["shares"][0]]
        self.boxes = []
        for words in lines["box"]:
            d = len(self.varied)
            ends = [number(w) for w in words[: 2 * d]]
            rest, poses = words[2 * d + 1 :], []
            if words[2 * d] == "outside":
                poses = [(int(rest[k]), [number(w) for w in rest[k + 1 : k + 7]]) for k in (1, 8)]
                need(len(rest) == 15, "a pose is too long")
            need(words[2 * d] in ("inside", "outside", "undecided"), "no state of a box")
            self.boxes.append((list(zip(ends[::2], ends[1::2], strict=True)), words[2 * d], rest[:1], poses))

    def names(self):
        if self.family == "hexagonal":
            return ["a1", "a2", "b1", "b2", "zp", "zs", "theta_z"]
        if self.family == "general":
            joints = [f"{t}_{k}_{a}" for t in PLATES for k in (1, 2, 3) for a in "xyz"]
            return [*joints, "zp", "zs", "theta_z"]
        need(self.family in ("symmetric", "symmetric_nonplanar"), "no family")
        names = [f"{t}_{what}" for t in PLATES for what in ("radius", "angle")]
        names = [n for n in names if n != "base_external_angle"] + ["zp", "zs"]
        return names + [f"{t}_height" for t in PLATES] * (self.family == "symmetric_nonplanar")


class Machines:
    """All machines of a box of designs, at boxes of poses: coordinates 0 to 5, 6 to 11, then the design."""

    def __init__(self, file, designs):
        self.file = file
        self.half = {}
        x = [Form(low) for _, low, _ in file.variables]
        for k, (low, high) in enumerate(designs):
            x[file.varied[k]] = self.coordinate(2 * POSE + k, low, high)
        value = dict(zip(file.names(), x, strict=True))
        self.zp, self.zs = value["zp"], value["zs"]
        self.plate = self._plate(value)
        q = about_z(value["theta_z"]) if "theta_z" in value else turn([Form(0)] * 3)
        point = [Form(w) for w in file.tool[:3]]
        axes = turn([Form(w) for w in file.tool[3:]])
        self.joint = list(self.plate)
        for k in range(6, 12):
            own = plus(self.plate[k], point, -1)
            self.joint[k] = [dot(axis, own) for axis in axes]
        self.home = (
            plus([Form(0), Form(0), self.zp], times(q, point)),
            [Form(0), Form(0), self.zs],
            [times(q, axis) for axis in axes],
        )

    def coordinate(self, k, low, high):
        middle = min(max(0.5 * low + 0.5 * high, low), high)
        self.half[k] = max((arb(high) - middle).abs_upper(), (arb(middle) - low).abs_upper())
        return Form(arb(low).union(arb(high)), {k: arb(1)}, arb(middle))

    def _plate(self, value):
        out = []

        def triple(first):
            for k in range(3):
                c, s = arb(-2 * k).__truediv__(3).cos_pi(), arb(-2 * k).__truediv__(3).sin_pi()
                out.append([first[0] * c - first[1] * s, first[0] * s + first[1] * c, first[2]])

        if self.file.family == "hexagonal":
            for a, b in (("a1", "a2"), ("b1", "b2")):
                x, y = value[a] * 0.5, (value[a] + value[b] * 2) * (-1 / (2 * arb(3).sqrt()))
                triple([x, y, Form(0)])
                triple([-x, y, Form(0)])
            return out
        if self.file.family == "general":
            return [[value[f"{t}_{k}_{a}"] for a in "xyz"] for t in PLATES for k in (1, 2, 3)]
        for t in PLATES:
            angle, height = value.get(f"{t}_angle", Form(0)), value.get(f"{t}_height", Form(0))
            triple([*scaled(value[f"{t}_radius"], about_z(angle)[0][:2]), height])
        return out

    def stand(self, piece, ends, first=0):
        """p, O and the columns of Q over a box of poses."""
        p, s, q = self.home
        if piece == -1:
            return p, s, q
        scale = self.zp if (self.file.in_zp if piece >= 0 else self.file.poses[-2 - piece][1]) else Form(1)
        if piece < -1:
            x = [Form(w) for w in self.file.poses[-2 - piece][0]]
            by, rest, own = x[:3], turn(x[3:6]), x[6:]
        else:
            x = [self.coordinate(first + k, *two) if two[0] < two[1] else Form(two[0]) for k, two in enumerate(ends)]
            by = x[:3]
            if self.file.shape == "path":
                a, b = ([arb(w) for w in self.file.corners[piece + k]] for k in (0, 1))
                by = [x[0] * (w - v) + v for v, w in zip(a, b, strict=True)]
            rest = turn([x[3], x[4], Form(0)])
            rest = [times(rest, column) for column in about_z(x[5])]
            own = by if self.file.shifted else [Form(0)] * 3
        moved = plus(p, scaled(scale, by)), plus(s, scaled(scale, own))
        return *moved, [times(rest, column) for column in q]

    def leg(self, at, k):
        p, s, q = at
        if k < 3:
            return self.joint[k], plus(p, times(q, self.joint[6 + k]))
        return (plus(p, times(q, self.joint[6 + k])) if k < 6 else self.joint[k - 3]), s

    def along(self, at, k):
        one, two = self.leg(at, k)
        return plus(two, one, -1)

    def determinant(self, at, which, units=False):
        rows = []
        for k in range(3):
            if which:
                rows.append(self.along(at, (0, 6, 3)[which] + k))
                rows[-1] = unit(rows[-1]) if units else rows[-1]
            else:
                ends = [plus(end, at[1], -1) for end in self.leg(at, k)]
                rows.append(cross(*map(unit, ends)) if units else cross(*ends))
        return dot(rows[0], cross(rows[1], rows[2]))


def middle(form):
    return float(form.at.mid())


def condition(m, at, most, kept):
    """Whether kappa <= most everywhere, or more than it: see `rows`. Positive where it is shown."""
    over, p = 1 / arb(m.file.length), at[0]

    def screw(leg, end):
        e = unit(m.along(at, leg))
        return e, scaled(over, cross(plus(end, p, -1), e)) + e

    external = [screw(k, m.leg(at, k)[1])[1] for k in range(3)]
    inner = [screw(k, at[1]) for k in range(3, 9)]
    signs = [1.0] * 3 + [0.0] * 3  # the platform's end of q moves with it, the base's end of r stands still
    # Rates of the nine legs: A t + B o, with the velocity o of O.
    a = [*external, *([x * s for x in row] for (_, row), s in zip(inner, signs, strict=True))]
    b = [[Form(0)] * 3] * 3 + [[x * (-1 if s else 1) for x in e] for (e, _), s in zip(inner, signs, strict=True)]
    fa, fb = (np.array([[middle(x) for x in row] for row in rows]) for rows in (a, b))
    best = -np.linalg.lstsq(fb, fa, rcond=None)[0]
    values, vectors = np.linalg.eigh((fa + fb @ best).T @ (fa + fb @ best))

    def rates(t, o):
        return [
            sum((x * float(w) for x, w in zip(row, t, strict=True)), Form(0))
            + sum((x * float(w) for x, w in zip(own, o, strict=True)), Form(0))
            for row, own in zip(a, b, strict=True)
        ]

    def square(x, y):
        return sum((u * w for u, w in zip(x, y, strict=True)), Form(0))

    def ball(form):
        low, high = form.ends(m.half)
        return arb(low).union(arb(high)) if low > -math.inf else arb("nan")

    by = [rates(vectors[:, k], best @ vectors[:, k]) for k in range(6)]  # an upper bound of t S t, any o being one
    columns = [[row[k] for row in b] for k in range(3)]
    if kept:
        mu = 0.5 * (values[5] + most * most * values[0])
        exact = [
            [sum((arb(x) * arb(y) for x, y in zip(*two, strict=True)), arb(0)) for two in row]
            for row in [[(u, w) for w in vectors.T] for u in vectors.T]
        ]  # floats are not quite orthogonal
        gram = [[ball(square(u, w)) for w in by] for u in by]
        upper = [[mu * exact[i][j] - gram[i][j] for j in range(6)] for i in range(6)]
        # K^2 [A B]^T [A B] - mu: its Schur complement is K^2 S - mu, and B^T B is positive.
        whole = by + columns
        lower = [[most * arb(most) * ball(square(u, w)) for w in whole] for u in whole]
        for i, j in np.ndindex(6, 6):
            lower[i][j] -= mu * exact[i][j]
        return min(dominant(upper), dominant(lower))
    x, y = by[5], by[0]
    slopes = [square(x, column) for column in columns]  # half the gradient of |A t + B o|^2 along o
    c = [[square(u, w) for u in columns] for w in columns]
    least = dot(c[0], cross(c[1], c[2])) * (1 / arb(9))  # of its eigenvalues, whose sum is six
    size = [sum((arb(w) ** 2 for w in vectors[:, k]), arb(0)) for k in (5, 0)]
    small = square(slopes, slopes) * least.inverse()
    return ball((square(x, x) - small) * size[1] - square(y, y) * size[0] * (arb(most) ** 2)).lower()


def dominant(matrix):
    """Positive if a symmetric matrix of balls is positive definite: diagonally dominant after a congruence."""
    n = len(matrix)
    near = np.array([[float(x.mid()) for x in row] for row in matrix])
    if not np.isfinite(near).all():
        return -math.inf
    values, v = np.linalg.eigh(near)
    w = [[arb(x) for x in row] for row in v / np.sqrt(np.abs(values) + 1e-300)]
    half = [[sum((row[k] * w[k][j] for k in range(n)), arb(0)) for j in range(n)] for row in matrix]
    turned = [[sum((w[k][i] * half[k][j] for k in range(n)), arb(0)) for j in range(n)] for i in range(n)]
    rows = (row[i] - sum((x.abs_upper() for j, x in enumerate(row) if j != i), arb(0)) for i, row in enumerate(turned))
    return min(float(x.lower()) if x.is_finite() else -math.inf for x in rows)


LEGS = {"leg_length": range(9), "external_length": range(3), "upper_length": range(3, 6), "lower_length": range(6, 9)}


class Want:
    """One number that has to be positive, of a limit: 0 singularities, 1 heights, from 2 on those of the file."""

    def __init__(self, limit, name, item, bound=0.0, high=True, line=None):
        self.limit, self.name, self.item, self.bound, self.high = limit, name, item, bound, high
        self.of_zp, self.neutral, self.axis = (line[3] == "zp", line[4], line[5]) if line else (False, limit == 1, None)
        self.poses = 2 if name in ("stroke", "stroke_ratio", "leg_ratio") else 1

    def forms(self, m, at, kept):
        """For every list there has to be a form that is positive; of pairs the forms are other ones if it is broken."""
        bound = m.zp * self.bound if self.of_zp else Form(self.bound)
        sign = 1 if self.high else -1
        if self.name == "height":
            return [[(bound - m.zp) * sign]]
        if self.name == "between":
            return [[m.zp - m.zs], [m.zs]]
        if self.name == "zs_fraction":
            return [[(m.zp * self.bound - m.zs) * sign]]
        if self.name in ("footprint", "radius_ratio"):
            radius = [(v[0] * v[0] + v[1] * v[1]).root() for v in m.plate]
            if self.name == "footprint":
                each = [[(bound - r) * sign] for r in radius[:6]]
                return each if self.high else [[one[0] for one in each]]
            if self.high:
                return [[r * self.bound - one for r in radius[6:]] for one in radius[:6]]
            return [[one - r * self.bound for one in radius[:6]] for r in radius[6:]]
        if self.name in ("no singularity", "singularity_free"):
            side = 1 if middle(m.determinant(m.home, self.item)) > 0.0 else -1
            home = [] if kept else [[-1 * side * m.determinant(m.home, self.item)]]  # of one sign in all designs
            return [[side * m.determinant(at[0], self.item, self.limit > 0) - self.bound], *home]
        if self.poses == 2:
            v, w = (dot(u, u).root() for u in (m.along(at[0], self.item[0]), m.along(at[1], self.item[1])))
            return [[w + bound - v if self.name == "stroke" else w * self.bound - v]]
        if self.name == "leg_clearance":
            return self._apart(m, at[0], bound, kept)
        v = m.along(at[0], self.item)
        if self.name in LEGS:
            return [[(bound * bound - dot(v, v)) * sign]]
        platform = self.name.startswith("platform")
        sense = -1 if platform and self.item < 3 else 1
        axis = [Form(x) for x in self.axis] if any(self.axis) else scaled(sense, m.along(m.home, self.item))
        if platform:
            own = axis if any(self.axis) else [dot(column, axis) for column in m.home[2]]
            axis = times(at[0][2], own)
        return [[dot(scaled(sense, unit(v)), unit(axis)) - arb(self.bound).cos()]]

    def _apart(self, m, at, bound, kept):
        legs = (self.item, (self.item + 1) % 3) if self.item < 3 else ((self.item - 3) // 6, 3 + (self.item - 3) % 6)
        (a, b), (c, d) = (m.leg(at, k) for k in legs)
        ends = [np.array([middle(x) for x in v]) for v in (a, b, c, d)]
        u, v, w = ends[1] - ends[0], ends[3] - ends[2], ends[0] - ends[2]
        s = t = 0.5
        for _ in range(60):  # where they are nearest, by turns
            s = float(np.clip((t * v - w) @ u / (u @ u), 0.0, 1.0))
            t = float(np.clip((s * u + w) @ v / (v @ v), 0.0, 1.0))
        one, two = (plus(p, scaled(x, plus(q, p, -1))) for p, q, x in ((a, b, s), (c, d, t)))
        gap = plus(two, one, -1)
        if not kept:
            return [[dot(gap, gap) - bound * bound]]
        n = np.array([middle(x) for x in gap])
        n = [arb(x) for x in n / (np.linalg.norm(n) * (1 + 1e-15) + 1e-300)]
        return [[sum(((q[k] - p[k]) * n[k] for k in range(3)), Form(0)) - bound] for p in (a, b) for q in (c, d)]


def wants_of(file):
    out = [Want(0, "no singularity", k) for k in range(3)] + [Want(1, "between", 0)]
    unknown = []
    for n, line in enumerate(file.limits):
        name, low, high = line[:3]
        upper = "cone" in name or name in ("stroke", "stroke_ratio", "leg_ratio", "condition_number")
        lower = name in ("leg_clearance", "singularity_free")
        sides = [(x, up) for x, up in ((low, False), (high, True)) if 0.0 < x < math.inf]
        if name not in KNOWN or any((upper and not up) or (lower and up) for _, up in sides) or line[3] == "radius":
            unknown.append(name)
            continue
        items = LEGS.get(name, [0])
        if "cone" in name:
            items = range(6) if name.startswith("platform") else (0, 1, 2, 6, 7, 8)
        elif name == "leg_clearance":
            items = [k for k in range(21) if k not in file.exempt]
        elif name == "singularity_free":
            items = range(3)
        elif name.startswith("stroke"):
            items = [(k, k) for k in range(9)]
        elif name == "leg_ratio":
            items = [(k // 9, k % 9) for k in range(81)]
        out += [Want(n + 2, name, item, bound, up, line) for bound, up in sides for item in items]
    return out, unknown


class Checker:
    def __init__(self, data):
        self.file = File(data)
        self.wants, self.unknown = wants_of(self.file)

    def roots(self, want):
        f = self.file
        if want.neutral or want.name in ("height", "zs_fraction", "footprint", "radius_ratio"):
            return [(-1, [(0.0, 0.0)] * POSE)]
        a, b, c, tilt, yaw = f.region
        sizes = {"ball": (a, a, a), "cylinder": (a, a, c), "path": (0.0, 0.0, 0.0)}.get(f.shape, (a, b, c))
        ends = [(-x, x) for x in (*sizes, tilt, tilt, yaw)]
        ends[0] = (0.0, 1.0) if f.shape == "path" else ends[0]
        out = [(k, ends) for k in range({"none": 0, "path": len(f.corners) - 1}.get(f.shape, 1))]
        out += [(-2 - k, [(0.0, 0.0)] * POSE) for k in range(len(f.poses))]
        return out + [(-1, [(0.0, 0.0)] * POSE)] * (want.limit == 0 or not out)

    def discs(self):
        first = {"ball": [(0, 3)], "cylinder": [(0, 2)]}.get(self.file.shape, [])
        return [(k, n, self.file.region[0]) for k, n in first] + [(3, 2, self.file.region[3])]

    def weigh(self, want, designs, spots, kept):
        """The bound that counts, and how far each coordinate moves it."""
        m = Machines(self.file, designs)
        at = [m.stand(piece, ends, POSE * k) for k, (piece, ends) in enumerate(spots)]
        if want.name == "condition_number":
            legs = [x for k in range(9) for x in m.along(at[0], k)]
            value = condition(m, at[0], want.bound, kept)
            out = float(value) if kept else -float(value)
        else:
            forms = want.forms(m, at, kept)
            legs = [x for one in forms for x in one]
            ends = [[x.ends(m.half) for x in one] for one in forms]
            if kept:
                out = min(max(float(low) for low, _ in one) for one in ends)
            elif want.name in ("no singularity", "singularity_free"):
                out = max(float(high) for one in ends for _, high in one)  # the side at home too
            else:
                out = min(max(float(high) for _, high in one) for one in ends)
        moves = dict.fromkeys(m.half, 0.0)
        for x in legs:
            for k, slope in x.slope.items():
                moves[k] += float(slope.abs_upper() * m.half[k]) if slope.is_finite() else 1e300
        return out, moves

    def kept(self, want, designs):
        spots = [[root] for root in self.roots(want)]
        if want.poses == 2:
            spots = [[*one, *two] for one in spots for two in spots]
        ahead = [(designs, spot) for spot in spots]
        for _ in range(CUTS):
            if not ahead:
                return True
            designs, spot = ahead.pop()
            if any(self.beside(*one) for one in spot):
                continue
            low, moves = self.weigh(want, designs, spot, True)
            if low > 0.0:
                continue
            if not moves or max(moves.values()) == 0.0:
                return False
            k = max(moves, key=moves.get)
            place, i = (designs, k - 2 * POSE) if k >= 2 * POSE else (spot[k // POSE][1], k % POSE)
            a, b = place[i]
            for half in ((a, 0.5 * a + 0.5 * b), (0.5 * a + 0.5 * b, b)):
                new = [*place[:i], half, *place[i + 1 :]]
                poses = [(p, new if place is ends else ends) for p, ends in spot]
                ahead.append((new if place is designs else designs, poses))
        return False

    def beside(self, piece, ends):
        near = [max(a, -b, 0.0) for a, b in ends]
        return piece >= 0 and any(math.hypot(*near[k : k + n]) > r * (1 + 1e-12) for k, n, r in self.discs())

    def drawn(self, want, pose):
        """The pose, or the nearest at which the limit holds."""
        for piece, ends in self.roots(want):
            if piece == pose[0]:
                x = [min(max(v, a), b) for v, (a, b) in zip(pose[1], ends, strict=True)]
                for k, n, r in self.discs() if piece >= 0 else []:
                    if (size := math.hypot(*x[k : k + n])) > r:
                        x[k : k + n] = [v * (r / size) * (1 - 1e-12) for v in x[k : k + n]]
                return piece, [(v, v) for v in x]
        raise Refused("a pose at which the limit does not hold")

    def broken(self, limit, designs, poses):
        wants = [w for w in self.wants if w.limit == limit]
        ahead = [designs]
        for _ in range(CUTS):
            if not ahead:
                return True
            box, total = ahead.pop(), {}
            for want in wants:
                spots = [self.drawn(want, pose) for pose in poses[: want.poses]] if want.limit != 1 else []
                high, moves = self.weigh(want, box, spots or [(-1, [(0.0, 0.0)] * POSE)], False)
                if high < 0.0:
                    break
                for k, x in moves.items():
                    total[k] = max(total.get(k, 0.0), x)
            else:
                if not total or not max(total.values()) > 0.0:
                    return False
                k = max(total, key=total.get) - 2 * POSE
                a, b = box[k]
                ahead += [[*box[:k], half, *box[k + 1 :]] for half in ((a, 0.5 * a + 0.5 * b), (0.5 * a + 0.5 * b, b))]
        return False

    def run(self):
        f = self.file
        whole = [f.variables[k][1:] for k in f.varied]
        m = Machines(f, whole)
        for pair in f.exempt:
            need(0 <= pair <= 20, "no pair of legs")
            a, b = (pair, (pair + 1) % 3) if pair < 3 else ((pair - 3) // 6, 3 + (pair - 3) % 6)
            two = [(a, b), (6 + a, 6 + b)] if b < 3 else [(6 + a, 6 + b)] if b < 6 else [(a, b - 3)]
            need(any(self.together(m, i, j) for i, j in two), "a pair of legs that is exempt shares no joint")
        self.divides(whole)
        done, missing = {"inside": Fraction(0), "outside": Fraction(0), "undecided": Fraction(0)}, len(self.unknown)
        for ends, state, limit, poses in f.boxes:
            done[state] += volume(ends) / volume(whole)
            if state == "inside":
                missing += not all(self.kept(want, ends) for want in self.wants)
            elif state == "outside":
                n = int(limit[0])
                need(0 <= n < 2 + len(f.limits), "no limit")
                missing += not self.broken(n, ends, poses)
        for share, said in zip(done.values(), f.shares, strict=True):
            need(abs(float(share) - said) <= 1e-9, "the shares are not those of the boxes")
        return missing == 0

    def together(self, m, i, j):
        size = math.hypot(*(middle(x) for x in m.plate[i]))
        ends = [x.ends(m.half) for x in plus(m.plate[i], m.plate[j], -1)]
        return all(max(abs(float(low)), abs(float(high))) <= 1e-12 * size for low, high in ends)

    def divides(self, whole):
        """Boxes within the whole, no two of which overlap, that have its volume."""
        f = self.file
        low, high = (np.array([[e[k] for e in ends] for ends, *_ in f.boxes]) for k in (0, 1))
        for n in range(len(low)):
            need(all(a <= c < d <= b for (a, b), (c, d) in zip(whole, f.boxes[n][0], strict=True)), "a box is outside")
            meets = ((low[n] < high) & (low < high[n])).all(axis=1)
            need(meets.sum() == 1, "two boxes overlap")
        need(sum(volume(ends) for ends, *_ in f.boxes) == volume(whole), "a box is missing")


def volume(ends):
    return math.prod((Fraction(b) - Fraction(a) for a, b in ends), start=Fraction(1))


def check(data):
    """Return "proved", "incomplete" or why the file is refused."""
    ctx.prec = 80
    try:
        return "proved" if Checker(data).run() else "incomplete"
    except Refused as error:
        return f"refused: {error}"
