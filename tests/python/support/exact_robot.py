"""The robot in balls of 400 bits (python-flint): the oracle of certified numbers.

Shares with the package only the paper: every matrix from its defining equation, eqs. (11)-(13) and (30)-(36), and the
condition number from the eigenvalues of (J' J'^T)^-1. Doubles are taken as exact, Q as it stands.
"""

from flint import acb_mat, arb, arb_mat, ctx

BITS = 400
ZERO = arb(0)


def vector(v):
    return [arb(float(x)) for x in v]


def minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def plus(a, b):
    return [x + y for x, y in zip(a, b, strict=True)]


def times(k, a):
    return [k * x for x in a]


def dot(a, b):
    return sum((x * y for x, y in zip(a, b, strict=True)), ZERO)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def norm(a):
    return dot(a, a).sqrt()


def unit(a):
    return times(1 / norm(a), a)


class ExactRobot:
    """One robot at one pose."""

    def __init__(self, geometry, configuration):
        ctx.prec = BITS
        p, s = vector(configuration.position), vector(configuration.internal_point)
        q = [vector(row) for row in configuration.rotation]
        self.y = minus(s, p)
        self.u = [[dot(row, vector(u)) for row in q] for u in geometry.platform_external]
        self.ut = [[dot(row, vector(u)) for row in q] for u in geometry.platform_internal]
        r, rh = ([vector(v) for v in t] for t in (geometry.base_external, geometry.base_internal))
        self.external = [minus(plus(p, u), b) for u, b in zip(self.u, r, strict=True)]
        self.upper = [minus(self.y, u) for u in self.ut]
        self.lower = [minus(s, b) for b in rh]
        self.to_base = [minus(b, s) for b in r]
        self.to_platform = [minus(u, self.y) for u in self.u]

    def lengths(self):
        return [norm(v) for v in (*self.external, *self.upper, *self.lower)]

    def determinants(self):
        n = [cross(unit(d), unit(w)) for d, w in zip(self.to_base, self.to_platform, strict=True)]
        rows = (n, [unit(v) for v in self.lower], [unit(v) for v in self.upper])
        return [arb_mat(m).det() for m in rows]

    def matrices(self, lc):
        """F, 6x6, and G, 6x9, of eqs. (34)-(35)."""
        lc = arb(float(lc))
        a = [times(1 / lc, cross(u, unit(x))) + unit(x) for u, x in zip(self.u, self.external, strict=True)]
        e = [times(1 / lc, cross(u, unit(x))) + unit(x) for u, x in zip(self.ut, self.upper, strict=True)]
        c, b = arb_mat([unit(x) for x in self.upper]), arb_mat([unit(x) for x in self.lower])
        ratio = c * b.inv()
        g = arb_mat(6, 9)
        for i in range(3):
            g[i, i], g[i + 3, i + 3] = arb(1), arb(-1)
            for j in range(3):
                g[i + 3, j + 6] = ratio[i, j]
        return arb_mat(a + e), g

    def jacobian(self, lc=1.0):
        f, g = self.matrices(lc)
        return f.solve(g)

    def singular_values(self, lc=1.0):
        """Of J', descending, to some hundred digits less those that the condition number costs."""
        f, g = self.matrices(lc)
        # (J' J'^T)^-1 = F^T (G G^T)^-1 F has the eigenvalues 1 / sigma^2; F may be nearly singular, G G^T >= 1.
        inverse = f.transpose() * (g * g.transpose()).solve(f)
        values = acb_mat(inverse).eig(algorithm="approx")
        return sorted((1 / v.real.sqrt() for v in values), key=lambda x: -float(x.mid()))

    def condition_number(self, lc=1.0):
        sigma = self.singular_values(lc)
        return sigma[0] / sigma[-1]
