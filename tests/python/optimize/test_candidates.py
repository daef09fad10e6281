"""Candidates are distinct designs: what differs in something without effect is one of them."""

import itertools
import math

import numpy as np
import pytest
from sizes import size

import ninedof as nd

RATIO = {"radius_ratio": (None, 2.0)}
POSES = [{}, {"position": (0.1, 0.0, 0.0)}, {"rotation_deg": (10.0, 0.0, 0.0)}]
ONCE = {
    "size: only the shape matters": nd.Study(
        family="symmetric",
        constraints=RATIO | {"leg_ratio": (None, 3.0)},
        characteristic_length="mean_leg",
        objective={"poses": POSES, "unit": "zp"},
    ),
    "O of a robot with six legs": nd.Study(
        variables={"a1": (0.0, 1.0), "a2": (0.0, 1.0), "b1": (2.0, 3.0), "b2": (2.0, 3.0)},
        objective={"index": "six_legged"},
    ),
    "a shift of the base along z": nd.Study(
        family="symmetric_nonplanar",
        variables={"base_external_radius": 2.0, "base_internal_radius": 1.0, "platform_external_radius": 1.0}
        | {"platform_internal_radius": 0.5, "platform_external_height": 0.0, "platform_internal_height": 0.0}
        | {"platform_internal_angle": 1.0, "platform_external_angle": 0.2, "zs": (1.0, 2.0), "zp": (1.0, 3.0)},
        constraints={"leg_ratio": (None, 2.0)},
    ),
}


@pytest.mark.parametrize("study", ONCE.values(), ids=ONCE.keys())
def test_a_design_is_listed_once(study):
    result = nd.optimize(study)
    assert result.status == "optimal"
    assert result.best.reached > 1
    for a, b in itertools.pairwise(result.candidates):
        assert not math.isclose(a.objective, b.objective, rel_tol=1e-7)


def test_different_designs_as_good_are_listed():
    """Flat plates with legs within 4 : 1 reach the proved bound in many shapes."""
    result = nd.optimize(nd.Study(family="symmetric", constraints={"leg_ratio": (None, 4.0)}))
    assert len([c for c in result.candidates if math.isclose(c.objective, result.objective, rel_tol=1e-7)]) == 4


# --- Relabelling ------------------------------------------------------------------------------------------------------

THIRD = 2.0 * math.pi / 3.0
SKEW = {"poses": [{}, {"position": (0.5, 0.0, 0.0)}, {"rotation": (0.2, 0.0, 0.0)}]}  # not the same in a mirror
TRIPLES = ("base_external", "base_internal", "platform_external", "platform_internal")


def congruent(one, other):
    """Whether some numbering of the joints makes the distances of all points agree; external joints keep partners."""

    def distances(c, external, lower, upper):
        g, at = c.geometry, c.configuration
        base = [np.asarray(g.base_external)[list(external)], np.asarray(g.base_internal)[list(lower)]]
        platform = [np.asarray(g.platform_external)[list(external)], np.asarray(g.platform_internal)[list(upper)]]
        moved = [at.position + joints @ np.asarray(at.rotation).T for joints in platform]
        points = np.concatenate([*base, *moved, [at.internal_point]])
        return np.linalg.norm(points[:, None] - points[None], axis=-1)

    numberings = list(itertools.permutations(range(3)))
    wanted = distances(one, *numberings[:1] * 3)
    return any(
        np.abs(distances(other, *numbering) - wanted).max() <= 1e-4 * wanted.max()
        for numbering in itertools.product(numberings, repeat=3)
    )


def mirrored_hexagons(v):
    yield v | {"a1": v["a2"], "a2": v["a1"], "b1": v["b2"], "b2": v["b1"], "theta_z": -v["theta_z"]}


def turned_triples(v):
    angles = [name for name in v if name.endswith("_angle")]
    yield v | {name: -v[name] for name in angles}
    for name in ("base_internal_angle", "platform_internal_angle"):
        yield v | {name: v[name] + THIRD * (1 if v[name] < 0.0 else -1)}


def renumbered_joints(v):
    joints = {t: np.array([[v[f"{t}_{k}_{x}"] for x in "xyz"] for k in (1, 2, 3)]) for t in TRIPLES}

    def named(moved):
        return v | {f"{t}_{k + 1}_{x}": moved[t][k][n] for t in TRIPLES for k in range(3) for n, x in enumerate("xyz")}

    yield named({t: joints[t][[1, 2, 0]] for t in TRIPLES})
    yield named(joints | {"base_internal": joints["base_internal"][[1, 0, 2]]})
    yield named({t: joints[t] * [1.0, -1.0, 1.0] for t in TRIPLES})
    for angle in (THIRD, 0.7):
        turn = np.array([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
        yield named({t: joints[t] @ turn.T for t in TRIPLES})


PLANAR = {f"{t}_{k}_{x}": (-8.0, 8.0) for t in TRIPLES for k in (1, 2, 3) for x in "xy"} | {"zp": (1, 6), "zs": (1, 6)}
FREE_TWIST = {"theta_z": (-math.pi, math.pi)}
FAMILIES = {
    "hexagonal": (nd.Study(constraints=RATIO, variables=FREE_TWIST, objective=SKEW), mirrored_hexagons),
    "symmetric": (nd.Study(family="symmetric", constraints=RATIO, objective=SKEW), turned_triples),
    "symmetric_nonplanar": (nd.Study(family="symmetric_nonplanar", constraints=RATIO, objective=SKEW), turned_triples),
    "general": (nd.Study(family="general", variables=PLANAR, constraints=RATIO), renumbered_joints),
}


@pytest.mark.parametrize(("study", "others"), FAMILIES.values(), ids=FAMILIES.keys())
def test_designs_equal_up_to_relabelling_are_one_optimum(study, others):
    best = nd.optimize(study, starts=size(1 + (study.family == "hexagonal"), 32)).best
    alike = [v for v in others(best.variables) if study.evaluate(v).objective < best.objective * (1.0 + 1e-7)]
    assert alike
    result = nd.optimize(study, starts=1, warm=[best.variables, *alike[: size(2, 9)]])
    assert result.candidates
    for one, other in itertools.combinations(result.candidates, 2):
        assert not (math.isclose(one.objective, other.objective, rel_tol=1e-7) and congruent(one, other))
