"""A second checker of certificates of sets, machines and optima over poses: balls of 80 bits and exact rationals.

Written from docs/certificate.md alone, with formulas of its own. It shares nothing with the package, the core or their
checker, and is slow: for small files.
"""

import math
import zlib
from fractions import Fraction
from itertools import product

import numpy as np
from balls import balls
from flint import ctx
from limits_in_balls import duty_of, wants_of
from machine_in_balls import FIRST_LISTED, NEUTRAL, POSE, Machine, names_of

FIRST = "ninedof certificate of designs 1\nchecksum "
STATES = ("inside", "outside", "undecided")
HERE = [(0.0, 0.0)] * POSE
CUTS = 20_000


class Refused(Exception):
    """The file is no proof."""


def need(true, why):
    if not true:
        raise Refused(why)


def number(word):
    need(word in ("inf", "-inf") or word.lstrip("-").startswith("0x"), f"{word} is no number")
    x = float.fromhex(word)
    need(abs(x) <= 1e100 or math.isinf(x), f"{word} is too large")
    return x


def numbers(words, count=None):
    need(count is None or len(words) == count, f"{words}: not {count} numbers")
    return [number(word) for word in words]


class File:
    """The question and the boxes, each number exact."""

    def __init__(self, data):
        text = data.decode("ascii")
        need(text.startswith(FIRST), "no certificate of designs")
        checksum, _, body = text[len(FIRST) :].partition("\n")
        need(checksum == f"{zlib.crc32(body.encode()):x}", "the checksum does not agree")
        lines = {}
        for line in body.splitlines():
            key, *words = line.split(" ")
            lines.setdefault(key, []).append(words)
        self._read_question(lines)
        self._read_duty(lines)
        self.shares = numbers(lines["shares"][0], 3)
        self.boxes = [self._box(words) for words in lines["box"]]

    def _read_question(self, lines):
        self.family = lines["family"][0][0]
        self.variables = [(name, number(low), number(high)) for name, low, high in lines["variable"]]
        need([v[0] for v in self.variables] == names_of(self.family) != [], "the variables are not those of the family")
        need(all(-math.inf < low <= high < math.inf for _, low, high in self.variables), "a variable has no bounds")
        self.varied = [k for k, (_, low, high) in enumerate(self.variables) if low < high]
        self.tool = np.array(numbers(lines["tool"][0], 6))
        self.length = number(lines["characteristic_length"][0][0])
        shape, *rest = lines["region"][0]
        self.shape, self.region = shape, numbers(rest[:5], 5)
        need(shape in ("none", "box", "ball", "cylinder", "path") and min(self.region) >= 0.0, "no region")
        self.shifted, self.in_zp = rest[5] == "shifted", rest[6] == "zp"
        self.corners = [numbers(words, 3) for words in lines.get("corner", [])]
        self.poses = [(numbers(words[:9], 9), words[9] == "zp") for words in lines.get("pose", [])]
        self.limits = [
            (w[0], number(w[1]), number(w[2]), w[3], w[4], numbers(w[5:], 3)) for w in lines.get("limit", [])
        ]
        self.exempt = {int(w[0]) for w in lines.get("exempt", [])}

    def _read_duty(self, lines):
        if not any(duty_of(name) for name, *_ in self.limits):
            return
        weights = numbers(lines["weights"][0], 8)
        self.gravity, self.masses = balls(weights[:3]), balls(weights[3:])
        self.legs = balls([numbers(words, 4) for words in lines["leg"]])
        self.loads = balls([numbers(words, 9) for words in lines["load"]])
        *speeds, rule = lines["speeds"][0]
        self.speeds = (*balls(numbers(speeds, 2)), rule)
        need(len(self.legs) == 9 and rule in ("shifted", "carried", "held", "least"), "no duty")
        least = [weights[3], weights[7], *self.legs[:, 0], *self.legs[:, 2], *self.speeds[:2]]
        need(all(x >= 0 and x.is_finite() for x in balls(least)), "a mass or a speed is none")

    def _box(self, words):
        d = 2 * len(self.varied)
        ends, state, rest = numbers(words[:d], d), words[d], words[d + 1 :]
        need(state in STATES and len(rest) == (15 if state == "outside" else 0), "no state of a box")
        poses = [(int(rest[k]), numbers(rest[k + 1 : k + 7])) for k in (1, 8) if rest]
        return list(zip(ends[::2], ends[1::2], strict=True)), state, int(rest[0]) if rest else None, poses


