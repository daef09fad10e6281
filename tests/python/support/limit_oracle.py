"""Every limit from its definition, in numpy: values and margins of one design at a time.

Shares with the core the joints and configurations of a study, which design_oracle.py holds against numpy;
test_limit_oracle.py holds it against numbers done by hand.
"""

import math
from dataclasses import dataclass, replace
from itertools import combinations

import duty_oracle
import numpy as np
from scipy.spatial.transform import Rotation

import ninedof as nd

MOST_PAIRED = 100  # poses; for more, all pairs of lengths would need too much memory


@dataclass(frozen=True, eq=False)
class Robot:
    """A design with all configurations of its study."""

    geometry: nd.Geometry
    neutral: nd.Configuration
    poses: nd.Configuration  # those of the objective, shape (n,)
    length: float  # the characteristic length
    apart: np.ndarray  # pairs of legs (0 to 8: l, q, r) without a common joint, shape (k, 2)

    def joints(self, body):
        """The six joints of "base" or "platform" in that body's frame, external first, shape (6, 3)."""
        g = self.geometry
        both = (g.base_external, g.base_internal) if body == "base" else (g.platform_external, g.platform_internal)
        return np.vstack(both)

    def ends(self, c):
        """Where the legs l (base to platform), q (platform to O), r (base to O) start and end, each (..., 9, 3)."""
        g, p, o = self.geometry, c.position[..., None, :], c.internal_point[..., None, :]
        turned = np.swapaxes(c.rotation, -1, -2)
        external, internal = p + g.platform_external @ turned, p + g.platform_internal @ turned
        base = np.broadcast_to(np.stack([g.base_external, g.base_internal]), (*c.shape, 2, 3, 3))
        centre = np.broadcast_to(o, external.shape)
        start = np.concatenate([base[..., 0, :, :], internal, base[..., 1, :, :]], axis=-2)
        return start, np.concatenate([external, centre, centre], axis=-2)


def robot_of(study, variables):
    """The robot of a full set of variables of a study."""
    problem = study.problem()
    x = np.array([variables[name] for name in problem.names])
    every = nd.Configuration(*problem.configurations(x))
    length = study.characteristic_length
    length = problem.characteristic_length(x) if isinstance(length, str | tuple) else length
    # Joints that coincide here and in a nearby design are one.
    fixed = [not isinstance(study.variables.get(name, (0, 1)), tuple) for name in problem.names]
    step = np.where(np.arange(len(x)) % 2, 0.01, 0.02) * np.hypot(x, length)
    both = [problem.geometry(v.tolist()) for v in (x, np.where(fixed, x, x + step))]
    apart = [pair for pair in combinations(range(9), 2) if not all(_meet(g, *pair) for g in both)]
    return Robot(both[0], every[0], every[1:] if len(every) > 1 else every, length, np.array(apart))


def _meet(g, one, other):
    """Whether two legs share O or a joint; the first comes earlier in the order l, q, r."""
    if one >= 3:
        return True
    base = [g.base_external[one], g.base_external[other] if other < 3 else g.base_internal[other - 6], g.base_external]
    platform = g.platform_external[one], (*g.platform_external, *g.platform_internal)[other % 6], g.platform_external
    at = [base, platform] if other < 3 else [platform] if other < 6 else [base]
    return any(np.linalg.norm(a - b) <= 1e-9 * np.abs(body).max() for a, b, body in at)


# --- Limits -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Limit:
    """One constraint with its limits and options, angles in radians."""

    name: str
    low: float = 0.0
    high: float = math.inf
    of: str = "length"
    axis: tuple[float, ...] = ()
    steps: int = 4
    at: str = "poses"
    study: nd.Study | None = None  # of loads, masses and speeds

    @property
    def label(self):
        return f"{self.name} at neutral" if self.at == "neutral" else self.name


def limits_of(study):
    axes = (tuple(study.limit_for_core(one).axis.tolist()) if one.axis else () for one in study.limits)
    return [Limit(**vars(one) | {"axis": axis, "study": study}) for one, axis in zip(study.limits, axes, strict=True)]


