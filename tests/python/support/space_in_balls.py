"""The second checker of certificates of workspaces: volumes of allowed positions as balls that hold them.

Of each limit that a box of positions neither keeps nor breaks, half-spaces bound the part where it is kept.
"""

import math
import struct
from itertools import product

from file_in_balls import Refused, need, read_file
from flint import arb, ctx, fmpq
from limits_in_balls import wants_of
from machine_in_balls import Machine
from set_in_balls import HERE, exempt_share_joints, halves

CUTS = {16: 12, 17: 12, 18: 5}  # of a box outside, inside or open, one in another, to see what it is said to be


class Space:
    def __init__(self, file):
        self.file = file
        self.wants, self.unknown = wants_of(file)
        exempt_share_joints(file, Machine(file, [], []))

    def run(self):
        """The volume, and whether all boxes inside and outside are that."""
        f, at, shown, total = self.file, 0, not self.unknown, arb(0)
        ways = [[(want, k) for want in self.wants] for k in range(len(f["rotation"]))]
        box = list(zip(f["space"][:3], f["space"][3:], strict=True))
        need(all(a < b for a, b in box), "no box of positions")
        ahead = [(box, ways if f["allowed_with"] == ["some"] else [[one for way in ways for one in way]])]
        while ahead:
            box, ways = ahead.pop()
            form = FORMS.get(f.tree[at]) if at < len(f.tree) else None
            need(form and at + struct.calcsize(form) <= len(f.tree), "a box of the tree is none")
            code, *words = struct.unpack_from(form, f.tree, at)
            at += struct.calcsize(form)
            if code < 6:
                low, high = halves(box, code % 3, *words)
                ahead += [(high, ways), (low, ways)]
                continue
            low, high = {16: (0, 0), 17: (1, 1), 18: words}[code]
            said = (arb(low) / 65535).union(arb(high) / 65535) if words else arb(low)
            own = self.allowed(box, ways, said, CUTS[code])
            need(own.overlaps(said * volume(box)), "a box does not have the share that is claimed")
            shown = shown and (code == 18 or own.rad() <= 1e-12 * volume(box))
            total += own
        need(at == len(f.tree), "the tree goes on after its last box")
        return total, shown

    def allowed(self, box, ways, said, cuts):
        """The volume in a box of which a share is said to be allowed, in parts until it is known as well as that."""
        share, ways = self.look(box, ways)
        if cuts == 0 or share.rad() <= said.rad() + 1e-12:
            return share * volume(box)
        k = max(range(3), key=lambda k: box[k][1] - box[k][0])
        return sum(self.allowed(half, ways, said, cuts - 1) for half in halves(box, k))

    def look(self, box, ways):
        """The share of a box that is allowed, and what it does not keep as a whole; one of the ways is enough."""
        low = high = fmpq(0)
        left, machines = [], {}
        for way in ways:
            still, lost, broken = [], fmpq(0), fmpq(0)
            for want, k in way:
                m = machines[k] = machines.get(k) or Machine(self.file, [k], [*box, *HERE[:3]])
                margins = want.margins(want, m, True)
                if (margins.over(m.half) > 0).all():
                    continue
                still.append((want, k))
                parts = [negative(row, m.half) for row in margins]
                lost += sum(most for _, most in parts)
                if want.name in ("condition_number", "fault_tolerant", "leg_clearance"):  # they have two lists
                    parts = [negative(row, m.half) for row in want.margins(want, m, False)]
                broken = max(broken, *(least for least, _ in parts))
            low, high = max(low, 1 - lost), high + 1 - broken
            left += [still] * (broken < 1)
        return arb(0 if self.unknown else low).union(arb(min(high, fmpq(1)))), left


FORMS = {code: "<B" for code in (0, 1, 2, 16, 17)} | {code: "<Bd" for code in (3, 4, 5)} | {18: "<BHH"}


def negative(row, half):
    """At least and at most the share of the box where a number is negative."""
    whole, moves = row.over(half), row.x[2:] * half
    if whole > 0 or whole < 0 or not all(v.is_finite() for v in (whole, *moves)):
        return fmpq(int(whole < 0)), fmpq(int(not whole > 0))
    slopes = [v.mid() for v in moves]
    c = row.x[0] + sum((v - s) * arb(0, 1) for v, s in zip(moves, slopes, strict=True))
    slopes = [s.fmpq() for s in slopes]
    return below(c.upper().fmpq(), slopes), below(c.lower().fmpq(), slopes)


def below(c, slopes):
    """The share of the box from -1 to 1 where c + slopes . t is negative: a box cut by a plane, corner by corner."""
    a = [abs(s) for s in slopes if s != 0]
    room = sum(a) - c
    if room <= 0 or room >= 2 * sum(a):
        return fmpq(int(room > 0))
    corners = product((0, 1), repeat=len(a))
    parts = ((-1) ** sum(w) * max(room - 2 * sum(map(fmpq.__mul__, a, w)), 0) ** len(a) for w in corners)
    return sum(parts) / math.prod((2 * (k + 1) * s for k, s in enumerate(a)), start=fmpq(1))


def volume(box):
    return math.prod((arb(b) - arb(a) for a, b in box), start=arb(1))


def check(data):
    """What is shown of a file, and a ball that holds the volume: "proved" is its own claim, or each of its boxes."""
    ctx.prec = 80
    try:
        file = read_file(data)
        own, shown = Space(file).run()
        low, high = file["volume"]
        need(own.overlaps(arb(low).union(arb(high))), "the volume is not that of the boxes")
    except Refused as error:
        return f"refused: {error}", None
    return "proved" if own >= low and own <= high and shown else "every box" if shown else "incomplete", own
