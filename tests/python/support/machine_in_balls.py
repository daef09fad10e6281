"""All machines of a box of designs at boxes of poses, in balls.

Written from docs/certificate.md and the pages on theory, with formulas of its own.
"""

from functools import cached_property

import numpy as np
from balls import Form, about_z, balls, cross, det, dot, stack, turn
from flint import arb

PLATES = ("base_external", "base_internal", "platform_external", "platform_internal")
POSE = 6  # coordinates of a pose; the poses come before the design
NEUTRAL, FIRST_LISTED = -1, -2


def names_of(family):
    """The variables of a family in their order, none of an unknown one."""
    if family == "hexagonal":
        return ["a1", "a2", "b1", "b2", "zp", "zs", "theta_z"]
    if family == "general":
        return [f"{t}_{k}_{a}" for t in PLATES for k in (1, 2, 3) for a in "xyz"] + ["zp", "zs", "theta_z"]
    names = [f"{t}_{what}" for t in PLATES for what in ("radius", "angle")]
    names = [n for n in names if n != "base_external_angle"] + ["zp", "zs"]
    return {"symmetric": names, "symmetric_nonplanar": names + [f"{t}_height" for t in PLATES]}.get(family, [])


class Pose:
    """Where the legs are: l from base to platform, q from platform to O, r from base to O."""

    def __init__(self, m, p, s, q):
        self.p, self.s, self.q = p, s, q
        platform = m.platform @ q.T + p
        o = stack([s] * 6)
        self.start = stack([m.plate[:3], platform[3:], m.plate[3:6]], np.concatenate)
        self.end = stack([platform[:3], o], np.concatenate)
        self.along = self.end - self.start
        self.length = self.along.norm()

    @cached_property
    def unit(self):
        return self.along / self.length[:, None]

    def screw(self, direction, point):
        """What a unit force along a line does: itself and its moment about p. Also the rate that it stands for."""
        return stack([direction.T, cross(point - self.p, direction).T], np.concatenate).T

    def triples(self, units):
        """Rows whose determinants vanish at singularities: the external legs seen from O, the upper, the lower ones."""
        start, end = self.start[:3] - self.s, self.end[:3] - self.s
        seen = cross(start.unit(), end.unit()) if units else cross(start, end)
        legs = self.unit if units else self.along
        return det(stack([seen, legs[3:6], legs[6:9]]))


class Machine:
    """Coordinates are those of each pose, then the variables of the design that vary."""

    def __init__(self, file, pieces, ends):
        self.file = file
        self.middle = at = [min(max(0.5 * a + 0.5 * b, a), b) for a, b in ends]
        self.free = [k for k, (a, b) in enumerate(ends) if a < b]
        reach = [max((arb(ends[k][1]) - at[k]).abs_upper(), (arb(at[k]) - ends[k][0]).abs_upper()) for k in self.free]
        self.half = np.array(reach, object)
        x = Form.coordinates(at, ends, self.free)
        self.none = x.sum() * 0
        design = dict(zip(file.varied, range(POSE * len(pieces), len(ends)), strict=True))
        value = {v[0]: x[design[k]] if k in design else self.none + v[1] for k, v in enumerate(file.variables)}
        self.zp, self.zs, self.plate = value["zp"], value["zs"], self._plate(value)
        tool = turn(self.none + file.tool[3:])
        self.platform = (self.plate[6:] - file.tool[:3]) @ tool
        q = about_z(value.get("theta_z", self.none))
        up = self.none + np.array([0, 0, 1])
        self.home = Pose(self, up * self.zp + dot(q, file.tool[:3]), up * self.zs, q @ tool)
        self.at = [self._stand(piece, x[POSE * k : POSE * k + POSE]) for k, piece in enumerate(pieces)]

    def _plate(self, value):
        """The twelve joints of the plates in their own frames."""
        if self.file.family == "general":
            joints = [[value[f"{t}_{k}_{a}"] for a in "xyz"] for t in PLATES for k in (1, 2, 3)]
            return stack([stack(one) for one in joints])
        joints = []
        thirds = [arb(x) / 3 for x in (0, -2, -4)]
        c, s = (np.array([f(x) for x in thirds], object) for f in (arb.cos_pi, arb.sin_pi))
        for t in PLATES:
            if self.file.family == "hexagonal":
                one, two = (value[f"{'a' if t.startswith('base') else 'b'}{k}"] for k in (1, 2))
                x, y, z = one * (0.5 if "external" in t else -0.5), (one + two * 2) * (-1 / arb(12).sqrt()), self.none
            else:
                arm = about_z(value.get(f"{t}_angle", self.none))[:, 0] * value[f"{t}_radius"]
                x, y, z = arm[0], arm[1], value.get(f"{t}_height", self.none)
            joints.append(stack([x * c - y * s, x * s + y * c, z + 0 * c]).T)
        return stack(joints, np.concatenate)

    def _stand(self, piece, x):
        home, file = self.home, self.file
        if piece == NEUTRAL:
            return home
        in_zp = file.in_zp if piece >= 0 else file.poses[FIRST_LISTED - piece][1]
        scale = self.zp if in_zp else 1.0
        if piece <= FIRST_LISTED:
            v = self.none + file.poses[FIRST_LISTED - piece][0]
            by, rest, own = v[:3], turn(v[3:6]), v[6:]
        else:
            by = x[:3]
            if file.shape == "path":
                a, b = (balls(file.corners[piece + k]) for k in (0, 1))
                by = x[0] * (b - a) + a
            rest = turn(x[3:6] * np.array([1, 1, 0])) @ about_z(x[5])
            own = by if file.shifted else by * 0
        return Pose(self, home.p + by * scale, home.s + own * scale, rest @ home.q)

    def widest(self, margins):
        """The coordinate that moves margins, or legs where of margins nothing is known, most; None where none does."""
        for forms in (margins, [at.along for at in self.at]):
            moves = sum(one.moves(self.half).astype(float).sum(axis=(0, 1)) for one in forms)
            if self.free and np.isfinite(moves).all() and max(moves) > 0.0:
                return self.free[int(np.argmax(moves))]
        return None