def margins(limit, robot):
    """Every margin of a limit: what is left of it in parts of it, negative if violated."""
    upper, lower = RULES[limit.name]
    robot, is_sign, out = _where(limit, robot), limit.name == "singularity_free", []
    if math.isfinite(limit.high) and upper is not None:
        out.append(1.0 - upper(robot, limit) / limit.high)
    if lower is not None and (limit.low > 0.0 or is_sign):
        values = lower(robot, limit)
        out.append(values - limit.low if is_sign else values / limit.low - 1.0)
    return np.concatenate(out) if out else np.empty(0)


def measured(limit, robot):
    """The least `max` of a limit that allows this robot."""
    return float(RULES[limit.name][0](_where(limit, robot), limit).max())


def _where(limit, robot):
    c = robot.neutral
    here = nd.Configuration(c.position[None], c.rotation[None], c.internal_point[None])
    return replace(robot, poses=here) if limit.at == "neutral" else robot


def _legs(robot):
    start, end = robot.ends(robot.poses)
    return np.linalg.norm(end - start, axis=-1).reshape(-1, 9)


def _radii(robot, body):
    return np.linalg.norm(robot.joints(body)[:, :2], axis=-1)


def _height(robot):
    return float(robot.neutral.position[2])


def _unit(robot, limit):
    return _height(robot) if limit.of == "zp" else 1.0


def _some_joints(body, legs):
    """The angles of the external or the internal legs of a body alone."""
    return lambda r, limit: cone(r, body, limit.axis).reshape(-1, 6)[:, legs].reshape(-1)


def _some_legs(first, last):
    return (lambda r, limit: _legs(r)[:, first:last].reshape(-1) / _unit(r, limit),) * 2


def _between_poses(robot):
    """Lengths that broadcast to all pairs of poses, (n, n, 9), or beside the least for very many poses."""
    legs = _legs(robot)
    return legs[:, None], legs[None, :] if len(legs) <= MOST_PAIRED else legs.min(axis=0)[None, None]


def _stroke(robot, limit):
    long, short = _between_poses(robot)
    return (long - short).reshape(-1) / _unit(robot, limit)


def _stroke_ratio(robot, limit):
    long, short = _between_poses(robot)
    return (long / short).reshape(-1)


def _leg_ratio(robot, limit):
    legs = _legs(robot)
    return np.array([legs.max() / legs.min()])


def _joint_height(robot, limit):
    heights = np.abs([robot.joints(body)[:, 2] for body in ("base", "platform")]).reshape(-1)
    largest = max(_radii(robot, "base").max(), _radii(robot, "platform").max())
    return heights / (largest if limit.of == "radius" else 1.0)


def _joint_spacing(robot, limit):
    out = []
    for body in ("base", "platform"):
        apart = np.array([np.linalg.norm(a - b) for a, b in combinations(robot.joints(body), 2)])
        out.append(apart / (_radii(robot, body).max() if limit.of == "radius" else 1.0))
    return np.concatenate(out)


def _leg_clearance(robot, limit):
    start, end = robot.ends(robot.poses)
    first, second = robot.apart.T
    apart = between_segments(start[:, first], end[:, first], start[:, second], end[:, second])
    return apart.reshape(-1) / _unit(robot, limit)


def _fault_tolerant(robot, limit):
    """Condition numbers of the rates to twists with one internal leg at rest, by singular values of eight columns."""
    c = robot.poses
    rates = np.stack([nd.inverse_velocity(robot.geometry, c, *m.reshape(3, 3)) for m in np.eye(9)], axis=-1)
    j = np.linalg.inv(rates)[..., :6, :] * np.array([robot.length] * 3 + [1.0] * 3)[:, None]
    sigma = [np.linalg.svd(np.delete(j, leg, axis=-1), compute_uv=False) for leg in range(3, 9)]
    return np.concatenate([(s[..., 0] / s[..., 5]).reshape(-1) for s in sigma])


def _of_duty(*numbers, legs=slice(0, 9)):
    """Products of forces and rates of some legs at every pose."""

    def at_poses(robot, limit):
        poses = [robot.poses[k] for k in range(len(robot.poses))]
        of_poses = [[one(limit.study, robot.geometry, c) for one in numbers] for c in poses]
        return np.prod(of_poses, axis=1)[:, legs].reshape(-1)

    return at_poses, None


