"""Values of the right kind that an argument does not take: refused in one line that names it."""

import importlib

import entry_things as it
import numpy as np
import pytest
from entry_rows import ROWS

import ninedof as nd

importlib.import_module("entry_rows_design")
NAN, INF = float("nan"), float("inf")
STACK = nd.Configuration.neutral(4.0, [2.0, 2.5])
GRID = nd.Configuration.neutral(4.0, [[2.0]])
LENGTH = {"characteristic_length": (0.0, -1.0, NAN, INF, "metre", [1.0, 2.0])}
PART = {"part": ("translations", "", ["twist"])}
ERRORS = {name: (-1e-9, INF, [1.0] * 8) for name in ("leg_errors", "joint_errors")}
WEIGHTS = {"weights": tuple(np.where(np.arange(9) == 4, bad, 1.0) for bad in (0.0, -1.0, NAN, INF))}
SEARCH = {
    "criterion": ("dexterity", "leg_centring"),
    "limits": ((3.0, 2.0), 3.0, (np.ones(4), 2.0), (np.ones((2, 9)), 3.0)),
    "characteristic_length": (0.0, [1.0, 2.0]),
    "clearance": (0.0, -1.0),
    "start": ([1.0, 2.0], np.zeros((2, 3))),
    "rotation": (2.0 * np.eye(3),),
}
OUT_OF_RANGE = {
    **{name: LENGTH for name in ("jacobian", "velocity_matrices", "jacobian_rate", "axis_singular_values")},
    "condition_number": {
        **LENGTH,
        "norm": ("1", "fro", "", 2, INF, ["2"]),
        "threads": (0, -1, 1.0, True, "2", [1], 2**40),
    },
    "characteristic_length": {"kind": ("", "mean leg", "OPTIMAL", 1.0)},
    "internal_velocity": WEIGHTS,
    "inverse_velocity": {"weights": (np.ones(9),)},  # with a velocity of O
    "inverse_velocity: O chosen": WEIGHTS,
    "velocity_ellipsoid": {**PART, **LENGTH},
    "force_ellipsoid": {**PART, **LENGTH},
    "stiffness": {"leg_stiffness": (-1.0, INF)},
    "self_stress": {"configuration": (STACK,)},
    "error_bounds": ERRORS,
    "error_samples": {
        **ERRORS,
        "leg_errors": (*ERRORS["leg_errors"], np.zeros((2, 9))),
        "samples": (-1, 2.5),
        "seed": (-1, 0.5),
        "configuration": (STACK,),
    },
    "uncontrolled_motions": {"tolerance": (0.0, -1.0, NAN, INF, [1e-9, 1e-9]), "configuration": (STACK,)},
    "distance_to_singularity": {"most": (0.0, -1.0, NAN, INF), "direction": (np.full(9, INF),)},
    "nearest_singularity": {"part": ("twist",), "most": (-1.0,), "directions": (1.5,), "configuration": (GRID,)},
    "forward_position": {"leg_lengths": (-np.ones(9), np.zeros(9), np.full(9, INF), np.full(9, NAN))},
    "track": {"leg_lengths": (-np.ones(9), np.full(9, INF)), "start": (np.ones(15),)},
    "best_internal_point": SEARCH,
    "best_internal_path": {"position": ([0.0, 0.0, 3.98],), "smoothness": (0.0,), "start": (np.zeros((5, 3)),)},
    "best_internal_map": {
        **SEARCH,
        "seed_every": (0, 2.5),
        "audit_every": (0, True),
        "audit_seed": (-1,),
        "progress": (3,),
    },
}


@pytest.mark.parametrize("name", OUT_OF_RANGE)
def test_values_out_of_range_are_named(name):
    for argument, values in OUT_OF_RANGE[name].items():
        for value in values:
            arguments = {**ROWS[name].arguments(), argument: value}
            if argument == "criterion":
                arguments.pop("limits", None)
            with pytest.raises(
                ValueError, match=rf"^([\w, ]+, )?({argument}|limits of q1)\b[^:]*: got .+, expected .+"
            ):
                ROWS[name].call(**arguments)


def test_shapes_that_do_not_broadcast_are_named():
    stack = it.c().moved(np.zeros((5, 9)))
    motion = dict.fromkeys(("omega", "pdot", "sdot", "alpha", "pddot", "sddot"), np.zeros(3))
    for name in motion:
        with pytest.raises(ValueError, match=rf"leading dimensions do not broadcast.*{name} \(2,\)"):
            nd.inverse_acceleration(it.g(), stack, **{**motion, name: np.ones((2, 3))})
    with pytest.raises(ValueError, match="leading dimensions do not broadcast"):
        nd.track(it.g(), np.ones((3, 9)), stack)
