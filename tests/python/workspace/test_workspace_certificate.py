"""Certificates of workspaces: replayed by the checker; changed ones are refused, or what they say is true."""

import numpy as np
import pytest
from forged import spelled, verdict_of, with_word
from forged_workspace import AXES, BOX, LEGS, drawn_volume, leaves_of, parts_of, proof_of, sealed
from sizes import size

import ninedof as nd

INCH = 1.0 / 25.4


@pytest.fixture
def verdict(tmp_path):
    return lambda data: verdict_of(data, tmp_path)


QUESTIONS = {
    "legs, as long as they are beside the box": {"box": ([-9, -9, -9], [9, 9, 9])},
    "a hole": {"criteria": {"leg_limits": (4.4, 6.5)}, "box": ([-4, -4, -7], [4, 4, 7])},
    "tilted": {"rotation": AXES, "criteria": LEGS | {"singularity_free": True}},
    "no singularity": {"criteria": LEGS | {"condition_number": 5.0, "singularity_free": True}},
    "cones": {"criteria": LEGS | {"base_cone": {"max": 0.5, "axis": (0.1, 0, 1)}, "platform_cone": {"max": 0.4}}},
    "clearance": {"criteria": LEGS | {"leg_clearance": 0.3}},
    "a leg lost": {
        "criteria": LEGS | {"fault_tolerant": 10.0},
        "box": ([-0.3, -0.3, 4.5], [0.3, 0.3, 4.9]),
    },
    "carried": {"internal_point": {"platform": (0.0, 0.0, -2.2)}, "criteria": LEGS},
    "held": {"internal_point": (0.0, 0.0, 2.4), "criteria": LEGS},
    "some": {"archetype": "reachable", "orientations": np.stack([np.eye(3), AXES]), "criteria": LEGS},
    "all": {"archetype": "inclusive", "orientations": np.stack([np.eye(3), AXES]), "criteria": LEGS},
    "nothing": {"criteria": {"leg_limits": (0.1, 1.0)}},
    "nearly nothing": {"criteria": {"leg_limits": (3.2, 3.2000001)}, "gap": 0.999},
}


@pytest.mark.parametrize("name", QUESTIONS)
def test_every_kind_of_limit_is_replayed(name, published, verdict):
    proof = proof_of(published, **({"criteria": LEGS} | QUESTIONS[name]))
    found = verdict(proof.certificate.tobytes())
    assert found.proved, found.words
    low, high = (float(word) for word in found.words.split(" from ")[1].split(" to "))
    assert low == pytest.approx(proof.volume[0], rel=1e-3, abs=1e-5)
    assert high == pytest.approx(proof.volume[1], rel=1e-3, abs=1e-5)
    assert low <= proof.volume[0]
    assert high >= proof.volume[1]


def test_limits_of_forces_and_rates_are_replayed(verdict):
    plates = {"base_external_radius": 2.0, "base_internal_radius": 1.8, "platform_external_radius": 0.9}
    plates |= {"platform_internal_radius": 0.8, "zp": 2.5, "zs": 1.2, "platform_internal_angle": 0.3}
    plates |= {"base_internal_angle": 0.7, "platform_external_angle": 0.9}
    study = nd.Study(
        family="symmetric",
        variables=plates,
        constraints={"force": (None, 3.0), "rate": (None, 4.0), "leg_clearance": (0.01, None)},
        characteristic_length=1,
        loads={"wrenches": [[0, 0, 0, 0, 0, -1.0]]},
        speeds={"linear": 1.0, "angular": 1.0},
    )
    proof = nd.certified_workspace(nd.optimize(study), ([-0.6, -0.6, 2.2], [0.6, 0.6, 3.0]), gap=0.5)
    found = verdict(proof.certificate.tobytes())
    assert found.proved, found.words
    assert any("speeds up to 1 and 1" in line for line in found.study)


@pytest.mark.parametrize("unit", [INCH, 1e6])
def test_the_unit_does_not_matter(unit, published, verdict):
    p = published
    joints = (p.base_external, p.base_internal, p.platform_external, p.platform_internal)
    robot = nd.Geometry(*(unit * triple for triple in joints))
    criteria = {"leg_limits": (2.5 * unit, 6.5 * unit), "condition_number": 5.0, "leg_clearance": 0.2 * unit}
    home = nd.Configuration.neutral(zp=4.8 * unit, zs=2.4 * unit)
    box = tuple(unit * np.array(end) for end in BOX)
    proof = proof_of(robot, box, criteria=criteria, home=home, characteristic_length=unit)
    assert verdict(proof.certificate.tobytes()).proved


@pytest.fixture(scope="module")
def data(published):
    near = ([-1.2, -1.2, 3.2], [1.2, 1.2, 5.6])
    return proof_of(published, near, criteria=LEGS | {"condition_number": 5.0}).certificate.tobytes()


