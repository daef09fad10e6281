"""A region study at random poses of its region, in numpy by the definitions; with O best by a search of its own.

The largest of the index and the limits is smoothed, and lowered by Newton's method with derivatives by differences and
less and less smoothing, for all poses at once.
"""

import math
from dataclasses import replace

import numpy as np
from limit_oracle import RULES, limits_of, margins, robot_of
from region_poses import drawn
from scipy.spatial.transform import Rotation

import ninedof as nd
from ninedof.design.domains.region_poses import posed

SPREADS = ("leg_ratio", "stroke", "stroke_ratio")
OF_POSES = (
    *("leg_length", "external_length", "upper_length", "lower_length", "base_cone", "platform_cone"),
    *("base_cone_external", "base_cone_internal", "platform_cone_external", "platform_cone_internal"),
    *("leg_clearance", "singularity_free"),
)
SMOOTHINGS = (3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7)
STEPS = 12  # for each, at most
SHARES = (1.0, 0.4, 0.1, 0.02, 0.003)
DIFFERENCE = 1e-6  # of zp
LONGEST = 0.2  # step, in zp
POLLS, POLL_STEP, ANEW = 600, 1e-3, 150  # the step in zp; it begins anew so often
AROUND, WIDE, LOWEST = 200, 0.15, 6  # starts about O where that is not enough, how far apart in zp, ends polled


def index_at(study, robot):
    """The index of a study at every pose of a robot, shape (n,), by the general path."""
    g, poses, length, index = robot.geometry, robot.poses, robot.length, study.objective.index
    if index == "speed":
        with np.errstate(divide="ignore"):
            return 1.0 / nd.singular_values(g, poses, length)[:, -1]
    norm = {"norm": "frobenius"} if index == "frobenius" else {}
    return np.asarray(nd.condition_number(g, poses, length, **norm))


def condition_margins(study, robot):
    """1 - condition number / limit of each pose with a limit, by limit."""
    o = study.objective
    stated = (o.condition_limit, robot.poses), (o.neutral_condition_limit, robot.neutral)
    return [
        1.0 - np.asarray(nd.condition_number(robot.geometry, poses, robot.length)) / limit
        for limit, poses in stated
        if limit is not None
    ]


def random_poses(region, count, rng, share=0.5):
    """Poses of a region, a share of them on its boundary."""
    shifts, tilts, yaws = drawn(region, 1.0, rng, count, share)
    turns = Rotation.from_rotvec(tilts) * Rotation.from_rotvec(np.pad(yaws, ((0, 0), (2, 0))))
    return tuple(
        nd.Pose(tuple(p), tuple(turn), tuple(p) if region.internal_point == "shifted" else (0.0, 0.0, 0.0), region.unit)
        for p, turn in zip(shifts.tolist(), turns.as_rotvec().tolist(), strict=True)
    )


def worst_at_random(study, variables, count, seed):
    """The largest index and the least margin of a design at random poses of its region."""
    there = posed(study, random_poses(study.objective.region, count, np.random.default_rng(seed)))
    robot = robot_of(there, variables)
    every = [margins(limit, robot) for limit in limits_of(there)] + condition_margins(there, robot)
    return float(index_at(there, robot).max()), min((float(m.min()) for m in every if m.size), default=np.inf)


