"""What each limit of a certificate asks of machines in balls, by formulas from their definitions.

Margins are a list of forms: a limit is kept if all are positive, broken if one is negative. Some have two lists, one
for each purpose.
"""

import math
from itertools import combinations, product

import numpy as np
from balls import balls, cross, det, dot, solve, stack
from flint import arb

KINDS = {"external": slice(0, 3), "upper": slice(3, 6), "lower": slice(6, 9)}
# Pairs of legs that may meet: 0 to 2 external ones, then each external one with the six internal ones.
PAIRS = np.array([(0, 1), (1, 2), (2, 0), *product(range(3), range(3, 9))])
SPACED = np.array(list(combinations(range(6), 2)))
LOCKED = 4.0
LENGTH, DUTY = "<> zp", ("force", "rate", "power")


class Want:
    """One side of a limit: 0 singularities, 1 heights, from 2 on those of the file."""

    def __init__(self, limit, name, bound=0.0, side=">", line=("length", "poses", 0.0, 0.0, 0.0)):
        self.limit, self.name, self.bound, self.sign = limit, name, bound, 1 if side == "<" else -1
        self.of, at, *self.axis = line
        _, self.poses, self.margins = LIMITS[name]
        self.neutral = at == "neutral" or self.poses == 0


def wants_of(file):
    """All wants, and the names of limits that are not known."""
    wants, unknown = [] if file.space else [Want(0, "regular"), Want(1, "between")], []
    for n, (name, low, high, *line) in enumerate(file["limit"]):
        sides, poses, _ = LIMITS.get(name, ("", 1, None))
        asked = [(low, ">")] * (low > 0.0) + [(high, "<")] * (high < math.inf)
        known = sides and line[0] in ("length", *sides.split()[1:])
        known = known and not (file.space and (poses, *line[:2]) != (1, "length", "poses"))
        if known and all(0.0 < x < math.inf and side in sides for x, side in asked):
            wants += [Want(n + 2, name, x, side, line) for x, side in asked]
            wants += [Want(n + 2, "regular")] * (file.space and name == "singularity_free")
        else:
            unknown.append(name)
    if any(name.split("_")[-1] in DUTY for name, *_ in file["limit"]):
        file.need_duty()
    return wants, unknown


def bound_of(w, m):
    return m.zp * w.bound if w.of == "zp" else w.bound


def plain(value, sides="<", poses=1):
    """A number, or some, that must be on one side of the bound."""

    def margins(w, m, kept):
        return ((bound_of(w, m) - value(w, m)) * w.sign).reshape(-1)

    return sides, poses, margins


def lengths(legs):
    return plain(lambda w, m: m.at[0].length[legs], LENGTH)


def determinants(w, m, kept):
    """Each has the sign that it has at home, which is not 0 if singularities are a limit there too."""
    at, home = (one.triples(w.name != "regular") for one in (m.at[0], m.home))
    if not kept:
        return home * at - abs(home) * w.bound
    return at * np.array([x.sgn() for x in home.x[:, 0]]) - w.bound


def radii(joints):
    return joints[:, :2].norm()


def joint_height(w, m):
    z = m.plate[:, 2]
    most = stack([z, -z], np.concatenate).max()
    return most / radii(m.plate).max() if w.of == "radius" else most


def joint_spacing(w, m):
    out = []
    for joints in (m.plate[:6], m.plate[6:]):
        apart = (joints[SPACED[:, 0]] - joints[SPACED[:, 1]]).norm()
        out.append(apart / radii(joints).max()[None] if w.of == "radius" else apart)
    return stack(out)


def clearance(w, m, kept):
    """Along the direction between the nearest points in the middle; two points that are nearer break it."""
    bound = bound_of(w, m)
    first, second = PAIRS[[k for k in range(21) if k not in m.file.exempt]].T
    (a, u), (c, v) = ((m.at[0].start[k], m.at[0].along[k]) for k in (first, second))
    s, t = nearest(*(x.middle for x in (a, u, c, v)))
    gap = c + v * t - a - u * s
    if not kept:
        return gap.norm() - bound
    n = gap.middle
    n = n / (np.linalg.norm(n, axis=1, keepdims=True) * (1 + 1e-15) + 1e-300)
    return stack([dot(two - one, n) - bound for one in (a, a + u) for two in (c, c + v)]).reshape(-1)


