"""Design studies once more, in plain numpy: what `Study.evaluate` must answer.

Reads the tables of a study file and rebuilds everything from them: joints, poses, legs, J' and its singular values
(LAPACK, through numpy_model), aggregates. Shares with the package only the words of the study file.
Margins, of one design at a time, come from limit_oracle.py.
"""

import math

import numpy as np
import numpy_model as model
from limit_oracle import Robot, limits_of, margins
from scipy.spatial.transform import Rotation

import ninedof as nd

TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")
K = math.sqrt(3.0) / 6.0


# --- Variables -> joints ----------------------------------------------------------------------------------------------


def points(*rows):
    """Three joints (x, y) at z = 0, (..., 3, 3)."""
    flat = [np.stack(np.broadcast_arrays(x, y, 0.0 * x), axis=-1) for x, y in rows]
    return np.stack(flat, axis=-2)


def hexagon(s1, s2):
    """Eqs. (37)-(38) as printed: the external and the internal joints of a body with sides s1, s2."""
    low, middle, high = -K * (s1 + 2.0 * s2), -K * (s1 - s2), K * (2.0 * s1 + s2)
    external = points((0.5 * s1, low), (-0.5 * (s1 + s2), middle), (0.5 * s2, high))
    internal = points((-0.5 * s1, low), (-0.5 * s2, high), (0.5 * (s1 + s2), middle))
    return external, internal


def joints(family, v):
    """Return r, r^ (base frame), u, u~ (platform frame), each (..., 3, 3)."""
    if family == "hexagonal":
        return (*hexagon(v["a1"], v["a2"]), *hexagon(v["b1"], v["b2"]))
    if family == "general":
        return tuple(
            np.stack([np.stack([v[f"{t}_{i}_{axis}"] for axis in "xyz"], axis=-1) for i in (1, 2, 3)], axis=-2)
            for t in TRIPLES
        )
    zero = np.zeros_like(v["zp"])
    return tuple(
        model.orbit(v[f"{t}_radius"], v.get(f"{t}_angle", zero), v.get(f"{t}_height", zero))  # one triple is at angle 0
        for t in TRIPLES
    )


def family_names(family):
    """Every variable of a family that is not a height of the robot or a twist, and its kind."""
    if family == "hexagonal":
        return ["a1", "a2", "b1", "b2"]
    if family == "general":
        return [f"{t}_{i}_{axis}" for t in TRIPLES for i in (1, 2, 3) for axis in "xyz"]
    kinds = ("radius", "angle", "height") if family == "symmetric_nonplanar" else ("radius", "angle")
    return [f"{t}_{k}" for t in TRIPLES for k in kinds if (t, k) != ("base_external", "angle")]


def is_angle(name):
    return name == "theta_z" or name.endswith("_angle")


# --- Poses ------------------------------------------------------------------------------------------------------------


def listed_poses(objective):
    """The poses of the objective: (shift of p, rotation vector, shift of s or "best", in fractions of zp)."""
    out = []
    for pose in objective.get("poses", []):
        s = pose.get("internal_point", objective.get("internal_point", "shifted"))
        position = np.array(pose.get("position", [0.0] * 3), dtype=float)
        words = {"held": np.zeros(3), "shifted": position, "best": "best"}
        out.append(
            (
                position,
                np.array(pose.get("rotation", np.radians(pose.get("rotation_deg", [0.0] * 3))), dtype=float),
                words[s] if isinstance(s, str) else np.array(s, dtype=float),
                pose.get("unit", objective.get("unit", "length")) == "zp",
            )
        )
    return out


def turn(vectors):
    flat = Rotation.from_rotvec(np.reshape(vectors, (-1, 3))).as_matrix()
    return flat.reshape(*np.shape(vectors), 3)


def placed(v, pose, number):
    """p, Q, s of one pose."""
    shift, vector, inner, in_zp = pose
    zp, zs = v["zp"], v["zs"]
    up = np.array([0.0, 0.0, 1.0])
    unit = zp[..., None] if in_zp else np.ones_like(zp)[..., None]
    if isinstance(inner, str):  # "best": a variable, always in fractions of zp
        inner = zp[..., None] * np.stack([v[f"pose{number}.s_{axis}"] for axis in "xyz"], axis=-1)
    else:
        inner = inner * unit
    twist = turn(v.get("theta_z", np.zeros_like(zp))[..., None] * up)
    return (
        zp[..., None] * up + shift * unit,
        turn(vector) @ twist,
        zs[..., None] * up + inner,
    )


def robot(geometry, places):
    """One robot in several places, the places on the axis before the joints."""
    p, Q, s = (
        np.stack(np.broadcast_arrays(*x), axis=-k) for x, k in zip(zip(*places, strict=True), (2, 3, 2), strict=True)
    )
    return model.Robot(*(t[..., None, :, :] for t in geometry), p, Q, s)


# --- Indices ----------------------------------------------------------------------------------------------------------


def length_of_kind(kind, m):
    """A characteristic length at the neutral configuration `m`, by its definition."""
    if kind == "mean_leg":
        return model.lengths(m).mean(axis=-1)
    if kind == "platform_radius":
        return np.maximum(np.linalg.norm(m.u, axis=-1).max(axis=-1), np.linalg.norm(m.ut, axis=-1).max(axis=-1))
    assert kind == "natural"
    unit = length_of_kind("platform_radius", m)
    J = model.jacobian(m, unit[..., None, None])
    weight = np.diagonal(np.linalg.inv(J @ np.swapaxes(J, -1, -2)), axis1=-2, axis2=-1)  # of M^T M
    return unit * np.sqrt(weight[..., :3].sum(axis=-1) / weight[..., 3:].sum(axis=-1))