class Placing:
    """Rows of a design at poses of its region, negative where nothing is passed, as a function of O."""

    def __init__(self, study, best, report, count, seed):
        listed = len(study.objective.poses)
        there = posed(study, random_poses(study.objective.region, count, np.random.default_rng(seed)))
        self.study, self.robot = there, robot_of(there, best.variables)
        self.height, self.held = float(self.robot.neutral.position[2]), self.robot.poses[listed:]
        self.index = math.log(best.objective)
        self.limits = [limit for limit in limits_of(there) if limit.at != "neutral" and limit.name in OF_POSES]
        self.ranges = np.log(np.array(report.leg_ranges)) if report.leg_ranges else None
        self.ruling = best.configurations[1 + listed :]

    def rows(self, s, some):
        """The rows of the index and those of the limits at some of the poses, shapes (n, a) and (n, b)."""
        c = self.held[some]
        robot = replace(self.robot, poses=nd.Configuration(c.position, c.rotation, s))
        n, limit = len(s), self.study.objective.condition_limit
        out = [-_each(one, robot, n) for one in self.limits]
        if limit is not None:
            kappa = np.asarray(nd.condition_number(robot.geometry, robot.poses, robot.length))
            out.append(np.log(kappa / limit)[:, None])
        if self.ranges is not None:
            lengths = np.log(nd.leg_lengths(robot.geometry, robot.poses)).reshape(n, 9)
            out += [self.ranges[:, 0] - lengths, lengths - self.ranges[:, 1]]
        below = np.einsum("ni,ni->n", c.position - s, c.rotation[:, :, 2])
        out.append(-np.stack([s[:, 2], below], axis=1) / self.height)
        out.append(np.abs(s - self.robot.neutral.internal_point) / self.height - 1.0)
        return self._index(robot) - self.index, np.concatenate(out, axis=1)

    def _index(self, robot):
        if self.study.objective.index == "frobenius":
            return np.log(index_at(self.study, robot))[:, None]
        with np.errstate(divide="ignore"):
            sigma = np.log(np.maximum(nd.singular_values(robot.geometry, robot.poses, robot.length), 1e-300))
        if self.study.objective.index == "speed":
            return -sigma[:, 3:]
        return (sigma[:, :3, None] - sigma[:, None, 3:]).reshape(len(sigma), -1)

    def worst(self, s, some):
        return np.concatenate(self.rows(s, some), axis=1).max(axis=1)

    def placed(self, enough):
        """O at every pose where the largest row is least, or just `enough`.

        From O of the poses that ruled, the nearest first, moved as the platform, and from O shifted and held.
        """
        c, r = self.held, self.ruling
        away = np.linalg.norm(c.position[:, None] - r.position[None], axis=-1) / self.height
        near = np.argsort(away + np.linalg.norm(c.rotation[:, None] - r.rotation[None], axis=(-2, -1)), axis=1)
        moved = [r.internal_point[k] + c.position - r.position[k] for k in near.T]
        starts = np.array([*moved, c.internal_point + c.position - self.robot.neutral.position, c.internal_point])
        every = np.arange(len(c))
        values = np.array([self.worst(s, every) for s in starts])
        order = np.argsort(values, axis=0)
        best, worst = starts[order[0], every], values[order[0], every]
        for k in range(len(starts)):
            left = np.flatnonzero(worst > enough)
            if not len(left):
                return best
            s = self._lowered(starts[order[k, left], left], left, enough)
            value = self.worst(s, left)
            better = value < worst[left]
            best[left[better]], worst[left[better]] = s[better], value[better]
        left = np.flatnonzero(worst > enough)
        if len(left):
            best[left] = self._polled(best[left], left, enough)
        rng = np.random.default_rng(1)
        for k in left[self.worst(best[left], left) > enough]:  # a few, in one of several local minima
            some = np.full(AROUND, k)
            s = self._lowered(best[k] + WIDE * self.height * rng.normal(size=(AROUND, 3)), some, enough)
            s = np.concatenate([best[k : k + 1], s[np.argsort(self.worst(s, some))[:LOWEST]]])
            s = self._polled(s, some[: len(s)], enough)
            best[k] = s[self.worst(s, some[: len(s)]).argmin()]
        return best

    def _polled(self, s, some, enough):
        """Lower the largest row by trying both ways along three random directions at a time.

        Where singular values meet, the smoothed index bends more than its rows tell, and Newton's method may stall.
        """
        rng = np.random.default_rng(0)
        step, worst = np.full(len(s), POLL_STEP * self.height), self.worst(s, some)
        for k in range(1, 1 + POLLS):
            open_ = np.flatnonzero(worst > enough)
            if not len(open_):
                break
            ways = np.linalg.qr(rng.normal(size=(3, 3)))[0]
            tried = np.array([s[open_] + step[open_, None] * way for way in (*ways, *-ways)])
            values = np.array([self.worst(at, some[open_]) for at in tried])
            least, every = values.argmin(axis=0), np.arange(len(open_))
            better = values[least, every] < worst[open_]
            moved = open_[better]
            s[moved], worst[moved] = tried[least, every][better], values[least, every][better]
            step[open_] *= np.where(better, 1.6, 0.85)
            if k % ANEW == 0:
                step[:] = POLL_STEP * self.height
        return s

    def _lowered(self, s, some, enough):
        for smoothing in SMOOTHINGS:
            for _ in range(STEPS):
                open_ = np.flatnonzero(self.worst(s, some) > enough)
                if not len(open_):
                    return s
                s[open_] = self._step(s[open_], some[open_], smoothing)
        return s

    def _step(self, s, some, smoothing):
        rows = np.concatenate(self.rows(s, some), axis=1)
        h = DIFFERENCE * self.height
        moved = [np.concatenate(self.rows(s + h * np.eye(3)[k], some), axis=1) for k in range(3)]
        slopes = np.stack([(m - rows) / DIFFERENCE for m in moved], axis=-1)
        weight = np.exp((rows - rows.max(axis=1, keepdims=True)) / smoothing)
        weight /= weight.sum(axis=1, keepdims=True)
        mean = np.einsum("nm,nmi->ni", weight, slopes)
        about = slopes - mean[:, None]
        bend = np.einsum("nm,nmi,nmj->nij", weight, about, about) / smoothing + 3.0 * np.eye(3)
        way = -np.linalg.solve(bend, mean[..., None])[..., 0]
        way *= np.minimum(1.0, LONGEST / np.maximum(np.linalg.norm(way, axis=1), 1e-300))[:, None]
        best, least = s.copy(), _soft(rows, smoothing)
        for share in SHARES:
            at = s + share * self.height * way
            value = _soft(np.concatenate(self.rows(at, some), axis=1), smoothing)
            better = value < least
            best[better], least[better] = at[better], value[better]
        return best


