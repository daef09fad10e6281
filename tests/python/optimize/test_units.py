"""The same study in other units: the same verdict, the same optimum to 1e-10; the same bits for powers of two.

Only the lengths of the question change. Nothing but the answers is compared.
"""

import math
from dataclasses import replace

import pytest
from sizes import size

import ninedof as nd

UNITS = (1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9, 2.0**20, 2.0**-20)


def region(u, rule="shifted"):
    """With clearances, which were compared with a length without unit."""
    return nd.Study(
        variables={
            "a1": 0.0,
            "a2": (500 * u, 850 * u),
            "b1": (250 * u, 350 * u),
            "b2": 0.0,
            "zp": (400 * u, 600 * u),
            "zs": (200 * u, 400 * u),
        },
        constraints={
            "stroke_ratio": (None, 1.4),
            "base_cone": {"max_deg": 45.0},
            "leg_clearance": {"min": 20.0 * u},
            "platform_cone": {"max_deg": 45.0},
        },
        characteristic_length=150.0 * u,
        objective={"region": {"box": [60 * u, 60 * u, 40 * u], "tilt_deg": 10.0, "internal_point": rule}},
        starts=2,
    )


def placed(u):
    return region(u, "best")


def listed(u):
    radii = ("base_external_radius", "base_internal_radius", "platform_external_radius", "platform_internal_radius")
    return nd.Study(
        "symmetric",
        variables=dict.fromkeys(radii[:2], (50 * u, 600 * u))
        | dict.fromkeys(radii[2:], (50 * u, 300 * u))
        | {"zp": (200 * u, 700 * u), "zs": (50 * u, 650 * u)},
        constraints={
            "radius_ratio": (None, 2.0),
            "leg_length": {"min": 100 * u},
            "stroke": (None, 200 * u),
            "leg_clearance": {"radius": 12 * u},
            "joint_spacing": {"min": 40 * u},
        },
        characteristic_length=150 * u,
        objective={"poses": [{}, {"position": [30 * u, 0, 0]}, {"rotation_deg": [8, 0, 0]}]},
        starts=4,
    )


def infeasible(u):
    study = region(u)
    return replace(study, constraints=dict(study.constraints) | {"leg_clearance": {"min": 2000.0 * u}})


def unbounded(u):
    low = dict.fromkeys(("a1", "a2", "b1", "b2"), (0.0, math.inf)) | dict.fromkeys(("zp", "zs"), (0.05 * u, math.inf))
    return nd.Study(variables=low, constraints={}, characteristic_length=u, starts=4)


@pytest.mark.slow
@pytest.mark.parametrize(
    "study", [region, listed, infeasible, unbounded, *size([], [placed])], ids=lambda f: f.__name__
)
def test_the_unit_decides_nothing(study):
    known = nd.optimize(study(1.0))
    assert str(known.status) == {"infeasible": "infeasible", "unbounded": "unbounded"}.get(study.__name__, "optimal")
    if study in (region, placed):  # the machine of docs/requirement.md
        assert known.objective == pytest.approx({region: 4.023420, placed: 3.886753}[study], abs=2e-6)
    for unit in size((1e-9, 1e6, 2.0**20), UNITS):
        found = nd.optimize(study(unit))
        assert found.status == known.status, unit
        assert found.causes == known.causes, unit
        assert "None" not in found.reason
        if known.best is None:
            assert found.best is None
            continue
        assert found.objective == pytest.approx(known.objective, rel=1e-10), unit
        if math.frexp(unit)[0] == 0.5:
            assert found.objective == known.objective
            lengths = {
                name: value / unit
                for name, value in found.variables.items()
                if not name.endswith(("angle", "theta_z")) and "." not in name  # O at a pose is in parts of zp
            }
            assert lengths == {name: known.variables[name] for name in lengths}