@pytest.mark.slow
def test_files_edited_at_random_are_refused_or_true(data, verdict):
    """A digit of the head makes another question; a byte of the tree cannot make another answer."""
    head, tree = parts_of(data)
    original, rng, proved, count = verdict(data), np.random.default_rng(3), 0, size(15, 100)
    places = [(n, k) for n, line in enumerate(head) for k, c in enumerate(line) if "0x" in line[:k] and c.isdigit()]
    for n, k in (places[i] for i in rng.choice(len(places), count, replace=False)):
        digit = str((int(head[n][k]) + int(rng.integers(1, 9))) % 10)
        forged = [*head[:n], head[n][:k] + digit + head[n][k + 1 :], *head[n + 1 :]]
        found = verdict(sealed(forged, tree))
        if found.proved:
            proved += 1
            low, high = (float(word) for word in found.words.split(" from ")[1].split(" to "))
            volume, error = drawn_volume(forged, rng)
            assert low - error <= volume <= high + error, head[n]
    for at in rng.integers(len(tree), size=count):
        found = verdict(sealed(head, tree[:at] + rng.bytes(1) + tree[at + 1 :]))
        proved += found.proved
        assert not found.proved or found.words == original.words
    assert proved < 1.8 * count


def test_what_a_box_is_called_has_to_be_true(data, verdict):
    head, tree = parts_of(data)
    for was, called in ((16, 17), (17, 16)):
        at = [n for n in leaves_of(tree) if tree[n] == was]
        found = verdict(sealed(head, tree[: at[-1]] + bytes([called]) + tree[at[-1] + 1 :]))
        assert not found.proved
        assert "does not have the share that is claimed" in found.words


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda tree: tree[:-1], "the tree ends too early"),
        (lambda tree: tree + b"\x10", "the tree goes on after its last box"),
        (lambda tree: b"\x03" + np.float64(7.5).tobytes() + b"\x10" + tree, "a cut is beside its box"),
        (lambda tree: b"\x63" + tree[1:], "byte 99 of the tree means nothing"),
        (lambda tree: tree[: next(leaves_of(tree))] + b"\x12\x00\x00\xff\xff", "the tree ends too early"),
    ],
)
def test_no_box_is_missing_or_laid_over_another(change, words, data, verdict):
    head, tree = parts_of(data)
    forged = change(tree)
    assert words in verdict(sealed([*head[:-1], f"tree {len(forged)}"], forged)).words


def test_no_smaller_gap_is_proved_by_the_same_boxes(data, verdict):
    head, tree = parts_of(data)
    n = len(head) - 2
    low, high = (float.fromhex(word) for word in head[n].split(" ")[1:])
    for place, value in ((1, 0.6 * low + 0.4 * high), (2, 0.4 * low + 0.6 * high)):
        found = verdict(sealed(with_word(head, n, place, spelled(value)), tree))
        assert not found.proved
        assert found.incomplete
        assert "not confirmed is the volume" in found.words
    above = f"volume {spelled(high * 1.01)} {spelled(high * 1.02)}"
    assert "is not that of the boxes" in verdict(sealed([*head[:n], above, *head[n + 1 :]], tree)).words


@pytest.mark.parametrize(
    ("key", "change", "words"),
    [
        ("joint", lambda line: [], "the joints are not twelve"),
        ("rotation", lambda line: [line.replace("0x1p+0", "0x1.8p+0", 1)], "a matrix is no rotation"),
        ("space", lambda line: [f"space {' '.join(line.split(' ')[4:] + line.split(' ')[1:4])}"], "is none"),
        ("internal_point", lambda line: [line.replace("between", "best")], "is no rule for O"),
        (
            "limit l1",
            lambda line: ["limit stroke 0x0p+0 0x1p+0 length poses 0x0p+0 0x0p+0 0x0p+0"],
            "no limit of a pose",
        ),
        (
            "limit l1",
            lambda line: ["limit magic 0x0p+0 0x1p+0 length poses 0x0p+0 0x0p+0 0x0p+0", line],
            "not checked: magic",
        ),
        ("limit l1", lambda line: [line.replace("poses", "neutral")], "none of a pose"),
        ("volume", lambda line: ["exempt 1", line], "exempt shares no joint"),
    ],
)
def test_what_is_no_question_is_refused(key, change, words, data, verdict):
    head, tree = parts_of(data)
    n = next(n for n, line in enumerate(head) if line.startswith(key))
    found = verdict(sealed([*head[:n], *change(head[n]), *head[n + 1 :]], tree))
    assert not found.proved
    assert words in found.words


def test_of_an_unknown_limit_the_volume_is_one_at_most(data, verdict):
    """What the checker does not know may exclude more than it sees."""
    head, tree = parts_of(data)
    found = verdict(sealed([line.replace("limit condition_number", "limit magic") for line in head], tree))
    assert (found.proved, found.incomplete) == (False, True)
    assert found.words.endswith("; not checked: magic")
    assert " have a volume of at most " in found.words
    least = float.fromhex(head[-2].split(" ")[1])
    assert float(found.words.split("of at most ")[1].split(";")[0]) > least


def test_the_run_of_a_workspace_is_checked(run, tmp_path):
    folder = tmp_path / "run"
    asked = "workspace --legs 2.5 6.5 --condition 5 --tolerance 1e-2 --x -2.5 2.5 --y -2.5 2.5 --z 3 7"
    assert run(f"{asked} --certify --gap 0.3 --no-figures --out {folder}")[0] == 0
    code, out, _ = run(f"check {folder}")
    assert code == 0
    assert "Proved: the positions of this box that keep every limit have a volume from" in " ".join(out.split())
    assert nd.load(folder).certified.certificate.size == (folder / "workspace.certificate").stat().st_size