def _rates(study, g, c):
    return duty_oracle.rates(study, g, c, study.leg_duty.internal)


def _alone(value):
    return (lambda r, limit: np.array([value(r)]),) * 2


RULES = {  # the values that must be at most the high limit, and those that must be at least the low one
    # max(base) / max(platform): the high limit holds for every base joint, the low limit for every platform joint.
    "radius_ratio": (
        lambda r, _: _radii(r, "base") / _radii(r, "platform").max(),
        lambda r, _: _radii(r, "base").max() / _radii(r, "platform"),
    ),
    "leg_ratio": (_leg_ratio, _leg_ratio),
    "stroke_ratio": (_stroke_ratio, None),
    "zs_fraction": _alone(lambda r: r.neutral.internal_point[2] / _height(r)),
    "stroke": (_stroke, None),
    "leg_length": _some_legs(0, 9),
    "external_length": _some_legs(0, 3),
    "upper_length": _some_legs(3, 6),
    "lower_length": _some_legs(6, 9),
    "height": _alone(_height),
    "footprint": _alone(lambda r: _radii(r, "base").max()),
    "joint_height": (_joint_height, None),
    "joint_spacing": (None, _joint_spacing),
    "leg_clearance": (None, _leg_clearance),
    "base_cone": (lambda r, limit: cone(r, "base", limit.axis), None),
    "platform_cone": (lambda r, limit: cone(r, "platform", limit.axis), None),
    **{
        f"{body}_cone_{kind}": (_some_joints(body, legs), None)
        for body in ("base", "platform")
        for kind, legs in (("external", slice(0, 3)), ("internal", slice(3, 6)))
    },
    "fault_tolerant": (_fault_tolerant, None),
    "force": _of_duty(duty_oracle.forces),
    "rate": _of_duty(_rates),
    "power": _of_duty(duty_oracle.forces, _rates),
    **{
        f"{kind}_{name}": _of_duty(one, legs=slice(first, first + 3))
        for name, one in (("force", duty_oracle.forces), ("rate", _rates))
        for kind, first in (("external", 0), ("upper", 3), ("lower", 6))
    },
    "singularity_free": (None, lambda r, limit: determinants(r, limit.steps if limit.at == "poses" else 0)),
}

EVERY_LIMIT = {  # with every side that it has, as studies state it
    "stroke_ratio": {"max": 1.3},
    "stroke": {"max": 0.4, "of": "zp"},
    "radius_ratio": {"min": 0.5, "max": 2.0},
    "leg_ratio": {"min": 1.2, "max": 3.0},
    "zs_fraction": {"min": 0.1, "max": 0.9},
    "leg_length": {"min": 0.5, "max": 6.0},
    "external_length": {"min": 0.1, "max": 1.6, "of": "zp"},
    "upper_length": {"min": 0.2, "max": 4.0},
    "lower_length": {"min": 0.2, "max": 1.4, "of": "zp"},
    "height": {"min": 0.5, "max": 8.0},
    "footprint": {"min": 0.5, "max": 6.0},
    "joint_height": {"max": 0.6},
    "joint_spacing": {"min": 0.1},
    "leg_clearance": {"min": 0.2},
    "base_cone": {"max_deg": 50.0, "axis": [0.1, -0.2, 2.0]},
    "platform_cone": {"max_deg": 60.0, "axis": [0.2, 0.3, -1.0]},
    "base_cone_external": {"max_deg": 50.0, "axis": [0.1, -0.2, 2.0]},
    "base_cone_internal": {"max_deg": 55.0, "axis": [0.1, 0.2, 2.0]},
    "platform_cone_external": {"max_deg": 60.0, "axis": [0.2, 0.3, -1.0]},
    "platform_cone_internal": {"max_deg": 65.0, "axis": [0.2, -0.3, -1.0]},
    "singularity_free": {"min": 0.01},
    "fault_tolerant": {"max": 9.0},
    "force": {"max": 100.0},
    "rate": {"max": 1.5},
    "power": {"max": 150.0},
    **{f"{kind}_force": {"max": 90.0} for kind in ("external", "upper", "lower")},
    **{f"{kind}_rate": {"max": 1.4} for kind in ("external", "upper", "lower")},
}


