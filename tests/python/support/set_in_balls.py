"""A second checker of certificates of sets, machines and optima over poses: balls of 80 bits and exact rationals.

Written from docs/certificate.md alone, with formulas of its own. It shares nothing with the package, the core or their
checker, and is slow: for small files.
"""

import math
from fractions import Fraction
from itertools import product

import numpy as np
from file_in_balls import Refused, need, read_file
from flint import ctx
from limits_in_balls import PAIRS, wants_of
from machine_in_balls import FIRST_LISTED, NEUTRAL, POSE, Machine

HERE = [(0.0, 0.0)] * POSE
CUTS = 20_000


class Checker:
    def __init__(self, file):
        self.file = file
        self.wants, self.unknown = wants_of(file)
        self.shape, *self.region = file["region"][:6]

    def roots(self, want):
        """The pieces at whose poses a limit holds, with the ends of their coordinates."""
        if want.neutral:
            return [(NEUTRAL, HERE)]
        a, b, c, tilt, yaw = self.region
        sizes = {"ball": (a, a, a), "cylinder": (a, a, c), "path": (0.0, 0.0, 0.0)}.get(self.shape, (a, b, c))
        ends = [(-x, x) for x in (*sizes, tilt, tilt, yaw)]
        ends[0] = (0.0, 1.0) if self.shape == "path" else ends[0]
        pieces = {"none": 0, "path": len(self.file["corner"]) - 1}.get(self.shape, 1)
        out = [(k, ends) for k in range(pieces)] + [(FIRST_LISTED - k, HERE) for k in range(len(self.file["pose"]))]
        return out + [(NEUTRAL, HERE)] * (want.limit == 0 or not out)

    def discs(self, piece):
        first = {"ball": [(0, 3)], "cylinder": [(0, 2)]}.get(self.shape, [])
        return [(k, n, self.region[0]) for k, n in first] + [(3, 2, self.region[3])] if piece >= 0 else []

    def beside(self, pieces, ends):
        """Whether one of the boxes of poses has none of its region."""
        near = [max(a, -b, 0.0) for a, b in ends]
        discs = [(POSE * i + k, n, r) for i, piece in enumerate(pieces) for k, n, r in self.discs(piece)]
        return any(math.hypot(*near[k : k + n]) > r * (1 + 1e-12) for k, n, r in discs)

    def drawn(self, want, piece, x):
        """The coordinates of a pose, or of the nearest at which the limit holds."""
        ends = dict(self.roots(want)).get(piece)
        need(ends, "a pose at which the limit does not hold")
        x = np.clip(x, *np.transpose(ends))
        for k, n, r in self.discs(piece):
            x[k : k + n] *= min(1.0, r / (math.hypot(*x[k : k + n]) + 1e-300) * (1 - 1e-12))
        return [(v, v) for v in x.tolist()]

    def shown(self, want, kept, pieces, ends):
        """Whether a limit is kept, or broken, in a box of poses and designs, cut until that is seen of each part."""
        ahead = [ends]
        for _ in range(CUTS):
            if not ahead:
                return True
            ends = ahead.pop()
            if self.beside(pieces, ends):
                continue
            m = Machine(self.file, pieces, ends)
            margins = want.margins(want, m, kept)
            over = margins.over(m.half)
            open_margins = margins[np.flatnonzero(~(over > 0))] if kept else margins
            if (over > 0).all() if kept else (over < 0).any():
                continue
            k, middle = m.widest(open_margins), [(0.5 * a + 0.5 * b,) * 2 for a, b in ends]
            if k is None or (kept and margins.middle.min() < 0.0 and not self.beside(pieces, middle)):
                return False
            ahead += halves(ends, k)
        return False

    def inside(self, designs):
        return all(
            self.shown(want, True, [p for p, _ in spot], [e for _, ends in spot for e in ends] + designs)
            for want in self.wants
            for spot in product(self.roots(want), repeat=max(want.poses, 1))
        )

    def outside(self, designs, limit, *poses):
        """Whether one side of the limit is broken at the poses named."""
        poses = [(int(piece), x) for piece, *x in poses]
        return any(
            self.shown(want, False, [p for p, _ in at], [e for pose in at for e in self.drawn(want, *pose)] + designs)
            for want in self.wants
            for at in [poses[: want.poses] or [(NEUTRAL, [0.0] * POSE)]]
            if want.limit == int(limit)
        )

    def run(self):
        d = 2 * len(self.file.varied)
        whole = [tuple(self.file["variable"][k][1:]) for k in self.file.varied]
        need(all(isinstance(x, float) for row in self.file["box"] for x in row[:d]), "a box of other variables")
        boxes = [(list(zip(row[:d:2], row[1:d:2], strict=True)), *row[d:]) for row in self.file["box"]]
        exempt_share_joints(self.file, Machine(self.file, [], whole))
        divides(whole, [box for box, *_ in boxes])
        done, missing = {"inside": Fraction(0), "outside": Fraction(0), "undecided": Fraction(0)}, len(self.unknown)
        for box, state, *why in boxes:
            need(len(why) == 15 * (state == "outside"), "no state of a box")
            done[state] += volume(box) / volume(whole)
            if state == "inside":
                missing += not self.inside(box)
            elif state == "outside":
                missing += not self.outside(box, why[0], why[1:8], why[8:])
        for share, said in zip(done.values(), self.file["shares"], strict=True):
            need(abs(float(share) - said) <= 1e-9, "the shares are not those of the boxes")
        return missing == 0


def exempt_share_joints(file, m):
    for pair in file.exempt:
        need(0 <= pair <= 20, "no pair of legs")
        a, b = PAIRS[pair]
        ways = [(a, b), (6 + a, 6 + b)] if b < 3 else [(6 + a, 6 + b)] if b < 6 else [(a, b - 3)]
        shared = [
            (abs((m.plate[i] - m.plate[j]).over(m.half)) <= 1e-12 * np.linalg.norm(m.plate[i].middle)).all()
            for i, j in ways
        ]
        need(any(shared), "a pair of legs that is exempt shares no joint")


def divides(whole, boxes):
    """Boxes within the whole, no two of which overlap, that have its volume."""
    low, high = np.moveaxis(np.reshape(boxes, (len(boxes), len(whole), 2)), -1, 0)
    for n, box in enumerate(boxes):
        need(all(a <= c < d <= b for (a, b), (c, d) in zip(whole, box, strict=True)), "a box is outside")
        need(((low[n] < high) & (low < high[n])).all(axis=1).sum() == 1, "two boxes overlap")
    need(sum(volume(box) for box in boxes) == volume(whole), "a box is missing")


def halves(ends, k, middle=None):
    a, b = ends[k]
    middle = 0.5 * a + 0.5 * b if middle is None else middle
    need(a <= middle <= b, "a cut is beside its box")
    return [[*ends[:k], half, *ends[k + 1 :]] for half in ((a, middle), (middle, b))]


def volume(ends):
    return math.prod((Fraction(b) - Fraction(a) for a, b in ends), start=Fraction(1))


def check(data):
    """Return "proved", "incomplete" or why the file is refused."""
    ctx.prec = 80
    try:
        return "proved" if Checker(read_file(data)).run() else "incomplete"
    except Refused as error:
        return f"refused: {error}"