def nearest(a, u, c, v):
    """Places on segments where they are nearest, by turns."""
    s = t = np.full((len(a), 1), 0.5)
    for _ in range(60):
        s = np.clip(((c + t * v - a) * u).sum(1, keepdims=True) / (u * u).sum(1, keepdims=True), 0.0, 1.0)
        t = np.clip(((a + s * u - c) * v).sum(1, keepdims=True) / (v * v).sum(1, keepdims=True), 0.0, 1.0)
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
            axis = (m.none + w.axis).unit()
        return dot(seen, axis) - (arb(w.bound).cos() if w.bound < math.pi else arb(-2))

    return "<", 1, margins


def condition(w, m, kept, locked=None):
    """Of S, the squares of the rates for a twist with O free: rates are A t + B o with the velocity o of O.

    The rate of a locked leg is 0: for an upper bound O gives way along it, for a lower one it counts a few times.
    """
    (length,), rates = m.file["characteristic_length"], m.at[0].rates
    twists, inner = rates[:, :6] * np.array([1] * 3 + [1 / arb(length)] * 3, object), rates[:, 6:]
    weight = np.array([[LOCKED if k == locked else 1.0] for k in range(9)])
    twists, inner = twists * weight, inner * weight
    a, b = twists.middle, inner.middle
    best = -np.linalg.lstsq(b, a, rcond=None)[0]
    vectors = np.linalg.eigh((a + b @ best).T @ (a + b @ best))[1]
    # Columns, of which t S t is at most the squares: those of any o are.
    by = most = (twists @ vectors + inner @ (best @ vectors)).tight(m.half)
    if locked is not None:
        most = by - inner @ (inner[locked][:, None] * by[locked][None]) * LOCKED**-2
    if not kept:
        return broken_condition(
            w, by[:, 5], most[:, 0], inner, (weight**2)[3:].sum(), *(balls(vectors[:, k]) for k in (5, 0))
        )
    mu = (dot(most[:, 5], most[:, 5]) + dot(by[:, 0], by[:, 0]) * arb(w.bound) ** 2) * 0.5
    exact = mu * (balls(vectors).T @ balls(vectors))  # floats are not quite orthogonal
    # K^2 [A B]^T [A B] - mu: its Schur complement is K^2 S - mu, and B^T B is positive.
    whole = stack([by.T, inner.T], np.concatenate)
    lower = (whole @ whole.T) * arb(w.bound) ** 2
    lower.x[:6, :6] -= exact.x
    return stack([dominant(exact - most.T @ most), dominant(lower)], np.concatenate)


def fault_tolerance(w, m, kept):
    return stack([condition(w, m, kept, locked) for locked in range(3, 9)], np.concatenate)


def broken_condition(w, x, y, inner, trace, u, v):
    slopes = dot(inner.T, x)  # half the gradient of |A t + B o|^2 along o
    c = inner.T @ inner
    least = det(c) * (4 / arb(trace) ** 2)  # of its eigenvalues, by their product and sum
    small = dot(slopes, slopes) / least
    return (dot(y, y) * (arb(w.bound) ** 2 * (u @ u)) - (dot(x, x) - small) * (v @ v))[None]


def dominant(matrix):
    """Positive if a symmetric matrix is positive definite: diagonally dominant after a congruence."""
    values, v = np.linalg.eigh(np.nan_to_num(matrix.middle))
    v = v / np.sqrt(np.abs(values) + 1e-300)
    turned, own = (matrix @ v).T @ v, np.eye(len(v))
    return (turned * own - abs(turned * (1 - own))).sum(0)


def duty(quantity, legs):
    """The greatest modulus of the force of some legs, their greatest rate, or the product."""

    def value(w, m):
        force = 1.0 if quantity == "rate" else abs(forces(m.file, m.at[0]))
        rate = 1.0 if quantity == "force" else rates(m.file, m.at[0])[:, None]
        return (rate * force)[legs]

    return plain(value)


