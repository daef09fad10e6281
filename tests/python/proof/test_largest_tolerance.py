"""The largest tolerance that is proved, attacked: machines drawn within it, at poses drawn from the region.

Oracle: every limit of the study in numpy, of each machine by itself, which knows nothing of tolerances.
"""

from dataclasses import replace

import numpy as np
import numpy_model as model
import pytest
from limit_oracle import limits_of, margins, robot_of
from proved_machine import REGIONS, VARIABLES, at_pose, sampled, study
from region_poses import disc
from sizes import size

import ninedof as nd

SLACK = 1.1e-6  # of a limit: what certify allows
TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")
LENGTHS = (100.0, 700.0)  # of leg_length


def built(geometry, rng, radius):
    """One machine: joints in balls about those of the drawing, half of them on the spheres."""
    return nd.Geometry(*(getattr(geometry, name) + radius * disc(rng, 3, 3, 0.5) for name in TRIPLES))


def least_margins(asked, certificate, tolerances, machines, seed):
    """The least margin of any limit of each machine, and its greatest condition number.

    At poses drawn from the region, and at those where the certificate has the extremes of limits.
    """
    region, rng, drawing = asked.objective.region, np.random.default_rng(seed), robot_of(asked, VARIABLES)
    neutral = nd.Configuration.neutral([VARIABLES["zp"]], [VARIABLES["zs"]])
    extremes = [at_pose(met, drawing.geometry, neutral) for one in certificate.limits for met in one.at]
    for _ in range(machines):
        m = sampled(region, drawing.geometry, neutral, rng, 200)
        s = np.broadcast_to(m.s, m.p.shape)
        there = [
            np.concatenate([x, *(getattr(one, name)[None] for one in extremes)])
            for name, x in zip("pQs", (m.p, m.Q, s), strict=True)
        ]
        poses = nd.Configuration(*there)
        robot = replace(drawing, geometry=built(drawing.geometry, rng, tolerances.joints), poses=poses)
        least = min(float(margins(limit, robot).min()) for limit in limits_of(asked))
        plates = model.robot(robot.geometry, poses)
        read = model.lengths(plates) + tolerances.legs * rng.choice([-1.0, 1.0], (len(plates.p), 9))
        least = min(least, 1.0 - read.max() / LENGTHS[1], read.min() / LENGTHS[0] - 1.0)
        yield least, model.condition_number(plates, 150.0).max()


@pytest.mark.slow
@pytest.mark.parametrize(("shape", "cone"), [("box", 74.6), ("path", 70.0)])
def test_no_machine_within_the_largest_tolerance_breaks_what_is_proved(shape, cone):
    """A limit is near, so that the tolerance is the largest: of machines some times as far off some break it."""
    cones = {"base_cone": {"max_deg": 60.0, "axis": (0, 0, 1)}}  # axes of the drawing
    asked = study(REGIONS[shape], **cones, platform_cone={"max_deg": cone, "axis": (0, 0.3, -1)})
    result = nd.optimize(asked)
    largest = result.largest_tolerance(time_limit=5.0)
    certificate = result.certify(tolerance=largest, gap=0.5)
    assert all(one.answer == "proved" for one in certificate.limits)
    margin, condition = np.transpose(list(least_margins(asked, certificate, largest, size(150, 10_000), 1)))
    assert margin.min() > -SLACK
    assert condition.max() <= certificate.condition[1]
    wide = nd.Tolerances(6.0 * largest.joints, 6.0 * largest.legs)
    assert min(least for least, _ in least_margins(asked, certificate, wide, 50, 2)) < 0.0
