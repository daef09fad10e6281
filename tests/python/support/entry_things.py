"""What good calls are made of: one small thing of each kind, made once."""

import dataclasses
import functools
import itertools
import tempfile
from pathlib import Path

import numpy as np

import ninedof as nd
from ninedof.records.proofs import save_certificate

_PLACES = itertools.count()


@functools.cache
def g():
    return nd.Geometry.hexagonal(a1=0.0, a2=5.8124, b1=2.9062, b2=0.0)


@functools.cache
def c():
    return on_axis().moved([0.05, 0.1, -0.1, 0.1, -0.2, 0.0, 0.05, 0.02, 0.0])


@functools.cache
def on_axis():
    return nd.Configuration.neutral(3.9828, 2.3745)


@functools.cache
def stack():
    return nd.Configuration.neutral(3.9828, [2.2, 2.3745])


@functools.cache
def lengths():
    return nd.leg_lengths(g(), c())


@functools.cache
def study():
    return nd.Study(
        variables={"a1": 0.0, "b2": 0.0, "theta_z": (-0.5, 0.5)}, constraints={"radius_ratio": (None, 2.0)}, starts=1
    )


@functools.cache
def result():
    return nd.optimize(study(), starts=1)


@functools.cache
def region_result():
    region = {"region": {"box": [0.1, 0.1, 0.1], "tilt_deg": 2.0}}
    limits = {"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0)}
    return nd.optimize(nd.Study(constraints=limits, objective=region, starts=1))


@functools.cache
def certificate():
    return region_result().certify(gap=0.5)


@functools.cache
def proof():
    return nd.prove_optimum(nd.Study.paper(), 3.7626590785960, gap=0.5)


@functools.cache
def front():
    return nd.pareto(study().with_solver(1), "radius_ratio", [1.8, 2.0])


@functools.cache
def trajectory():
    return nd.Trajectory.circle(c(), 0.1, points=9)


@functools.cache
def followed():
    return nd.follow(g(), trajectory(), c())


def study_with_actuators():
    return dataclasses.replace(study(), actuators=(nd.Actuator("one", 2.0, 5.0),), actuators_for="all")


@functools.cache
def admissible_rows():
    place = {"zp": 4.0, "zs": 2.4, "theta_z": 0.0, "b1": 3.0}
    return nd.admissible_actuators(study_with_actuators(), {"a2": (4.0, 8.0)}, at=place)


@functools.cache
def admissible_set():
    return nd.admissible(
        study(),
        {"a2": (4.0, 8.0), "b1": (2.0, 4.0)},
        at={"zp": 4.0, "zs": 2.4, "theta_z": 0.0},
        condition_number=9.0,
        resolution=0.2,
    )


@functools.cache
def swept():
    return nd.sweep(g(), c(), {"x_p": (-1.0, 1.0, 5)})


@functools.cache
def workspace():
    return nd.workspace(g(), (BOX[0], BOX[1]), tolerance=0.3, resolution=8)


BOX = ((-0.5, -0.5, 3.5), (0.5, 0.5, 4.5))


@functools.cache
def certified():
    return nd.certified_workspace(g(), BOX, criteria={"leg_limits": (0.5, 6.0)}, gap=0.9, most_boxes=100)


@functools.cache
def design():
    return nd.Design(g(), on_axis(), 1.0, "mm")


@functools.cache
def folder():
    return Path(tempfile.mkdtemp(prefix="entry-"))


def fresh(suffix=""):
    """A place where nothing is yet."""
    return folder() / f"{next(_PLACES)}{suffix}"


@functools.cache
def run():
    """A run folder with certificate and figures' data."""
    folder = nd.save(region_result(), fresh()).parent
    save_certificate(certificate(), folder / "certify.json")
    return folder


@functools.cache
def design_file():
    return nd.save(design(), fresh(".toml"))


@functools.cache
def study_file():
    study().save(path := fresh(".toml"))
    return path


def saved(thing):
    """The file of a result of arrays."""
    return thing.save(fresh(".npz"))


@functools.cache
def path_file():
    lines = ["t,x,y,z", "0,0,0,3.9", "1,0.1,0,3.9", "2,0.1,0.1,3.9", "3,0,0.1,3.95", "4,0,0,3.9"]
    (path := fresh(".csv")).write_text("\n".join(lines) + "\n")
    return path


def zeros(*shape):
    return np.zeros(shape)


@functools.cache
def proof_file():
    return proof().save(fresh(".certificate"))
