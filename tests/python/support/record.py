"""What every loop over limits says today, kept in tests/data/record.npz: rebuilding the core must not move it.

As a program it writes the record anew: `python record.py FILE`. A change of the file is a change of results.
"""

import sys
from pathlib import Path

import numpy as np

import ninedof as nd

FAMILIES = ("hexagonal", "symmetric", "symmetric_nonplanar", "general")
DESIGNS = 100
LIMITS = {
    "radius_ratio": [{"min": 0.6, "max": 2.0}],
    "leg_ratio": [{"max": 3.0}, {"max": 2.5, "at": "neutral"}],
    "stroke_ratio": (None, 1.4),
    "zs_fraction": [{"min": 0.3, "max": 0.7}],
    "stroke": [{"max": 0.4, "of": "zp"}],
    "leg_length": [{"min": 0.5, "max": 7.0}, {"min": 0.2, "max": 1.6, "of": "zp", "at": "neutral"}],
    "external_length": (2.0, 6.0),
    "upper_length": (1.0, 4.0),
    "lower_length": [{"min": 0.3, "max": 1.2, "of": "zp"}],
    "height": (2.0, 6.0),
    "footprint": (1.0, 4.0),
    "joint_height": [{"max": 0.3, "of": "radius"}],
    "joint_spacing": [{"min": 0.2, "of": "radius"}],
    "base_cone": [{"max_deg": 40.0}, {"max_deg": 60.0, "axis": [0.0, 0.6, 0.8], "at": "neutral"}],
    "platform_cone": [{"max_deg": 50.0, "axis": [0.0, 0.0, -1.0]}],
    "leg_clearance": [{"radius": 0.05}, {"min": 0.02, "of": "zp", "at": "neutral"}],
    "singularity_free": [{"min": 0.01, "steps": 3}, {"min": 0.02, "at": "neutral"}],
}
LATER = {
    "base_cone_external": {"max_deg": 40.0},
    "base_cone_internal": [{"max_deg": 50.0}, {"max_deg": 60.0, "axis": [0.0, 0.6, 0.8], "at": "neutral"}],
    "platform_cone_external": {"max_deg": 45.0, "axis": [0.0, 0.0, -1.0]},
    "platform_cone_internal": {"max_deg": 55.0},
    "fault_tolerant": (None, 8.0),
    "force": [{"max": 60.0}, {"max": 40.0, "at": "neutral"}],
    "external_force": (None, 50.0),
    "upper_force": (None, 40.0),
    "lower_force": (None, 30.0),
    "rate": (None, 2.0),
    "external_rate": (None, 1.5),
    "upper_rate": (None, 1.2),
    "lower_rate": (None, 1.0),
    "power": (None, 90.0),
}
DUTY = {
    "loads": {"wrenches": [[0.3, 0.0, 0.1, 0.0, 5.0, -40.0], [0.0, 1.0, 0.0, 8.0, 0.0, -20.0]]},
    "masses": {"platform": 2.0, "centre": (0.0, 0.1, 0.2), "rod": 0.2, "cylinder": 0.3, "internal_point": 0.1},
    "speeds": {"linear": 1.0, "angular": 0.4},
}
"""With `LATER`, the rows made since, every row of the table of constraints, with each option at least once."""

REQUIREMENT = {
    "family": "hexagonal",
    "unit": "mm",
    "characteristic_length": 150.0,
    "variables": {
        "a1": 0.0,
        "a2": (100.0, 850.0),
        "b1": (50.0, 350.0),
        "b2": 0.0,
        "zp": (300.0, 700.0),
        "zs": (50.0, 650.0),
        "theta_z": 0.0,
    },
    "constraints": {
        "stroke_ratio": (None, 1.4),
        "base_cone": {"max_deg": 45.0},
        "platform_cone": {"max_deg": 45.0},
        "leg_clearance": {"min": 20.0},
    },
    "starts": 2,
}
BOX = {"box": [60.0, 60.0, 40.0], "tilt_deg": 10.0}
NARROW = {"radius_ratio": (None, 2.0), "leg_ratio": (None, 3.0), "singularity_free": (0.05, None)}
SMALL = {"unit": "zp", "region": {"ball": 0.08, "tilt_deg": 8.0}}
REGIONS = {
    "requirement, certificate": REQUIREMENT | {"objective": {"region": BOX}},
    "requirement, O best, certificate": REQUIREMENT | {"objective": {"region": BOX | {"internal_point": "best"}}},
    "requirement, mean": REQUIREMENT | {"objective": {"region": BOX, "aggregate": "mean_inverse"}},
    "ball, certificate": {"constraints": NARROW, "objective": SMALL, "starts": 2},
    "cylinder": {
        "constraints": {"radius_ratio": (None, 2.0), "base_cone": {"max_deg": 50.0, "axis": [0.0, 0.0, 1.0]}},
        "objective": {"unit": "zp", "region": {"cylinder": [0.1, 0.05], "yaw_deg": 8.0}},
        "starts": 2,
    },
    "held, certificate": {
        "constraints": {"radius_ratio": (None, 2.0), "height": (None, 6.0)},
        "objective": {"unit": "zp", "region": {"box": [0.1, 0.1, 0.1], "internal_point": "held"}},
        "starts": 2,
    },
}
PAPER = nd.Geometry.hexagonal(0.0, 5.8124, 2.9062, 0.0)
HOME = nd.Configuration.neutral(3.9828, 2.4435)
CRITERIA = {
    "leg_limits": (2.0, 6.0),
    "base_cone": {"max": 0.6},
    "platform_cone": {"max": 0.75, "axis": [0.0, 0.0, -1.0]},
    "leg_clearance": 0.1,
    "condition_number": 6.0,
    "singularity_free": True,
}
PARTS = ("position", "rotation", "internal_point")
BOUNDS = ([-3.0, -3.0, 1.5], [3.0, 3.0, 7.0])


