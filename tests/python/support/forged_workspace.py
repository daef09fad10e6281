"""Certificates of workspaces that are changed and sealed anew."""

import zlib

import numpy as np
from forged import lines_of

import ninedof as nd

FIRST = b"ninedof certificate of a workspace 1\nchecksum "
LEGS = {"leg_limits": (2.5, 6.5)}
BOX = ([-2.5, -2.5, 3.0], [2.5, 2.5, 7.0])
HOME = nd.Configuration.neutral(zp=4.8, zs=2.4)
AXES = np.array([[0.96, 0.0, 0.28], [0.0, 1.0, 0.0], [-0.28, 0.0, 0.96]])


def proof_of(robot, box=BOX, gap=0.3, **question):
    question.setdefault("home", HOME)
    return nd.certified_workspace(robot, box, gap=gap, **question)


def sealed(head, tree):
    body = "".join(f"{line}\n" for line in head).encode() + tree
    return FIRST + f"{zlib.crc32(body):x}\n".encode() + body


def parts_of(data):
    """The lines below the checksum, and the tree."""
    size = int(data[data.index(b"\ntree ") + 6 :].split(b"\n", 1)[0])
    return lines_of(data[: len(data) - size]), data[len(data) - size :]


def nodes_of(tree):
    """Where each cut and each leaf begins."""
    at = 0
    while at < len(tree):
        yield at
        code = tree[at]
        at += 1 if code < 3 else 9 if code < 6 else 5 if code == 18 else 1


def leaves_of(tree):
    return (at for at in nodes_of(tree) if tree[at] > 5)


def drawn_volume(lines, rng):
    """The volume that the question of a file has, by random positions, and four times the largest standard error."""
    rows = {}
    for line in lines:
        key, *words = line.split(" ")
        rows.setdefault(key, []).append(words)
    robot = nd.Geometry(*np.array([[float.fromhex(x) for x in words] for words in rows["joint"]]).reshape(4, 3, 3))
    low, high = np.array([float.fromhex(x) for x in rows["space"][0]]).reshape(2, 3)
    p = rng.uniform(low, high, (6000, 3))
    q = np.array([float.fromhex(x) for x in rows["rotation"][0]]).reshape(3, 3)
    lower, upper = robot.base_internal.mean(axis=0), p + q @ robot.platform_internal.mean(axis=0)
    rule, *x = rows["internal_point"][0]
    s = lower + float.fromhex(x[3]) * (upper - lower)
    if rule == "platform":
        s = p + q @ [float.fromhex(word) for word in x[:3]]
    poses = nd.Configuration(p, np.broadcast_to(q, (len(p), 3, 3)), s)
    bounds = {words[0]: [float.fromhex(x) if "x" in x else np.inf for x in words[1:3]] for words in rows["limit"]}
    lengths = nd.leg_lengths(robot, poses)
    kept = np.ones(len(p), bool)
    for k, name in enumerate(["l1", "l2", "l3", "q1", "q2", "q3", "r1", "r2", "r3"]):
        kept &= (bounds[name][0] <= lengths[:, k]) & (lengths[:, k] <= bounds[name][1])
    if "condition_number" in bounds:
        length = float.fromhex(rows["characteristic_length"][0][0])
        kept &= nd.condition_number(robot, poses, length) <= bounds["condition_number"][1]
    return kept.mean() * np.prod(high - low), 4.0 * np.prod(high - low) * np.sqrt(0.25 / len(p))
