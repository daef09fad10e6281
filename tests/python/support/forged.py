"""Certificates of sets of designs that are changed and sealed anew."""

import math
import zlib

import numpy as np
from limit_oracle import limits_of, margins, robot_of
from region_oracle import random_poses

import ninedof as nd
from ninedof.design.domains.region_poses import posed

FIRST = "ninedof certificate of designs 1\nchecksum "


def sealed(lines):
    """The bytes of a file of these lines."""
    body = "".join(f"{line}\n" for line in lines).encode()
    return f"{FIRST}{zlib.crc32(body):x}\n".encode() + body


def tree_parts(data):
    """The lines below the checksum of a certificate of an optimum, and the bytes of its tree."""
    head, _, tree = data.partition(b"\ntree ")
    return head.decode().splitlines()[2:], tree.partition(b"\n")[2]


def sealed_tree(lines, tree):
    """The bytes of a certificate of an optimum."""
    body = "".join(f"{line}\n" for line in lines).encode() + f"tree {len(tree)}\n".encode() + tree
    return f"ninedof certificate 1\nchecksum {zlib.crc32(body):x}\n".encode() + body


def verdict_of(data, folder):
    """What the checker says of the bytes of a file."""
    path = folder / "forged.certificate"
    path.write_bytes(data)
    return nd.check_certificate(path)


def lines_of(data):
    """The lines below the checksum."""
    return data.decode().splitlines()[2:]


def spelled(x):
    """As the file has it: hexadecimal without needless digits."""
    if math.isinf(x):
        return "inf" if x > 0.0 else "-inf"
    mantissa, exponent = float(x).hex().split("p")
    return f"{mantissa.rstrip('0').rstrip('.') if '.' in mantissa else mantissa}p{exponent}"


def with_word(lines, n, place, word):
    words = lines[n].split(" ")
    words[place] = word
    return [*lines[:n], " ".join(words), *lines[n + 1 :]]


def line_of(lines, start):
    return next(n for n, line in enumerate(lines) if line.startswith(start))


def assert_refused_or_true(lines, kinds, change, verdict, holds, rng, count):
    """Change numbers of lines of these kinds, one a trial; return how many changes are proved and how many refused."""
    places = [
        (n, k)
        for n, line in enumerate(lines)
        if line.split(" ")[0] in kinds
        for k, word in enumerate(line.split(" "))
        if word.lstrip("-").startswith("0x") and float.fromhex(word) != 0.0
    ]
    proved = 0
    for _ in range(count):
        n, k = places[rng.integers(len(places))]
        forged = change(n, k, float.fromhex(lines[n].split(" ")[k]))
        if verdict(forged).proved:
            proved += 1
            assert holds(forged, rng), forged[n]
    return proved, count - proved


def no_limit_breaks(study, fixed, boxes, poses, rng):
    """Whether designs drawn from boxes of a2 and b1 keep the limits at poses drawn from the region, by numpy."""
    for box in boxes:
        ends = [float.fromhex(x) for x in box.split(" ")[1:5]]
        design = fixed | {"a2": rng.uniform(*ends[:2]), "b1": rng.uniform(*ends[2:])}
        there = posed(study, random_poses(study.objective.region, poses, rng))
        robot = robot_of(there, design)
        if any(np.min(margins(limit, robot)) < -1e-9 for limit in limits_of(there)):
            return False
    return True