class Checker:
    def __init__(self, data):
        try:
            self.file = File(data)
        except (KeyError, IndexError, TypeError, ValueError) as error:
            raise Refused(f"a line is missing, too short or none: {error}") from None
        self.wants, self.unknown = wants_of(self.file)

    def roots(self, want):
        """The pieces at whose poses a limit holds, with the ends of their coordinates."""
        f = self.file
        if want.neutral:
            return [(NEUTRAL, HERE)]
        a, b, c, tilt, yaw = f.region
        sizes = {"ball": (a, a, a), "cylinder": (a, a, c), "path": (0.0, 0.0, 0.0)}.get(f.shape, (a, b, c))
        ends = [(-x, x) for x in (*sizes, tilt, tilt, yaw)]
        ends[0] = (0.0, 1.0) if f.shape == "path" else ends[0]
        out = [(k, ends) for k in range({"none": 0, "path": len(f.corners) - 1}.get(f.shape, 1))]
        out += [(FIRST_LISTED - k, HERE) for k in range(len(f.poses))]
        return out + [(NEUTRAL, HERE)] * (want.limit == 0 or not out)

    def discs(self, piece):
        first = {"ball": [(0, 3)], "cylinder": [(0, 2)]}.get(self.file.shape, [])
        return [(k, n, self.file.region[0]) for k, n in first] + [(3, 2, self.file.region[3])] if piece >= 0 else []

    def kept(self, want, designs):
        """Whether a limit holds over a box, cut until each margin has its sign; of parts only those not yet shown."""
        spots = product(self.roots(want), repeat=max(want.poses, 1))
        ahead = [([p for p, _ in spot], [e for _, ends in spot for e in ends] + designs, slice(None)) for spot in spots]
        for _ in range(CUTS):
            if not ahead:
                return True
            pieces, ends, rows = ahead.pop()
            if self.beside(pieces, ends):
                continue
            m = Machine(self.file, pieces, ends)
            margins = want.margins(want, m, True)[rows]
            still = np.flatnonzero(margins.ends(m.half)[0].max(axis=1) <= 0.0)
            if not len(still):
                continue
            k = m.widest([margins[still]])
            if k is None or (
                margins.middle.max(axis=1).min() < 0.0 and not self.beside(pieces, [(x, x) for x in m.middle])
            ):
                return False
            rows = still if isinstance(rows, slice) else rows[still]
            ahead += [(pieces, half, rows) for half in halves(ends, k)]
        return False

    def beside(self, pieces, ends):
        """Whether one of the boxes of poses has none of its region."""
        near = [max(a, -b, 0.0) for a, b in ends]
        discs = [(POSE * i + k, n, r) for i, piece in enumerate(pieces) for k, n, r in self.discs(piece)]
        return any(math.hypot(*near[k : k + n]) > r * (1 + 1e-12) for k, n, r in discs)

    def drawn(self, want, piece, x):
        """The coordinates of a pose, or of the nearest at which the limit holds."""
        ends = dict(self.roots(want)).get(piece)
        need(ends, "a pose at which the limit does not hold")
        x = [min(max(v, a), b) for v, (a, b) in zip(x, ends, strict=True)]
        for k, n, r in self.discs(piece):
            if (size := math.hypot(*x[k : k + n])) > r:
                x[k : k + n] = [v * (r / size) * (1 - 1e-12) for v in x[k : k + n]]
        return [(v, v) for v in x]

    def broken(self, limit, designs, poses):
        """Whether every part of the box breaks one side of the limit at the poses named."""
        need(0 <= limit < 2 + len(self.file.limits), "no limit")
        spots = []
        for want in (w for w in self.wants if w.limit == limit):
            named = [(NEUTRAL, [0.0] * POSE)] if want.poses == 0 else poses[: want.poses]
            spots.append((want, [p for p, _ in named], [e for pose in named for e in self.drawn(want, *pose)]))
        ahead = [designs]
        for _ in range(CUTS):
            if not ahead:
                return True
            box, open_margins = ahead.pop(), []
            for want, pieces, at in spots:
                m = Machine(self.file, pieces, at + box)
                margins = want.margins(want, m, False)
                if margins.ends(m.half)[1].max(axis=1).min() < 0.0:
                    break
                open_margins.append(margins)
            else:
                k = m.widest(open_margins) if spots else None
                if k is None:
                    return False
                ahead += [half[-len(box) :] for half in halves(at + box, k)]
        return False

    def run(self):
        f = self.file
        whole = [f.variables[k][1:] for k in f.varied]
        self.exempt_share_joints(whole)
        self.divides(whole)
        done, missing = dict.fromkeys(STATES, Fraction(0)), len(self.unknown)
        for ends, state, limit, poses in f.boxes:
            done[state] += volume(ends) / volume(whole)
            if state == "inside":
                missing += not all(self.kept(want, ends) for want in self.wants)
            elif state == "outside":
                missing += not self.broken(limit, ends, poses)
        for share, said in zip(done.values(), f.shares, strict=True):
            need(abs(float(share) - said) <= 1e-9, "the shares are not those of the boxes")
        return missing == 0

    def exempt_share_joints(self, whole):
        m = Machine(self.file, [], whole)
        for pair in self.file.exempt:
            need(0 <= pair <= 20, "no pair of legs")
            a, b = (pair, (pair + 1) % 3) if pair < 3 else ((pair - 3) // 6, 3 + (pair - 3) % 6)
            two = [(a, b), (6 + a, 6 + b)] if b < 3 else [(6 + a, 6 + b)] if b < 6 else [(a, b - 3)]
            size = [1e-12 * np.linalg.norm(m.plate[i].middle) for i, _ in two]
            apart = [np.abs((m.plate[i] - m.plate[j]).ends(m.half)).max() for i, j in two]
            need(
                any(x <= most for x, most in zip(apart, size, strict=True)),
                "a pair of legs that is exempt shares no joint",
            )

    def divides(self, whole):
        """Boxes within the whole, no two of which overlap, that have its volume."""
        low, high = (np.array([[e[k] for e in ends] for ends, *_ in self.file.boxes]) for k in (0, 1))
        for n, (ends, *_) in enumerate(self.file.boxes):
            need(all(a <= c < d <= b for (a, b), (c, d) in zip(whole, ends, strict=True)), "a box is outside")
            need(((low[n] < high) & (low < high[n])).all(axis=1).sum() == 1, "two boxes overlap")
        need(sum(volume(ends) for ends, *_ in self.file.boxes) == volume(whole), "a box is missing")


def halves(ends, k):
    a, b = ends[k]
    middle = 0.5 * a + 0.5 * b
    return [[*ends[:k], half, *ends[k + 1 :]] for half in ((a, middle), (middle, b))]


def volume(ends):
    return math.prod((Fraction(b) - Fraction(a) for a, b in ends), start=Fraction(1))


def check(data):
    """Return "proved", "incomplete" or why the file is refused."""
    ctx.prec = 80
    try:
        return "proved" if Checker(data).run() else "incomplete"
    except Refused as error:
        return f"refused: {error}"