# --- Directions and distances -----------------------------------------------------------------------------------------


def cone(robot, body, axis):
    """The angle between the six legs at a body and an axis in its frame, at every pose, shape (poses * 6,), radians.

    Base: external and lower internal legs; platform: external and upper internal ones, all pointing away from the
    joint. Without an axis: the direction of each leg itself at the neutral pose.
    """
    seen = _directions(robot, body, robot.poses)
    middle = np.broadcast_to(np.asarray(axis) if len(axis) else _directions(robot, body, robot.neutral), seen.shape)
    across = np.linalg.norm(np.cross(seen, middle), axis=-1)
    return np.arctan2(across, np.sum(seen * middle, axis=-1)).reshape(-1)


def _directions(robot, body, c):
    start, end = robot.ends(c)
    along = end - start
    if body == "base":
        return along[..., [0, 1, 2, 6, 7, 8], :]
    return np.concatenate([-along[..., :3, :], along[..., 3:6, :]], axis=-2) @ c.rotation  # rows: Q^T v


def determinants(robot, steps):
    """det B, det C and det N at the neutral pose and along straight paths to all poses, shape (3 (1 + steps * poses),).

    The signs are those relative to the neutral pose, where all three are positive. Rows are unit vectors of the lower
    internal legs (B) and the upper internal legs (C), and d_i x w_i with unit vectors from O to the base joint and the
    platform joint of external leg i (N).
    """
    here, there = robot.neutral, robot.poses
    turn = Rotation.from_matrix(there.rotation @ here.rotation.T).as_rotvec()
    whole = np.concatenate([turn, there.position - here.position, there.internal_point - here.internal_point], axis=-1)
    path = here.moved((np.arange(1, steps + 1)[:, None, None] / max(steps, 1) * whole).reshape(-1, 9))
    neutral, seen = triples(robot, here), triples(robot, path)
    return np.concatenate([np.abs(neutral).reshape(-1), (seen * np.sign(neutral)).reshape(-1)])


def triples(robot, c):
    start, end = robot.ends(c)
    along = end - start
    to_base, to_platform = (at[..., :3, :] - c.internal_point[..., None, :] for at in (start, end))
    turning = np.cross(_units(to_base), _units(to_platform))
    return np.linalg.det(np.stack([_units(along[..., 6:9, :]), _units(along[..., 3:6, :]), turning], axis=-3))


def _units(v):
    sizes = np.linalg.norm(v, axis=-1, keepdims=True)
    return v / np.where(sizes > 0.0, sizes, 1.0)


def between_segments(a, b, c, d):
    """The distance of the segments ab and cd, each end (..., 3).

    One of the nearest points is an end of its segment, or both are interior and lie on the common normal. The second
    case needs both feet of the normal inside the segments, and segments that are not parallel.
    """
    ends = np.min([_to_segment(a, c, d), _to_segment(b, c, d), _to_segment(c, a, b), _to_segment(d, a, b)], axis=0)
    u, v, w = b - a, d - c, c - a
    normal = np.cross(u, v)
    square = np.sum(normal**2, axis=-1)
    crossing = square > 1e-20 * np.sum(u**2, axis=-1) * np.sum(v**2, axis=-1)
    safe = np.where(crossing, square, 1.0)
    along_u = np.sum(np.cross(w, v) * normal, axis=-1) / safe
    along_v = np.sum(np.cross(w, u) * normal, axis=-1) / safe
    inside = crossing & (along_u >= 0.0) & (along_u <= 1.0) & (along_v >= 0.0) & (along_v <= 1.0)
    lines = np.abs(np.sum(w * normal, axis=-1)) / np.sqrt(safe)
    return np.where(inside, np.minimum(lines, ends), ends)


def _to_segment(point, a, b):
    along = b - a
    square = np.sum(along**2, axis=-1)
    share = np.clip(np.sum((point - a) * along, axis=-1) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    return np.linalg.norm(point - (a + share[..., None] * along), axis=-1)
