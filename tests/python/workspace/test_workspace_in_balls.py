"""Certificates of workspaces, read by the second checker: in balls, with formulas of its own."""

import numpy as np
import pytest
import space_in_balls
from forged import line_of, spelled, verdict_of, with_word
from forged_workspace import AXES, LEGS, leaves_of, nodes_of, parts_of, proof_of, sealed

CARRIED = {"internal_point": {"platform": (0.0, 0.0, -2.2)}}
QUESTIONS = {
    "carried": CARRIED,
    "some": CARRIED | {"archetype": "reachable", "orientations": np.stack([np.eye(3), AXES])},
    "all": CARRIED | {"archetype": "inclusive", "orientations": np.stack([np.eye(3), AXES])},
    "held, clearance": {"internal_point": (0.0, 0.0, 2.4), "criteria": LEGS | {"leg_clearance": 0.3}},
    "tilted, no singularity, cones": {
        "rotation": AXES,
        "criteria": LEGS
        | {"singularity_free": True, "base_cone": {"max": 1.1, "axis": (0.1, 0, 1)}, "platform_cone": 1.0},
    },
    "a leg lost": {"criteria": {"fault_tolerant": 10.0}, "box": ([0.1, 0.1, 4.5], [0.2, 0.2, 4.6]), "gap": 0.95},
    "condition": {"criteria": {"condition_number": 4.2}, "box": ([0.2, 0.2, 4.0], [0.3, 0.3, 4.2]), "gap": 0.95},
}


def claim_of(data):
    head, _ = parts_of(data)
    return [float.fromhex(word) for word in head[line_of(head, "volume")].split(" ")[1:]]


@pytest.mark.slow
@pytest.mark.parametrize("name", QUESTIONS)
def test_a_volume_is_proved_by_both_checkers(name, published):
    """By planes of its own, in up to 32 parts of an open box, it comes within the volume that is claimed."""
    data = proof_of(published, **({"gap": 0.7, "criteria": LEGS} | QUESTIONS[name])).certificate.tobytes()
    words, own = space_in_balls.check(data)
    low, high = claim_of(data)
    assert words == "proved"
    assert 0.0 < low <= own.lower() < own.upper() <= high


@pytest.fixture(scope="module")
def data(published):
    return proof_of(published, gap=0.7, criteria=LEGS, **CARRIED).certificate.tobytes()


def moved_cut(tree):
    """The cut above which nothing can be: of z."""
    n = [n for n in nodes_of(tree) if tree[n] == 5][1]
    return tree[: n + 1] + (np.frombuffer(tree[n + 1 : n + 9]) - 0.4).tobytes() + tree[n + 9 :]


def other_axis(tree):
    n = next(n for n in nodes_of(tree) if tree[n] < 3)
    return tree[:n] + bytes([(tree[n] + 1) % 3]) + tree[n + 1 :]


def called_inside(tree):
    n = next(n for n in leaves_of(tree) if tree[n] == 16)
    return tree[:n] + b"\x11" + tree[n + 1 :]


def called_outside(tree):
    """An open box, of those of which all is allowed but a little."""
    n = max((n for n in leaves_of(tree) if tree[n] == 18), key=lambda n: tree[n + 2])
    return tree[:n] + b"\x10" + tree[n + 5 :]


@pytest.mark.parametrize(
    "change", [moved_cut, other_axis, called_inside, pytest.param(called_outside, marks=pytest.mark.slow)]
)
def test_another_tree_is_refused(change, data):
    head, tree = parts_of(data)
    forged = change(tree)
    head = [*head[:-1], f"tree {len(forged)}"]
    assert space_in_balls.check(sealed(head, forged))[0] == "refused: a box does not have the share that is claimed"


@pytest.mark.parametrize(
    ("start", "place", "factor"),
    [("limit l1", 3, 0.8), ("limit q2", 2, 1.3), ("joint", 2, 1.3), ("space", 6, 0.8), ("internal_point", 4, 0.8)],
)
def test_another_question_is_refused(start, place, factor, data):
    head, tree = parts_of(data)
    n = line_of(head, start)
    forged = with_word(head, n, place, spelled(float.fromhex(head[n].split(" ")[place]) * factor))
    assert space_in_balls.check(sealed(forged, tree))[0].startswith("refused")


def test_another_volume_is_not_proved(data):
    head, tree = parts_of(data)
    n, high = line_of(head, "volume"), claim_of(data)[1]
    for a, b, words in ((high, 2.0 * high, "refused"), (0.9 * high, high, "every box")):
        forged = [*head[:n], f"volume {spelled(a)} {spelled(b)}", *head[n + 1 :]]
        assert space_in_balls.check(sealed(forged, tree))[0].startswith(words)


def test_a_leg_lost_is_too_much_for_a_tighter_bound(published, tmp_path):
    """Both checkers find the greatest number of this box between 4.6 and 5."""
    box, criteria = ([0.1, 0.1, 4.5], [0.12, 0.12, 4.52]), {"fault_tolerant": 10.0}
    head, tree = parts_of(proof_of(published, box, 0.95, criteria=criteria).certificate.tobytes())
    n = line_of(head, "limit fault_tolerant")
    for bound, words in ((4.6, "refused: a box does not have"), (5.0, "proved")):
        forged = sealed(with_word(head, n, 3, spelled(bound)), tree)
        assert space_in_balls.check(forged)[0].startswith(words)
        assert verdict_of(forged, tmp_path).proved == (words == "proved")
