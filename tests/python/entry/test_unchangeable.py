"""What a result holds by name is its own: nobody changes it, and copies are as good."""

import copy
import json
import pickle

import entry_things as it
import pytest

HELD = {
    "variables of a candidate": lambda: it.result().best.variables,
    "prices of a candidate": lambda: it.result().best.prices,
    "variables of a point": lambda: point().variables,
    "gradient of a point": lambda: point().gradient,
    "margins of a point": lambda: point().margins,
    "gradients of margins": lambda: point().margin_gradients,
    "gradient of a margin": lambda: point().margin_gradients["radius_ratio"],
}


def point():
    return it.study().evaluate({"a2": 5.0, "b1": 3.0, "zp": 4.0, "zs": 2.0, "theta_z": 0.0})


@pytest.mark.parametrize("held", HELD)
def test_it_refuses_every_change(held):
    there, before = HELD[held](), dict(HELD[held]())
    name = next(iter(before), "a2")
    changes = [
        lambda: there.__setitem__(name, 0.0),
        lambda: there.__delitem__(name),
        lambda: there.update({name: 0.0}),
        lambda: there.setdefault("new", 0.0),
        lambda: there.pop(name),
        lambda: there.__ior__({name: 0.0}),
        there.popitem,
        there.clear,
    ]
    for change in changes:
        with pytest.raises(TypeError, match="cannot be changed"):
            change()
    assert there == before


def test_copies_and_files_of_it():
    there = it.result().best.variables
    for again in (copy.deepcopy(there), pickle.loads(pickle.dumps(there)), copy.copy(there)):
        assert again == there
        with pytest.raises(TypeError):
            again["a2"] = 0.0
    assert json.loads(json.dumps(there)) == there
    mine = dict(there)
    mine["a2"] = 0.0
    assert pickle.loads(pickle.dumps(it.result())).best.variables == there != mine