def six_legged(m, lc):
    """Singular values of the matrix of a platform on the six legs r_i -> u_i and r^_i -> u~_i."""
    u, ut = m.u @ np.swapaxes(m.Q, -1, -2), m.ut @ np.swapaxes(m.Q, -1, -2)
    arms = np.concatenate([u, ut], axis=-2)
    legs = m.p[..., None, :] + arms - np.concatenate([m.r, m.rh], axis=-2)
    e = legs / np.linalg.norm(legs, axis=-1, keepdims=True)
    rows = np.concatenate([np.cross(arms, e) / lc[..., None, None], e], axis=-1)
    return np.linalg.svd(rows, compute_uv=False)


def aggregate(values, objective):
    worst, harmonic = values.max(axis=-1), 1.0 / np.mean(1.0 / values, axis=-1)
    share = {"worst": 1.0, "mean_inverse": 0.0, "weighted": objective.get("weight", 0.5)}
    w = share[objective.get("aggregate", "worst")]
    return np.exp(w * np.log(worst) + (1.0 - w) * np.log(harmonic))


# --- A study ----------------------------------------------------------------------------------------------------------


class Oracle:
    """The tables of a study file, ready to be evaluated."""

    def __init__(self, data):
        self.data, self.design, self.variables = data, data["design"], data["variables"]
        self.objective = data.get("objective", {})
        self.poses = listed_poses(self.objective)
        base, platform = self.joints_that_meet()
        apart = [(0, 1), (0, 2), (1, 2)]
        apart += [(i, 3 + j) for i in range(3) for j in range(3) if not platform[i, j]]
        apart += [(i, 6 + j) for i in range(3) for j in range(3) if not base[i, j]]
        self.apart = np.array(apart)  # pairs of legs without a common joint

    def joints_that_meet(self):
        """For base and platform (3, 3): whether external joint i is internal joint j in every design of the study."""
        rng = np.random.default_rng(0)
        draw = {
            n: rng.uniform(*np.clip(b, -9.0, 9.0), size=3) if isinstance(b, list) else np.full(3, float(b))
            for n, b in self.variables.items()
        }
        g = joints(self.design["family"], draw)
        gap = [np.linalg.norm(x[:, :, None] - y[:, None], axis=-1).max(axis=0) for x, y in (g[:2], g[2:])]
        return tuple(g < 1e-12 for g in gap)

    def at(self, names, x):
        """Named variables, the joints, and p, Q, s of the neutral pose and of the poses looked at, at x (..., n)."""
        x = np.asarray(x, dtype=float)
        v = {n: np.full(x.shape[:-1], float(b)) for n, b in self.variables.items() if not isinstance(b, list)}
        v |= {n: x[..., k] for k, n in enumerate(names)}
        home = placed(v, (np.zeros(3), np.zeros(3), np.zeros(3), False), 0)
        places = [placed(v, pose, k) for k, pose in enumerate(self.poses, 1)] or [home]
        return v, joints(self.design["family"], v), home, places

    def evaluate(self, names, x):
        """Objective and condition numbers at x (..., len(names))."""
        v, geometry, home, places = self.at(names, x)
        neutral, posed = robot(geometry, [home]), robot(geometry, places)
        lc = self.design.get("characteristic_length", 1.0)
        if "characteristic_length" in v:
            lc = v["characteristic_length"]
        elif isinstance(lc, str):
            lc = length_of_kind(lc, neutral)[..., 0]
        lc = np.broadcast_to(lc, np.shape(x)[:-1])
        sigma = model.singular_values(posed, lc[..., None, None, None])
        sigma_home = model.singular_values(neutral, lc[..., None, None, None])[..., 0, :]
        conditions = sigma[..., 0] / sigma[..., -1]
        index = self.objective.get("index", "condition_number")
        if index == "frobenius":
            norm, inverse = np.sqrt((sigma**2).sum(-1)), np.sqrt((1.0 / sigma**2).sum(-1))
            value = aggregate(norm * inverse, self.objective)
        elif index == "speed":
            value = (1.0 / sigma[..., -1]).max(axis=-1)
        elif index == "six_legged":
            six = six_legged(_first(neutral), lc)
            value = six[..., 0] / six[..., -1]
        else:
            value = aggregate(conditions, self.objective)
        return {
            "objective": value,
            "conditions": conditions,
            "condition_number": sigma_home[..., 0] / sigma_home[..., -1],
            "characteristic_length": lc,
            "configurations": robot(geometry, [home, *(places if self.poses else [])])[4:],
        }

    def margins(self, names, x):
        """The smallest margin of each limit at x (len(names),)."""
        _, geometry, home, places = self.at(names, x)
        poses = nd.Configuration(*(np.stack(part) for part in zip(*places, strict=True)))
        case = Robot(nd.Geometry(*geometry), nd.Configuration(*home), poses, 1.0, self.apart)
        limits = limits_of(nd.Study.from_dict(self.data))
        return {limit.label: float(margins(limit, case).min()) for limit in limits}


def _first(m):
    """The first place of a robot in several."""
    return model.Robot(*(t[..., 0, :, :] for t in m[:4]), m.p[..., 0, :], m.Q[..., 0, :, :], m.s[..., 0, :])