def flat(slopes):
    return [slope for name in sorted(slopes) for slope in slopes[name].values()]


def designs():
    """Every limit at random designs and poses: the margins of each label in turn, and their gradients."""
    return of_designs("", constraints=LIMITS) | of_designs(", later limits", constraints=LATER, **DUTY)


def of_designs(words, **entries):
    rng = np.random.default_rng(2026)
    out = {}
    for n in range(DESIGNS):
        family = FAMILIES[n % len(FAMILIES)]
        poses = [
            {"position": rng.uniform(-0.2, 0.2, 3).tolist(), "rotation": rng.uniform(-0.2, 0.2, 3).tolist()}
            for _ in range(3)
        ]
        poses[1]["internal_point"] = ("held", "shifted", "best")[n % 3]
        study = nd.Study(
            family=family,
            objective={"poses": poses, "aggregate": ("worst", "mean_inverse")[n % 2]},
            characteristic_length=(1.0, "natural", "mean_leg", "platform_radius")[n % 4],
            **entries,
        )
        names = study.variables
        x = {}
        for name in names:
            if name in study.angles:
                x[name] = rng.uniform(-1.0, 1.0)
            elif name.startswith(("base_", "platform_")) and name[-1] in "xyz":
                x[name] = rng.normal() * (3.0 if name[-1] != "z" else 0.3)
            else:
                x[name] = rng.uniform(0.5, 3.0)
        x["zp"] = rng.uniform(2.0, 5.0)
        x["zs"] = x["zp"] * rng.uniform(0.2, 0.8)
        point = study.evaluate(x)
        name = f"design {n:02d}{words}"
        out[f"{name}: margins"] = [point.margins[name] for name in sorted(point.margins)]
        out[f"{name}: gradients"] = [*flat(point.margin_gradients), *point.gradient.values()]
        if not words:
            out[f"{name}: conditions"] = [point.objective, point.neutral_condition_number, *point.conditions]
    return out


def region(name):
    """A region study, its sheet and its certificate."""
    result = nd.optimize(nd.Study(**REGIONS[name]))
    sheet = result.sheet().to_dict()
    out = {
        "optimum": [result.objective],
        "least margin": [result.region.margin],
        "shortest legs": [leg["shortest"] for leg in sheet["legs"]],
        "longest legs": [leg["longest"] for leg in sheet["legs"]],
        "margins": [row["margin"] for row in sheet["limits"]],
    }
    if "certificate" in name:
        proved = result.certify(gap=0.1)
        out["lengths"] = np.ravel(proved.lengths)
        out["limits"] = [(*limit.value, limit.margin) for limit in proved.limits]
        out["condition"] = proved.condition
    return {f"region {name}: {what}": values for what, values in out.items()}


def workspaces():
    """A workspace of each method."""
    out = {}
    for method, options in {
        "octree": {"tolerance": 0.02},
        "grid": {"resolution": 24},
        "sample": {"points": 2**13},
    }.items():
        criteria = CRITERIA | ({"singularity_free": False} if method == "sample" else {})
        space = nd.workspace(PAPER, BOUNDS, criteria=criteria, home=HOME, method=method, **options)
        out[f"workspace {method}"] = [space.volume]
    turning = nd.workspace(
        PAPER,
        archetype="orientation",
        position=HOME.position,
        region={"angle": 0.6},
        criteria={"leg_limits": (2.0, 6.0), "condition_number": 6.0},
        tolerance=0.05,
    )
    out["workspace orientation"] = [turning.volume]
    proved = nd.certified_workspace(PAPER, BOUNDS, criteria=CRITERIA, home=HOME, gap=0.1)
    out["workspace certified"] = [*proved.volume, *proved.home_volume]
    return out


def paths():
    """A motion with its limits, the best O of a few poses, and singularities."""
    rng = np.random.default_rng(7)
    where = HOME.position + 0.4 * rng.uniform(-1.0, 1.0, (20, 3))
    best = nd.best_internal_point(PAPER, where)
    moved = nd.follow(PAPER, nd.Trajectory.circle(HOME, 0.5, points=101), HOME, limits=(1.5, 6.5))
    return {
        "best O": best.value,
        "path: lengths": moved.leg_lengths[::10],
        "path: margins": moved.leg_margins[::10],
        **{f"nearest singularity, {part}": [nd.nearest_singularity(PAPER, HOME, part).distance] for part in PARTS},
    }


def optimum():
    """The certificate of the paper's optimum."""
    proof = nd.prove_optimum(nd.Study.paper(), 3.762659078596052)
    return {"optimum: bound, boxes": [proof.lower_bound, proof.boxes]}


def arrays(results):
    return {name: np.asarray(values, dtype=float).ravel() for name, values in results.items()}


if __name__ == "__main__":
    regions = [region(name) for name in REGIONS]
    every = {
        name: values
        for part in (designs(), workspaces(), paths(), optimum(), *regions)
        for name, values in part.items()
    }
    np.savez_compressed(Path(sys.argv[1]), **arrays(every))