def forces(file, at):
    """Of the nine legs for each load, from the balance of platform and O: no internal leg has a moment about O."""
    weights, (turning, pushing, on_o) = balls(file["weights"]), balls(file["load"]).reshape(-1, 3, 3).swapaxes(0, 1)
    cylinder, at_cylinder, rod, at_rod = balls(file["leg"]).T[:, :, None]
    g, mass, centre, mass_of_o = weights[:3], weights[3], weights[4:7], weights[7]
    e, ends, p = at.unit, at.end[:3] - at.s, at.p - at.s
    across = (g - e * dot(e, g)[:, None]) / at.length[:, None]
    by_end = across * (cylinder * at_cylinder - rod * at_rod) + rod * g  # as a lever; along the leg each part by itself
    by_start = (cylinder + rod) * g - by_end
    moment = cross(ends, by_end[:3]).sum(0) + cross(at.start[3:6] - at.s, by_start[3:6]).sum(0)
    moment = moment + cross(p + dot(at.q, centre), mass * g) + cross(p, pushing) + turning
    external = solve(cross(ends, e[:3]).T, -moment.T)
    force = (by_end[:3].sum(0) + by_start[3:6].sum(0) + mass * g + pushing).T + e[:3].T @ external
    of_o = (by_end[3:].sum(0) + mass_of_o * g + on_o).T
    return stack([external, solve(e[3:6].T, force), solve(e[6:].T, -(of_o + force))], np.concatenate)


def rates(file, at):
    """The greatest over all directions of both speeds: of each leg V |a| + W |b| where its rate is a p' + b w."""
    linear, angular, rule = file["speeds"]
    rows, inner = at.rates[:, :6], at.rates[:, 6:]
    if rule == "least":
        rows = rows - inner @ solve(inner.T @ inner, inner.T @ rows)
    elif rule != "held":  # O moves as the platform does, or shifts with it
        rows = rows + at.screw(inner, at.s) * np.array([1] * 3 + [rule == "carried"] * 3)
    return rows[:, :3].norm() * linear + rows[:, 3:].norm() * angular


LIMITS = {  # the sides that a limit can have and its units, the number of poses, the margins
    "regular": ("", 1, determinants),
    "between": ("", 0, lambda w, m, kept: stack([m.zp - m.zs, m.zs])),
    "singularity_free": (">", 1, determinants),
    "condition_number": ("<", 1, condition),
    "fault_tolerant": ("<", 1, fault_tolerance),
    "leg_clearance": ("> zp", 1, clearance),
    "height": plain(lambda w, m: m.zp, "<>", 0),
    "zs_fraction": plain(lambda w, m: m.zs / m.zp, "<>", 0),
    "footprint": plain(lambda w, m: radii(m.plate[:6]).max(), LENGTH, 0),
    "radius_ratio": plain(lambda w, m: radii(m.plate[:6]).max() / radii(m.plate[6:]).max(), "<>", 0),
    "joint_height": plain(joint_height, "< radius", 0),
    "joint_spacing": plain(joint_spacing, "> radius", 0),
    "stroke": plain(lambda w, m: m.at[0].length - m.at[1].length, "< zp", 2),
    "stroke_ratio": ("<", 2, lambda w, m, kept: m.at[1].length * w.bound - m.at[0].length),
    "leg_ratio": ("<", 2, lambda w, m, kept: (m.at[1].length[:, None] * w.bound - m.at[0].length).reshape(-1)),
    "leg_length": lengths(slice(0, 9)),
    **{f"{kind}_length": lengths(legs) for kind, legs in KINDS.items()},
    **{f"{leg}{k + 1}": lengths([3 * n + k]) for n, leg in enumerate("lqr") for k in range(3)},
    **{name: duty(name, slice(0, 9)) for name in DUTY},
    **{f"{kind}_{name}": duty(name, legs) for name in DUTY[:2] for kind, legs in KINDS.items()},
    **{
        f"{body}_cone{kind}": cone(body, legs)
        for body in ("base", "platform")
        for kind, legs in (("", range(6)), ("_external", range(3)), ("_internal", range(3, 6)))
    },
}
