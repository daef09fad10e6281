"""A region study at random poses of its region with O placed at each: an own search in numpy, by the definitions.

The largest of the index and the limits is smoothed, and lowered by Newton's method with derivatives by differences and
less and less smoothing, for all poses at once.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from ninedof.conditioning.conditioning import condition_number, singular_values
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import leg_lengths
from ninedof.optimize.region_report import RegionReport, posed
from ninedof.robot.configuration import Configuration
from ninedof.support.arrays import Floats
from ninedof.verify.objective import ObjectiveRule
from ninedof.verify.region import random_poses
from ninedof.verify.robot import DesignSpace, Robot
from ninedof.verify.rules import RULES, Limit, limits_of, margins

SPREADS = ("leg_ratio", "stroke", "stroke_ratio")
OF_POSES = ("leg_length", "external_length", "upper_length", "lower_length", "base_cone", "platform_cone")
SMOOTHINGS = (3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7)
STEPS = 12  # for each, at most
SHARES = (1.0, 0.4, 0.1, 0.02, 0.003)
DIFFERENCE = 1e-6  # of zp
LONGEST = 0.2  # step, in zp
POLLS, POLL_STEP, ANEW = 600, 1e-3, 150  # the step in zp; it begins anew so often


class Placing:
    """Rows of a design at poses of its region, negative where nothing is passed, as a function of O."""

    def __init__(self, study: Study, best: Any, report: RegionReport, count: int, seed: int) -> None:
        """Draw the poses."""
        region = study.objective.region
        assert region is not None
        listed = len(study.objective.poses)
        there = posed(study, random_poses(region, count, np.random.default_rng(seed)))
        space = DesignSpace(there, best.variables)
        robot = space.robot(space.x)
        held = robot.poses[listed:]
        self.robot, self.height, self.held = robot, float(robot.neutral.position[2]), held
        self.rule, self.index = ObjectiveRule.of(there), math.log(best.objective)
        self.limits = [limit for limit in limits_of(there) if _of_poses(limit)]
        self.ranges = np.log(np.array(report.leg_ranges)) if report.leg_ranges else None
        self.ruling = best.configurations[1 + listed :]

    def at(self, s: Floats, some: Any) -> Robot:
        """Return the robot at some of the poses, with O there."""
        c = self.held[some]
        return replace(self.robot, poses=Configuration(c.position, c.rotation, s))

    def rows(self, s: Floats, some: Any) -> tuple[Floats, Floats]:
        """Return the rows of the index and those of the limits, shapes (n, a) and (n, b)."""
        robot = self.at(s, some)
        n, c = len(s), robot.poses
        index = self._index(robot) - self.index
        limits = [-_each(limit, robot, n) for limit in self.limits]
        if math.isfinite(self.rule.condition_limit):
            kappa = np.asarray(condition_number(robot.geometry, c, robot.length))
            limits.append(np.log(kappa / self.rule.condition_limit)[:, None])
        if self.ranges is not None:
            lengths = np.log(leg_lengths(robot.geometry, c)).reshape(n, 9)
            limits += [self.ranges[:, 0] - lengths, lengths - self.ranges[:, 1]]
        below = np.einsum("ni,ni->n", c.position - s, c.rotation[:, :, 2])
        limits.append(-np.stack([s[:, 2], below], axis=1) / self.height)
        limits.append(np.abs(s - self.robot.neutral.internal_point) / self.height - 1.0)
        return index, np.concatenate(limits, axis=1)

    def _index(self, robot: Robot) -> Floats:
        if self.rule.index == "frobenius":
            return np.log(self.rule.values(robot))[:, None]
        with np.errstate(divide="ignore"):
            sigma = np.log(np.maximum(singular_values(robot.geometry, robot.poses, robot.length), 1e-300))
        if self.rule.index == "speed":
            return -sigma[:, 3:]
        return np.asarray((sigma[:, :3, None] - sigma[:, None, 3:]).reshape(len(sigma), -1))

    def worst(self, s: Floats, some: Any) -> Floats:
        """Return the largest row at each of some poses."""
        return np.asarray(np.concatenate(self.rows(s, some), axis=1).max(axis=1))

    def starts(self) -> list[Floats]:
        """Return O of the poses that ruled, the nearest first, moved as the platform, and O shifted and held."""
        c, r = self.held, self.ruling
        away = np.linalg.norm(c.position[:, None] - r.position[None], axis=-1) / self.height
        away = away + np.linalg.norm(c.rotation[:, None] - r.rotation[None], axis=(-2, -1))
        near = np.argsort(away, axis=1)
        shifted = c.internal_point + c.position - self.robot.neutral.position
        moved = [r.internal_point[k] + c.position - r.position[k] for k in near.T]
        return [*moved, shifted, c.internal_point]

    def placed(self, enough: float) -> Floats:
        """Return O at every pose where the largest row is least, or just `enough`."""
        starts = self.starts()
        every = np.arange(len(self.held))
        values = np.array([self.worst(s, every) for s in starts])
        order = np.argsort(values, axis=0)
        best = np.array(starts)[order[0], every]
        worst = values[order[0], every]
        for k in range(len(starts)):
            left = np.flatnonzero(worst > enough)
            if not len(left):
                break
            s = self._lowered(np.array(starts)[order[k, left], left], left, enough)
            found = self.worst(s, left)
            better = found < worst[left]
            best[left[better]], worst[left[better]] = s[better], found[better]
        left = np.flatnonzero(worst > enough)
        if len(left):
            best[left] = self._polled(best[left], left, enough)
        return np.asarray(best)

    def _polled(self, s: Floats, some: Any, enough: float) -> Floats:
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

    def _lowered(self, s: Floats, some: Any, enough: float) -> Floats:
        for smoothing in SMOOTHINGS:
            for _ in range(STEPS):
                open_ = np.flatnonzero(self.worst(s, some) > enough)
                if not len(open_):
                    return s
                s[open_] = self._step(s[open_], some[open_], smoothing)
        return s

    def _step(self, s: Floats, some: Any, smoothing: float) -> Floats:
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


def worst_placed(study: Study, best: Any, report: RegionReport, count: int, seed: int) -> tuple[float, float]:
    """Return the largest index and the least margin of a design at random poses of its region, O placed at each."""
    placing = Placing(study, best, report, count, seed)
    s = placing.placed(0.0)
    index, limits = placing.rows(s, np.arange(count))
    margin = min(-float(limits.max()), _ranges_margin(study, best, report))
    return math.exp(float(index.max()) + placing.index), margin


def _ranges_margin(study: Study, best: Any, report: RegionReport) -> float:
    """Return by how much the ranges of lengths are within the limits that compare poses."""
    out = np.inf
    if not report.leg_ranges:  # none of the limits compares poses, or the result is unfinished
        return out
    for limit in limits_of(study):
        if limit.name not in SPREADS or limit.at == "neutral" or not math.isfinite(limit.high):
            continue
        low, high = np.array(report.leg_ranges).T
        if limit.name == "stroke":
            size = limit.high * (float(best.configuration.position[2]) if limit.of == "zp" else 1.0)
            out = min(out, float((1.0 - (high - low) / size).min()))
        else:
            ratio = high / low if limit.name == "stroke_ratio" else high.max() / low.min()
            out = min(out, float(np.min(1.0 - ratio / limit.high)))
    return out


def _of_poses(limit: Limit) -> bool:
    return limit.at != "neutral" and limit.name in (*OF_POSES, "leg_clearance", "singularity_free")


def _each(limit: Limit, robot: Robot, n: int) -> Floats:
    """Return the margins of a limit by pose, shape (n, k)."""
    if limit.name == "singularity_free":
        return np.moveaxis(margins(limit, robot)[3:].reshape(-1, n, 3), 1, 0).reshape(n, -1)
    sides = [replace(limit, low=0.0), replace(limit, high=math.inf)] if RULES[limit.name].lower else [limit]
    return np.concatenate([m.reshape(n, -1) for side in sides if (m := margins(side, robot)).size], axis=1)


def _soft(rows: Floats, smoothing: float) -> Floats:
    most = rows.max(axis=1)
    return np.asarray(most + smoothing * np.log(np.exp((rows - most[:, None]) / smoothing).sum(axis=1)))
