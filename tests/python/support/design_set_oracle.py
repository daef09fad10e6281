"""Designs of a study at poses of its region, in numpy alone: by how much all is kept that admissible designs keep.

Joints, poses, lengths, J' and determinants are those of design_oracle, numpy_model and limit_oracle. The package is
used for containers, and for the way from the neutral pose of `singularity_free`.
"""

import math

import numpy as np
import numpy_model as model
from design_oracle import Oracle, joints, placed, turn
from limit_oracle import Robot, limits_of, margins, triples

import ninedof as nd

UP = np.array([0.0, 0.0, 1.0])


class DesignSetOracle:
    def __init__(self, study, condition_number=None):
        self.study, self.limits = study, limits_of(study)
        stated = study.objective.condition_limit, condition_number
        self.bound = min((x for x in stated if x is not None), default=math.inf)
        tables = Oracle(study.to_dict())
        self.listed, self.apart = tables.poses, tables.apart

    def robot(self, variables, shifts=None, tilts=None, yaws=None):
        """A design at poses of the region: shifts (n, 3) as lengths, rotation vectors (n, 3), turns about z (n, 1).

        Without a region at the listed poses.
        """
        study, v = self.study, {name: np.asarray(x) for name, x in variables.items()}
        if study.objective.region is None:
            listed = [placed(v, pose, k) for k, pose in enumerate(self.listed, 1)]
            there = nd.Configuration(*(np.stack(part) for part in zip(*listed, strict=True)))
            here = nd.Configuration(*placed(v, (np.zeros(3), np.zeros(3), np.zeros(3), False), 0))
            return self._robot(v, here, there)
        arm = np.zeros(3) if study.tool is None else np.array(study.tool.position)
        home = turn(v.get("theta_z", 0.0) * UP)
        turns = turn(tilts) @ turn(yaws * UP) @ home
        p, s = v["zp"] * UP + home @ arm + shifts - turns @ arm, v["zs"] * UP + shifts
        if study.objective.region.internal_point == "held":
            s = np.broadcast_to(v["zs"] * UP, p.shape)
        neutral, poses = nd.Configuration(v["zp"] * UP, home, v["zs"] * UP), nd.Configuration(p, turns, s)
        return self._robot(v, neutral, poses)

    def _robot(self, v, neutral, poses):
        geometry = nd.Geometry(*joints(self.study.family, v))
        return Robot(geometry, neutral, poses, float(self.study.characteristic_length), self.apart)

    def kept(self, robot):
        """The least margin of everything: the limits, the condition number, no singularity, 0 < zs < zp."""
        if self.study.objective.neutral_condition_limit is not None:
            raise NotImplementedError
        zs, zp = robot.neutral.internal_point[2], robot.neutral.position[2]
        signs = np.sign(triples(robot, robot.neutral))
        out = [triples(robot, robot.poses) * signs, np.array([zs, zp - zs])]
        out += [margins(limit, robot) for limit in self.limits]
        if math.isfinite(self.bound):
            c = robot.poses
            plates = model.robot(robot.geometry, c)
            out.append(1.0 - model.condition_number(plates, robot.length) / self.bound)
        return min(float(one.min()) for one in out if one.size)
