"""All machines of a box of designs at boxes of poses, in balls, and a robot at boxes of positions.

Written from docs/certificate.md and the pages on theory, with formulas of its own.
"""

from functools import cached_property

import numpy as np
from balls import Form, about_z, balls, cross, det, dot, stack, turn
from file_in_balls import PLATES, need
from flint import arb

POSE = 6  # coordinates of a pose; the poses come before the design
NEUTRAL, FIRST_LISTED = -1, -2


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

    @cached_property
    def rates(self):
        """Of the nine legs for a velocity of p, one about it, and one of O; transposed, what their forces do."""
        u = self.unit
        of_body = stack([self.screw(u[:3], self.end[:3]), -self.screw(u[3:6], self.s), self.screw(u[6:] * 0, self.s)])
        of_o = stack([u[:3] * 0, u[3:]], np.concatenate)
        return stack([of_body.reshape(9, 6).T, of_o.T], np.concatenate).T

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
        self.free = [k for k, (a, b) in enumerate(ends) if a < b]
        self.half = np.array([(arb(b) - a) / 2 for a, b in ends], object)[self.free]
        x = Form.coordinates([(arb(a) + b) / 2 for a, b in ends], ends, self.free)
        self.none = x.sum() * 0
        (self._mount_robot if file.space else self._mount_design)(x[POSE * len(pieces) :])
        stand = self._stand_in_space if file.space else self._stand
        self.at = [stand(piece, x[POSE * k : POSE * k + POSE]) for k, piece in enumerate(pieces)]

    def _mount_robot(self, _):
        file = self.file
        self.plate = self.none + file["joint"]
        self.platform = self.plate[6:]
        home = file["home"]
        self.home = Pose(self, self.none + home[:3], self.none + home[12:], self.none + nearest_rotation(home[3:12]))

    def _mount_design(self, x):
        file = self.file
        value = {name: self.none + low for name, low, _ in file["variable"]}
        value |= {file["variable"][k][0]: x[n] for n, k in enumerate(file.varied)}
        self.zp, self.zs, self.plate = value["zp"], value["zs"], self._plate(value)
        point, tool = balls(file["tool"][:3]), turn(self.none + file["tool"][3:])
        self.platform = (self.plate[6:] - point) @ tool
        q = about_z(value.get("theta_z", self.none))
        up = self.none + np.array([0, 0, 1])
        self.home = Pose(self, up * self.zp + dot(q, point), up * self.zs, q @ tool)

    def _plate(self, value):
        """The twelve joints of the plates in their own frames."""
        (family,) = self.file["family"]
        if family == "general":
            joints = [[value[f"{t}_{k}_{a}"] for a in "xyz"] for t in PLATES for k in (1, 2, 3)]
            return stack([stack(one) for one in joints])
        joints = []
        thirds = [arb(x) / 3 for x in (0, -2, -4)]
        c, s = (np.array([f(x) for x in thirds], object) for f in (arb.cos_pi, arb.sin_pi))
        for t in PLATES:
            if family == "hexagonal":
                one, two = (value[f"{'a' if t.startswith('base') else 'b'}{k}"] for k in (1, 2))
                x, y, z = one * (0.5 if "external" in t else -0.5), (one + two * 2) * (-1 / arb(12).sqrt()), self.none
            else:
                arm = about_z(value.get(f"{t}_angle", self.none))[:, 0] * value[f"{t}_radius"]
                x, y, z = arm[0], arm[1], value.get(f"{t}_height", self.none)
            joints.append(stack([x * c - y * s, x * s + y * c, z + 0 * c]).T)
        return stack(joints, np.concatenate)

    def _stand(self, piece, x):
        home, (shape, *_, own, unit) = self.home, self.file["region"]
        if piece == NEUTRAL:
            return home
        if piece <= FIRST_LISTED:
            *v, unit = self.file["pose"][FIRST_LISTED - piece]
            by, rest, shift = self.none + v[:3], turn(self.none + v[3:6]), self.none + v[6:]
        else:
            by, rest = x[:3], turn(x[3:6] * np.array([1, 1, 0])) @ about_z(x[5])
            if shape == "path":
                a, b = balls(self.file["corner"][piece : piece + 2])
                by = x[0] * (b - a) + a
            shift = by * (own == "shifted")
        scale = self.zp if unit == "zp" else 1.0
        return Pose(self, home.p + by * scale, home.s + shift * scale, rest @ home.q)

    def _stand_in_space(self, piece, x):
        """O follows from the position."""
        p, q, (rule, *point, share) = x[:3], nearest_rotation(self.file["rotation"][piece]), self.file["internal_point"]
        q = self.none + q
        lower, upper = (three.sum(0) * (arb(1) / 3) for three in (self.plate[3:6], self.platform[3:] @ q.T + p))
        s = {"fixed": self.none + point, "platform": p + dot(q, point), "between": lower + (upper - lower) * share}
        need(rule in s, "no rule for O")
        return Pose(self, p, s[rule], q)

    def widest(self, margins):
        """The coordinate that moves margins, or legs where of margins nothing is known, most; None where none does."""
        for forms in (margins, [at.along for at in self.at]) if self.free else ():
            moves = sum(one.moves(self.half).reshape(-1, len(self.free)).sum(axis=0) for one in forms)
            if np.isfinite(moves).all() and max(moves) > 0.0:
                return self.free[int(np.argmax(moves))]
        return None


def nearest_rotation(rows):
    """Of a matrix A whose A^T A - 1 is of size e: A = U P with U a rotation, and |P - 1| is at most e."""
    q = balls(rows).reshape(3, 3)
    far = abs(q.T @ q - np.eye(3)).sum()
    need(far < 1e-6 and dot(q[0], cross(q[1], q[2])) > 0, "a matrix is no rotation")
    return q + far * arb(0, 1)
