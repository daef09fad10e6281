"""What each limit of a certificate asks of machines in balls, by formulas from their definitions.

Margins are a table of forms: a limit is kept if every row has a positive one, broken if a row has negative ones only.
"""

import math
from itertools import combinations, product

import numpy as np
from balls import balls, cross, dot, solve, stack
from flint import arb

KINDS = {"external": slice(0, 3), "upper": slice(3, 6), "lower": slice(6, 9)}
# Pairs of legs that may meet: 0 to 2 external ones, then each external one with the six internal ones.
PAIRS = np.array([(0, 1), (1, 2), (2, 0), *product(range(3), range(3, 9))])
SPACED = np.array(list(combinations(range(6), 2)))


class Want:
    """One side of a limit: 0 singularities, 1 heights, from 2 on those of the file."""

    def __init__(self, limit, name, bound=0.0, high=False, line=None):
        self.limit, self.name, self.bound, self.sign = limit, name, bound, 1 if high else -1
        self.of, at, self.axis = line[3:] if line else ("length", "poses", [0.0] * 3)
        self.sides, self.poses, self.margins = LIMITS[name]
        self.neutral = at == "neutral" or self.poses == 0

    def bound_of(self, m):
        """The bound in the unit of the study."""
        return m.zp * self.bound if self.of == "zp" else self.bound


def wants_of(file):
    """All wants, and the names of limits that are not known."""
    wants, unknown = [Want(0, "regular"), Want(1, "between")], []
    for n, line in enumerate(file.limits):
        name, low, high, of = line[:4]
        sides = LIMITS.get(name, [""])[0]
        asked = [(low, ">")] * (low > 0.0) + [(high, "<")] * (high < math.inf)
        if all(0.0 < x < math.inf and side in sides for x, side in asked) and (of == "length" or of in sides):
            wants += [Want(n + 2, name, x, side == "<", line) for x, side in asked]
        else:
            unknown.append(name)
    return wants, unknown


def duty_of(name):
    """Whether a limit is one of forces, rates or powers."""
    return name.split("_")[-1] in DUTY


def plain(value, sides="<", poses=1):
    """Numbers that must be on one side of the bound."""

    def margins(w, m, kept):
        return ((w.bound_of(m) - value(w, m)) * w.sign)[:, None]

    return sides, poses, margins


def determinants(w, m, kept):
    """The sign at home, also over all designs where another one breaks it."""
    units = w.name != "regular"
    home = m.home.triples(units)
    side = np.where(home.middle > 0.0, 1.0, -1.0)
    margins = m.at[0].triples(units) * side - w.bound
    return stack([margins] if kept else [margins, -home * side]).T


def radii(m):
    return m.plate[:, :2].norm()


def footprint(w, m, kept):
    margins = (w.bound_of(m) - radii(m)[:6]) * w.sign
    return margins[:, None] if w.sign > 0 else margins[None, :]


def radius_ratio(w, m, kept):
    r = radii(m)
    margins = (r[6:][None, :] * w.bound - r[:6][:, None]) * w.sign
    return margins if w.sign > 0 else margins.T


def joint_height(w, m, kept):
    most = radii(m)[None, :] if w.of == "radius" else m.none + np.ones((1, 1))
    return most * w.bound_of(m) - abs(m.plate[:, 2])[:, None]


def joint_spacing(w, m, kept):
    out = []
    for joints in (m.plate[:6], m.plate[6:]):
        apart = (joints[SPACED[:, 0]] - joints[SPACED[:, 1]]).norm()[:, None]
        least = joints[:, :2].norm() if w.of == "radius" else m.none + np.ones(6)
        out.append(apart - least * w.bound_of(m))
    # At least the bound times the greatest radius: every radius counts by itself.
    return stack(out, np.concatenate).reshape(-1, 1)


def stroke(w, m, kept):
    long, short = (at.length for at in m.at)
    return (short + w.bound_of(m) - long)[:, None]


def stroke_ratio(w, m, kept):
    long, short = (at.length for at in m.at)
    return (short * w.bound - long)[:, None]


def leg_ratio(w, m, kept):
    long, short = (at.length for at in m.at)
    return (short[:, None] * w.bound - long).reshape(81, 1)


