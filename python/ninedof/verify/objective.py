"""The objective of a study from its definition, and its gradients: at a tie all of them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ninedof.conditioning.conditioning import condition_number, singular_values
from ninedof.design.study import Study
from ninedof.kinematics.kinematics import jacobian
from ninedof.support.arrays import Floats
from ninedof.verify.nonsmooth import TIE, Ends, ends_of
from ninedof.verify.robot import Robot


@dataclass(frozen=True)
class ObjectiveRule:
    """The objective of a study."""

    index: str = "condition_number"
    aggregate: str = "worst"
    weight: float = 0.5
    condition_limit: float = math.inf
    neutral_condition_limit: float = math.inf
    pose_weights: tuple[float, ...] = (1.0,)

    @classmethod
    def of(cls, study: Study) -> ObjectiveRule:
        """Return the objective of a study."""
        o = study.objective
        at_poses, at_neutral = (
            math.inf if limit is None else limit for limit in (o.condition_limit, o.neutral_condition_limit)
        )
        weights = tuple(pose.weight for pose in o.poses) or (1.0,)
        return cls(o.index, o.aggregate, o.weight, at_poses, at_neutral, weights)

    def values(self, robot: Robot) -> Floats:
        """Return the index at every pose of the objective, shape (n,), by the general path."""
        g, poses, length = robot.geometry, robot.poses, robot.length
        if self.index == "condition_number":
            return np.asarray(condition_number(g, poses, length))
        if self.index == "frobenius":
            return np.asarray(condition_number(g, poses, length, norm="frobenius"))
        if self.index == "speed":
            with np.errstate(divide="ignore"):
                return np.asarray(1.0 / singular_values(g, poses, length)[:, -1])
        sigma = np.linalg.svd(six_legged(robot), compute_uv=False)
        with np.errstate(divide="ignore"):
            return np.asarray(sigma[:, 0] / sigma[:, -1])

    def total(self, values: Floats) -> float:
        """Return the objective: the worst value, the harmonic mean, or both weighted in logarithms."""
        worst = float(values.max())
        if self.aggregate == "worst" or not math.isfinite(worst):
            return worst
        harmonic = 1.0 / float(np.average(1.0 / values, weights=self.pose_weights))
        if self.aggregate == "mean_inverse":
            return harmonic
        return math.exp(self.weight * math.log(worst) + (1.0 - self.weight) * math.log(harmonic))

    def matrices(self, robot: Robot) -> Floats:
        """Return the matrices whose singular values define the index, shape (n, 6, 9) or (1, 6, 6).

        One more, that of the neutral configuration, comes last where its condition number has a limit of its own.
        """
        if self.index == "six_legged":
            return six_legged(robot)
        poses = jacobian(robot.geometry, robot.poses, robot.length)
        if math.isinf(self.neutral_condition_limit):
            return poses
        return np.concatenate([poses, jacobian(robot.geometry, robot.neutral, robot.length)[None]])

    def condition_margins(self, robot: Robot) -> dict[str, Floats]:
        """Return 1 - condition number / limit of each pose with a limit, in the order of `matrices`, by limit."""
        stated = {
            "condition_limit": (self.condition_limit, robot.poses),
            "condition_limit at neutral": (self.neutral_condition_limit, robot.neutral),
        }
        return {
            name: 1.0 - np.asarray(condition_number(robot.geometry, poses, robot.length)) / limit
            for name, (limit, poses) in stated.items()
            if math.isfinite(limit)
        }


class Gradients:
    """Gradients of log(objective) at a design, and of log(condition number) if that is limited."""

    def __init__(self, objective: ObjectiveRule, robot: Robot, matrices: Floats, slopes: Floats) -> None:
        """Store the matrices of `ObjectiveRule.matrices` and their derivatives, shape (variables, n, 6, k)."""
        self._objective = objective
        self._values = objective.values(robot)
        self._ends = [ends_of(m, slopes[:, k]) for k, m in enumerate(matrices)]
        self._smooth = [_frobenius(m, slopes[:, k]) for k, m in enumerate(matrices)]
        first = {"condition_limit": 0, "condition_limit at neutral": len(matrices) - 1}
        self._held = [
            first[name] + int(k)
            for name, margins in objective.condition_margins(robot).items()
            for k in np.flatnonzero(margins <= TIE)
        ]

    def steepest(self, direction: Floats) -> Floats:
        """Return the gradient of log(objective) with the least slope along a direction; at a tie there are many."""
        o, values = self._objective, self._values
        each = np.array([self._one(k, direction) for k in range(len(values))])
        worst = np.flatnonzero(np.log(values) >= math.log(values.max()) - TIE)
        best_of_worst: Floats = min((each[k] for k in worst), key=lambda g: float(g @ direction))
        if o.aggregate == "worst":
            return best_of_worst
        shares = np.asarray(o.pose_weights) / values
        mean: Floats = shares @ each / float(np.sum(shares))
        return mean if o.aggregate == "mean_inverse" else o.weight * best_of_worst + (1.0 - o.weight) * mean

    def held(self, direction: Floats) -> list[Floats]:
        """Return, for each pose on its condition limit, the gradient of log(condition number) with the least slope."""
        return [self._ends[k].steepest(direction) for k in self._held]

    def _one(self, k: int, direction: Floats) -> Floats:
        if self._objective.index == "frobenius":
            return self._smooth[k]
        ends: Ends = self._ends[k]
        return ends.steepest_speed(direction) if self._objective.index == "speed" else ends.steepest(direction)


def six_legged(robot: Robot) -> Floats:
    """Return the 6x6 matrix of the platform on six legs r - u and r^ - u~ at the neutral pose, shape (1, 6, 6)."""
    turned = robot.joints("platform") @ robot.neutral.rotation.T
    along = robot.neutral.position + turned - robot.joints("base")
    e = along / np.linalg.norm(along, axis=-1, keepdims=True)
    return np.concatenate([np.cross(turned, e) / robot.length, e], axis=-1)[None]


def _frobenius(matrix: Floats, slopes: Floats) -> Floats:
    """Return the gradient of log(|M| |M^+|) = (log tr G + log tr G^-1) / 2, G = M M^T."""
    gram, inverse = matrix @ matrix.T, np.linalg.pinv(matrix @ matrix.T)
    change = 2.0 * np.einsum("jik,lk->jil", slopes, matrix)  # its symmetric part is the derivative of G
    size = np.einsum("jii->j", change) / np.trace(gram)
    other = np.einsum("jil,li->j", change, inverse @ inverse) / np.trace(inverse)
    return np.asarray(0.5 * (size - other))
