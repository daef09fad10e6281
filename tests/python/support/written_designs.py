"""Designs for tests of CAD and document files: each has what another lacks."""

import functools

import numpy as np

import ninedof as nd
from ninedof.export.model import model_of

PAPER = nd.Design(nd.Geometry.hexagonal(0.0, 5.8124, 2.9062, 0.0), nd.Configuration.neutral(3.9828, 2.4432))
HEXAGON = nd.Design(
    nd.Geometry.hexagonal(120.0, 480.0, 300.0, 30.0), nd.Configuration.neutral(308.0, 200.0, 0.1), "optimal", "mm"
)


def general(seed=0, unit="in", scale=1.0):
    """Any twelve joints, a turned platform, O off the axis: no coordinate is round."""
    rng = np.random.default_rng(seed)
    geometry = nd.Geometry(*scale * rng.normal(size=(4, 3, 3)))
    pose = nd.Configuration.neutral(3.0 * scale, 1.5 * scale).moved(
        np.r_[rng.normal(size=3), scale * rng.normal(size=6)]
    )
    return nd.Design(geometry, pose, 0.1 + rng.random() * scale, unit)


@functools.cache
def limited():
    """A result whose study limits the lengths of all legs, where the lengths are in mm."""
    constraints = {"radius_ratio": (None, 2.0), "leg_length": (1.0, 9.0)}
    return nd.optimize(nd.Study(constraints=constraints, unit="mm", starts=2, characteristic_length=1.0))


def text_of(module, design, name="robot"):
    return module.text(model_of(design, name))