def worst_placed(study, best, report, count, seed):
    """The largest index and the least margin of a design at random poses of its region, O placed at each."""
    placing = Placing(study, best, report, count, seed)
    index, limits = placing.rows(placing.placed(0.0), np.arange(count))
    margin = min(-float(limits.max()), _ranges_margin(study, best, report))
    return math.exp(float(index.max()) + placing.index), margin


def _ranges_margin(study, best, report):
    """By how much the ranges of lengths are within the limits that compare poses."""
    out = np.inf
    if not report.leg_ranges:  # none of the limits compares poses, or the result is unfinished
        return out
    low, high = np.array(report.leg_ranges).T
    for limit in limits_of(study):
        if limit.name not in SPREADS or limit.at == "neutral" or not math.isfinite(limit.high):
            continue
        if limit.name == "stroke":
            size = limit.high * (float(best.configuration.position[2]) if limit.of == "zp" else 1.0)
            out = min(out, float((1.0 - (high - low) / size).min()))
        else:
            ratio = high / low if limit.name == "stroke_ratio" else high.max() / low.min()
            out = min(out, float(np.min(1.0 - ratio / limit.high)))
    return out


def _each(limit, robot, n):
    """The margins of a limit by pose, shape (n, k)."""
    if limit.name == "singularity_free":
        return np.moveaxis(margins(limit, robot)[3:].reshape(-1, n, 3), 1, 0).reshape(n, -1)
    sides = [replace(limit, low=0.0), replace(limit, high=math.inf)] if RULES[limit.name][1] else [limit]
    return np.concatenate([m.reshape(n, -1) for side in sides if (m := margins(side, robot)).size], axis=1)


def _soft(rows, smoothing):
    most = rows.max(axis=1)
    return most + smoothing * np.log(np.exp((rows - most[:, None]) / smoothing).sum(axis=1))