def clearance(w, m, kept):
    """Along the direction between the nearest points in the middle; two points that are nearer break it."""
    bound = w.bound_of(m)
    first, second = PAIRS[[k for k in range(21) if k not in m.file.exempt]].T
    (a, u), (c, v) = ((m.at[0].start[k], m.at[0].along[k]) for k in (first, second))
    s, t = nearest(*(x.middle for x in (a, u, c, v)))
    gap = c + v * t - a - u * s
    if not kept:
        return (gap.norm() - bound)[:, None]
    n = gap.middle
    n = n / (np.linalg.norm(n, axis=1, keepdims=True) * (1 + 1e-15) + 1e-300)
    between = [dot(two - one, n) - bound for one in (a, a + u) for two in (c, c + v)]
    return stack(between, np.concatenate)[:, None]


def nearest(a, u, c, v):
    """Places on segments where they are nearest, by turns."""
    s = t = np.full((len(a), 1), 0.5)

    def along(x, y):
        return (x * y).sum(axis=1, keepdims=True)

    for _ in range(60):
        s = np.clip(along(c + t * v - a, u) / along(u, u), 0.0, 1.0)
        t = np.clip(along(a + s * u - c, v) / along(v, v), 0.0, 1.0)
    return s, t


def cone(body, joints):
    """Cosines beside that of the limit. Directions point away from the joint; axes turn with their body."""

    def margins(w, m, kept):
        at, legs = m.at[0], np.array(joints) if body == "platform" else np.array(joints) + 3 * (np.array(joints) > 2)
        away = np.where((legs < 3) & (body == "platform"), -1.0, 1.0)[:, None]
        seen, axis = at.unit[legs] * away, m.home.unit[legs] * away
        if body == "platform":
            seen, axis = seen @ at.q, axis @ m.home.q
        if any(w.axis):
            axis = m.none + w.axis
            axis = (axis / axis.norm()[None])[None, :]
        most = arb(w.bound).cos() if w.bound < 3.14 else arb(-2)
        return (dot(seen, axis) - most)[:, None]

    return "<", 1, margins


def condition(w, m, kept):
    """Of S, the squares of the rates for a twist with O free: rates are A t + B o with the velocity o of O."""
    at, over = m.at[0], 1 / arb(m.file.length)
    twists = stack([at.screw(at.unit[:3], at.end[:3]), -at.screw(at.unit[3:6], at.s), at.screw(at.unit[6:] * 0, at.s)])
    twists = twists.reshape(9, 6) * np.array([1] * 3 + [over] * 3, object)
    inner = stack([at.unit[:3] * 0, at.unit[3:]], np.concatenate)
    a, b = twists.middle, inner.middle
    best = -np.linalg.lstsq(b, a, rcond=None)[0]
    values, vectors = np.linalg.eigh((a + b @ best).T @ (a + b @ best))
    by = twists @ vectors + inner @ (best @ vectors)  # columns; an upper bound of t S t, any o being one
    if not kept:
        return broken_condition(w, by[:, 5], by[:, 0], inner, *(balls(vectors[:, k]) for k in (5, 0)))
    mu = 0.5 * (values[5] + w.bound**2 * values[0])
    exact = balls(vectors).T @ balls(vectors) * mu  # floats are not quite orthogonal
    # K^2 [A B]^T [A B] - mu: its Schur complement is K^2 S - mu, and B^T B is positive.
    whole = stack([by.T, inner.T], np.concatenate)
    part = np.full((9, 9), arb(0))
    part[:6, :6] = exact
    upper, lower = exact - by.T @ by, (whole @ whole.T) * arb(w.bound) ** 2 - part
    return stack([dominant(upper), dominant(lower)], np.concatenate)[:, None]


def broken_condition(w, x, y, inner, u, v):
    slopes = dot(inner.T, x)  # half the gradient of |A t + B o|^2 along o
    c = inner.T @ inner
    least = dot(c[0], cross(c[1], c[2])) * (arb(1) / 9)  # of its eigenvalues, whose sum is six
    small = dot(slopes, slopes) / least
    margin = dot(y, y) * (arb(w.bound) ** 2 * (u @ u)) - (dot(x, x) - small) * (v @ v)
    return margin[None, None]


def dominant(matrix):
    """Positive if a symmetric matrix is positive definite: diagonally dominant after a congruence."""
    near = np.nan_to_num(matrix.middle)
    values, v = np.linalg.eigh(near)
    v = v / np.sqrt(np.abs(values) + 1e-300)
    turned = (matrix @ v).T @ v
    own = np.eye(len(near))
    return (turned * own - abs(turned * (1 - own))).sum(0)


