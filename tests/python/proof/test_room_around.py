"""The room around a design in a set of admissible designs: where it ends, and what ends it."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from limit_oracle import limits_of, margins, robot_of
from region_oracle import random_poses

import ninedof as nd
from ninedof.design.domains.region_poses import posed
from ninedof.proof.admissible.result import NoRoom

SIZES = {"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": (2.0, 8.0), "zs": (1.0, 6.0)}
BOX = {"box": (0.4, 0.4, 0.3), "tilt": 0.12}
AT = {"zp": 5.0, "zs": 3.0}


def test_the_room_around_a_design():
    study = nd.Study(
        variables={"a1": 0.0, "a2": (2.0, 10.0), "b1": (1.0, 5.0), "b2": 0.0, "zp": 5.0, "zs": 3.0},
        constraints={"leg_length": (None, 7.0), "footprint": (None, 5.0)},
        objective={"region": BOX},
    )
    found = nd.admissible(study, ("a2", "b1"), at={"a2": 6.0, "b1": 3.0}, resolution=0.05)
    room = found.around()
    assert all(low < found.of.at[name] < high for name, (low, high) in room.items())
    rng = np.random.default_rng(6)
    least = math.inf
    for a2 in room["a2"]:
        for b1 in room["b1"]:
            there = posed(study, random_poses(nd.Region(**BOX), 800, rng, 1.0))
            robot = robot_of(there, dict(found.of.at) | {"a2": a2, "b1": b1})
            least = min(least, *(float(margins(limit, robot).min()) for limit in limits_of(there)))
    assert 0.0 < least < 0.02  # its sides go on until a limit is near
    reports = []
    assert found.around(progress=lambda *report: reports.append(report)) == room
    assert all(done > 0 and total == 2_000_000 for done, total, _ in reports)
    assert set(room.ended_by) == {"a2", "b1"}
    limits = {"leg length l", "footprint, at"}
    assert any(end.startswith(tuple(limits)) for two in room.ended_by.values() for end in two)
    for k, name in enumerate(room):  # what is said of each side is proved of some design in a slab beyond it
        for side, words in enumerate(room.ended_by[name]):
            ends = {one: list(two) for one, two in room.items()}
            far = ends[name][side] + (0.11, -0.11)[1 - side] * (ends[name][1] - ends[name][0])
            ends[name] = sorted((ends[name][side], far))
            beyond = nd.admissible(study, {one: tuple(two) for one, two in ends.items()}, resolution=0.05)
            broken = {" ".join((one.limit, one.part)).strip().replace("_", " ") for one in beyond.reasons}
            assert words.split(", at ")[0] in broken | {"a bound of the study"}, (k, name, words)
    wide = found.around(proportions={"a2": 2.0, "b1": 1.0})
    assert np.ptp(wide["a2"]) == pytest.approx(2.0 * np.ptp(wide["b1"]))
    turned = nd.admissible(
        replace(study, variables=SIZES | AT), {"theta_z_deg": (-10.0, 10.0)}, at=AT | {"a2": 6, "b1": 3}
    )
    assert turned.around(proportions={"theta_z_deg": 1.0}).keys() == {"theta_z"}
    with pytest.raises(ValueError, match=r"design: got a2 = 9.5, b1 = 1.5, expected one that is inside: it breaks"):
        found.around({"a2": 9.5, "b1": 1.5})
    with pytest.raises(ValueError, match=r"design.zp: got 4, expected 5, as in the set"):
        found.around({"a2": 6.0, "b1": 3.0, "zp": 4.0})


def test_a_design_on_a_limit_has_no_room():
    study = nd.Study(
        variables={"a1": 0.0, "a2": 6.0, "b1": 3.0, "b2": 0.0, "zp": (2.0, 8.0), "zs": 1.5},
        constraints={"height": (None, 5.0)},
    )
    found = nd.admissible(study, ("zp",), at={"zp": 5.0}, resolution=0.01)
    assert found.excluded["height"] == pytest.approx(0.5, abs=0.01)
    for zp in (5.0, 5.0 * (1.0 + 1e-7)):
        with pytest.raises(ValueError, match=r"it is on the limit height \(within 1e-06 of it\): no room on that side"):
            found.around({"zp": zp})
    with pytest.raises(ValueError, match=r"with every limit 0.1% wider zp may be \S+ to 5.00[45]\d*$") as error:
        found.around()
    low, high = map(float, str(error.value).rpartition(" may be ")[2].split(" to "))
    assert 2.0 <= low < 5.0 < 5.004 < high < 5.005  # what is proved ends within the wider limit, to 0.5 %
    with pytest.raises(ValueError, match="it breaks height"):
        found.around({"zp": 5.0 * (1.0 + 1e-5)})


def test_a_limit_without_width_is_no_error_of_the_design():
    study = nd.Study(
        variables={"a1": 0.0, "a2": 6.0, "b1": 3.0, "b2": 0.0, "zp": (2.0, 8.0), "zs": 1.5},
        constraints={"height": (5.0, 5.0)},
    )
    found = nd.admissible(study, ("zp",), at={"zp": 5.0}, resolution=0.1)
    with pytest.raises(ValueError, match="expected one around which a box is proved to be inside"):
        found.around({"zp": 5.0})


def test_an_answer_that_there_is_no_room_comes_back_from_another_process():
    one = NoRoom("a2 = 8", "it is on the limit leg length")
    other = pickle.loads(pickle.dumps(one))
    assert (str(other), other.reason) == (str(one), one.reason)
