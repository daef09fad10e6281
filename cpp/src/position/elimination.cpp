/// Declared in position/rotation_problem.hpp.
///
/// One leg is satisfied identically, one angle is eliminated, and a polynomial of degree eight in the other angle
/// remains (docs/theory/position.md). The three equations are d . Q w = c, of rank one each, so
/// Q = X Rz(phi) Ry(a) Rz(psi) Y^T with X e3 = d_1, Y e3 = w_1 and cos a = c_1 satisfies the first for all phi and psi.
/// The others are A(phi) cos psi + B(phi) sin psi + C(phi) = 0 with A, B, C of first order in cos phi and sin phi.
/// Eliminating psi gives (B2 C3 - B3 C2)^2 + (C2 A3 - C3 A2)^2 = (A2 B3 - A3 B2)^2. General quadrics need the
/// elimination of Kukelova, Heller and Fitzgibbon (CVPR 2016) for the same degree, from forty times the coefficients
/// and with charts that can be unlucky; a circle has none.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "math/roots/circle_roots.hpp"
#include "position/rotation_problem.hpp"

namespace ninedof {
namespace {

/// a0 + a1 cos phi + a2 sin phi, times (1 + x^2) with x = tan(phi / 2 + pi / 4).
struct Quadratic {
  double k0, k1, k2;
};

Quadratic first_order(double a0, double a1, double a2) {
  return {a0 - a2, 2.0 * a1, a0 + a2};
}

using Quartic = std::array<double, 5>;

/// a b - c d
Quartic cross_product(const Quadratic& a, const Quadratic& b, const Quadratic& c, const Quadratic& d) {
  return {a.k0 * b.k0 - c.k0 * d.k0, (a.k0 * b.k1 + a.k1 * b.k0) - (c.k0 * d.k1 + c.k1 * d.k0),
          (a.k0 * b.k2 + a.k1 * b.k1 + a.k2 * b.k0) - (c.k0 * d.k2 + c.k1 * d.k1 + c.k2 * d.k0),
          (a.k1 * b.k2 + a.k2 * b.k1) - (c.k1 * d.k2 + c.k2 * d.k1), a.k2 * b.k2 - c.k2 * d.k2};
}

void add_square(const Quartic& a, double sign, Octic& out) {
  for (std::size_t i = 0; i < 5; ++i) {
    out[2 * i] += sign * a[i] * a[i];
    for (std::size_t j = i + 1; j < 5; ++j) out[i + j] += sign * 2.0 * a[i] * a[j];
  }
}

double value(const Quartic& a, double x, double y) {
  const double xx = x * x, xy = x * y, yy = y * y;
  return (a[0] * yy + a[1] * xy + a[2] * xx) * yy + (a[3] * xy + a[4] * xx) * xx;
}

/// Columns x1, x2, n: a frame with the third axis n and the second component of `towards` zero.
Mat3 frame(const Vec3& n, const Vec3& towards) {
  Vec3 x = towards - n.dot(towards) * n;
  if (x.squaredNorm() < 1e-6) x -= n.dot(x) * n;  // nearly parallel: perpendicular to rounding again
  const double size2 = x.squaredNorm();
  x = size2 > 1e-24 ? Vec3(x / std::sqrt(size2)) : n.unitOrthogonal();
  Mat3 m;
  m << x, n.cross(x), n;
  return m;
}

/// A, B, C of one leg, with d and w in the frames of the pivot.
struct PsiEquation {
  Quadratic a, b, c;
};

PsiEquation psi_equation(const Vec3& d, const Vec3& w, double c, double cosine, double sine) {
  // Rz(phi)^T d = (P, R, d_z) with P = dx cos + dy sin, R = dy cos - dx sin; S = cosine P - sine d_z.
  const double s0 = -sine * d[2], s1 = cosine * d[0], s2 = cosine * d[1];
  return {first_order(s0 * w[0], s1 * w[0] + d[1] * w[1], s2 * w[0] - d[0] * w[1]),
          first_order(-s0 * w[1], d[1] * w[0] - s1 * w[1], -d[0] * w[0] - s2 * w[1]),
          first_order(cosine * d[2] * w[2] - c, sine * d[0] * w[2], sine * d[1] * w[2])};
}

// Below this |(n1, n2)|, relative to the coefficients, psi is inaccurate: two solutions nearly share phi.
constexpr double separated = 1e-6;
// Error of the coefficients of the octic, relative to the squares they are summed from.
constexpr double rounding = 1e-14;
// Largest error of the coefficients relative to the largest of them. Usually 1e-14 to 1e-11. With nearly parallel
// directions everything cancels: at 1e-6 roots appear and disappear.
constexpr double coarse = 1e-9;

}  // namespace

RotationCandidates eliminated_rotations(const RotationProblem& problem, int pivot, double error) {
  const auto k1 = at_index(pivot), k2 = (k1 + 1) % 3, k3 = (k1 + 2) % 3;
  const auto c_of = [&](std::size_t k) { return problem.c[static_cast<Eigen::Index>(k)]; };
  const double cosine = c_of(k1), sine = std::sqrt(std::max(0.0, (1.0 - cosine) * (1.0 + cosine)));
  const Mat3 x_frame = frame(problem.d[k1], problem.d[k2]), y_frame = frame(problem.w[k1], problem.w[k2]);
  const auto equation = [&](std::size_t k) {
    return psi_equation(x_frame.transpose() * problem.d[k], y_frame.transpose() * problem.w[k], c_of(k), cosine, sine);
  };
  const PsiEquation e2 = equation(k2), e3 = equation(k3);
  const Quartic d = cross_product(e2.a, e3.b, e3.a, e2.b), n1 = cross_product(e2.b, e3.c, e3.b, e2.c),
                n2 = cross_product(e2.c, e3.a, e3.c, e2.a);
  Octic p{};
  add_square(n1, 1.0, p);
  add_square(n2, 1.0, p);
  add_square(d, -1.0, p);
  double size = 0.0;
  for (std::size_t k = 0; k < 5; ++k) size = std::max({size, std::abs(d[k]), std::abs(n1[k]), std::abs(n2[k])});
  double largest = 0.0;
  for (const double coefficient : p) largest = std::max(largest, std::abs(coefficient));
  const double octic_error = std::max(rounding, error) * size;
  CircleRoots roots = circle_roots(p, octic_error);
  if (!roots.certain && error > rounding) {  // roots of the equations as given, though the count is uncertain
    roots = circle_roots(p, rounding * size);
    roots.certain = false;
  }
  RotationCandidates out;
  out.reliable = roots.certain && octic_error <= coarse * largest;
  for (int k = 0; k < roots.count; ++k) {
    const auto [x, y] = roots.root[at_index(k)];
    const double dv = value(d, x, y), n1v = value(n1, x, y), n2v = value(n2, x, y);
    const double length = std::sqrt(n1v * n1v + n2v * n2v);
    if (!(length > separated * size)) {
      out.reliable = false;
      continue;
    }
    const double scale = std::copysign(1.0 / length, dv);
    const double cp = scale * n1v, sp = scale * n2v;
    // x / y = tan(phi / 2 + pi / 4): sine and cosine of phi + pi / 2 by the double angle.
    const double unit = 1.0 / (x * x + y * y);
    const double sf = (x * x - y * y) * unit, cf = 2.0 * x * y * unit;
    Mat3 inner;
    inner << cf * cosine * cp - sf * sp, -cf * cosine * sp - sf * cp, cf * sine,  //
        sf * cosine * cp + cf * sp, -sf * cosine * sp + cf * cp, sf * sine,  //
        -sine * cp, sine * sp, cosine;
    out.rotation[at_index(out.count++)].noalias() =
        (x_frame.lazyProduct(inner)).eval().lazyProduct(y_frame.transpose());
  }
  return out;
}

}  // namespace ninedof