def duty(quantity, legs):
    """The greatest modulus of the force of some legs, their greatest rate, or the product."""

    def value(w, m):
        force = 1.0 if quantity == "rate" else abs(forces(m.file, m.at[0]))
        rate = 1.0 if quantity == "force" else rates(m.file, m.at[0])[None, :]
        return (rate * force)[:, legs].reshape(-1)

    return plain(value)


def forces(file, at):
    """Of the nine legs for each load, from the balance of platform and O: no internal leg has a moment about O."""
    e, g, mass, centre, mass_of_o = at.unit, file.gravity, file.masses[0], file.masses[1:4], file.masses[4]
    cylinder, at_cylinder, rod, at_rod = (column[:, None] for column in file.legs.T)
    across = (g - e * dot(e, g)[:, None]) / at.length[:, None]
    by_end = across * (cylinder * at_cylinder - rod * at_rod) + rod * g  # as a lever; along the leg each part by itself
    by_start = (cylinder + rod) * g - by_end
    ends, starts, p = at.end[:3] - at.s, at.start[3:6] - at.s, at.p - at.s
    moment = (
        cross(ends, by_end[:3]).sum(0) + cross(starts, by_start[3:6]).sum(0) + cross(p + dot(at.q, centre), mass * g)
    )
    force = by_end[:3].sum(0) + by_start[3:6].sum(0) + mass * g + file.loads[:, 3:6]
    external = solve(cross(ends, e[:3]), -(moment + file.loads[:, :3] + cross(p, file.loads[:, 3:6])))
    force = force + external @ e[:3]
    of_o = by_end[3:].sum(0) + mass_of_o * g + file.loads[:, 6:]
    return stack([external.T, solve(e[3:6], force).T, solve(e[6:], -(of_o + force)).T], np.concatenate).T


def rates(file, at):
    """The greatest over all directions of both speeds: of each leg V |a| + W |b| where its rate is a p' + b w."""
    linear, angular, rule = file.speeds
    upper, lower = at.unit[3:6], at.unit[6:]
    if rule == "shifted":
        still = np.array([[0] * 3 + [1] * 3])
        upper, lower = -at.screw(upper, at.s) * still, at.screw(lower, at.s) * (1 - still)
    else:  # O moves by `share` of what the point of the platform at O does
        share = {"held": np.zeros((3, 3)), "carried": np.eye(3)}.get(rule)
        if rule == "least":
            c = upper.T @ upper
            share = solve(c + lower.T @ lower, c).T
        upper, lower = at.screw(upper @ (share - np.eye(3)), at.s), at.screw(lower @ share, at.s)
    rows = stack([at.screw(at.unit[:3], at.end[:3]), upper, lower], np.concatenate)
    return rows[:, :3].norm() * linear + rows[:, 3:].norm() * angular


LENGTH, DUTY = "<> zp", ("force", "rate", "power")
LIMITS = {  # the sides that a limit can have and its units, the number of poses, the margins
    "regular": ("", 1, determinants),
    "between": ("", 0, lambda w, m, kept: stack([m.zp - m.zs, m.zs])[:, None]),
    "singularity_free": (">", 1, determinants),
    "condition_number": ("<", 1, condition),
    "leg_length": plain(lambda w, m: m.at[0].length, LENGTH),
    "height": plain(lambda w, m: m.zp[None], "<>", 0),
    "zs_fraction": ("<>", 0, lambda w, m, kept: ((m.zp * w.bound - m.zs) * w.sign)[None, None]),
    "footprint": (LENGTH, 0, footprint),
    "radius_ratio": ("<>", 0, radius_ratio),
    "joint_height": ("< radius", 0, joint_height),
    "joint_spacing": ("> radius", 0, joint_spacing),
    "stroke": ("< zp", 2, stroke),
    "stroke_ratio": ("<", 2, stroke_ratio),
    "leg_ratio": ("<", 2, leg_ratio),
    "leg_clearance": ("> zp", 1, clearance),
    **{name: duty(name, slice(0, 9)) for name in DUTY},
    **{f"{kind}_{name}": duty(name, legs) for name in DUTY[:2] for kind, legs in KINDS.items()},
    **{f"{kind}_length": plain(lambda w, m, legs=legs: m.at[0].length[legs], LENGTH) for kind, legs in KINDS.items()},
    **{
        f"{body}_cone{kind}": cone(body, legs)
        for body in ("base", "platform")
        for kind, legs in (("", range(6)), ("_external", range(3)), ("_internal", range(3, 6)))
    },
}
