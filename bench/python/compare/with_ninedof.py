"""The package: one call for the stack, into memory that is there already."""

import numpy as np

import ninedof as nd


def prepare(robot, poses, threads=1, norm="2"):
    geometry = nd.Geometry(*robot[:4])
    configuration = nd.Configuration(*poses)
    out = np.empty(len(poses.position))
    return lambda: nd.condition_number(geometry, configuration, robot.length, norm=norm, threads=threads, out=out)
