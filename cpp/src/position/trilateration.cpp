#include "ninedof/position/trilateration.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

constexpr double touching = 1e-14;  // least squared height, relative to the first radius squared
constexpr double refinable = 1e-6;  // height relative to the radius: below it the 3x3 system is too close to singular
constexpr double smallest = 1e-60;  // radius: the fifth power of a smaller one underflows
constexpr double squarable = 1e-150;  // length: the square of a smaller one has lost digits

/// One step of Newton's method on |x - c_i|^2 = R_i^2.
void refine(const SphereCentres& at, const Vec3& radii, Vec3& x) {
  const Vec3 a = x - at.centre[0], b = x - at.centre[1], c = x - at.centre[2];
  const Vec3 bc = b.cross(c);
  const double scale = 0.5 / a.dot(bc);
  const double fa = radii[0] * radii[0] - a.squaredNorm(), fb = radii[1] * radii[1] - b.squaredNorm(),
               fc = radii[2] * radii[2] - c.squaredNorm();
  x += scale * (fa * bc + fb * c.cross(a) + fc * a.cross(b));
}

}  // namespace

SphereCentres::SphereCentres(const Triple& centres) : centre(centres) {
  const Vec3 c12 = centres[1] - centres[0], c13 = centres[2] - centres[0];
  length = c12.norm();
  e1 = c12 / length;
  i = c13.dot(e1);
  const Vec3 across = c13 - i * e1;
  j = across.norm();
  e2 = across / j;
  e3 = e1.cross(e2);
}

Meeting meet(const SphereCentres& at, const Vec3& radii) {
  const double r1 = radii[0], r2 = radii[1], r3 = radii[2];
  const double x = 0.5 * ((r1 - r2) * (r1 + r2) / at.length + at.length);
  const double y = 0.5 * ((r1 - r3) * (r1 + r3) + at.i * at.i + at.j * at.j - 2.0 * x * at.i) / at.j;
  const double rho = std::sqrt(x * x + y * y);
  Meeting m;
  m.height2 = (r1 - rho) * (r1 + rho);
  // Rounding errors of x, y and the squared height: large if the first sphere is much smaller than the others.
  const double dx = eps * (r1 * r1 + r2 * r2 + at.length * at.length) / at.length;
  const double dy = (eps * (r1 * r1 + r3 * r3 + at.i * at.i + at.j * at.j) + 2.0 * std::abs(at.i) * dx) / at.j;
  const double error = 2.0 * (std::abs(x) * dx + std::abs(y) * dy) + dx * dx + dy * dy;
  const double tangent = std::max(touching * r1 * r1, 2.0 * error);
  if (!(m.height2 >= -tangent)) {
    m.certain = !std::isnan(m.height2) && std::isfinite(tangent) && at.length > squarable && at.j > squarable;
    return m;
  }
  m.above = at.centre[0] + x * at.e1 + y * at.e2;
  if (m.height2 <= tangent) {
    m.kind = Meeting::touching;
    m.error = dx + dy + std::sqrt(tangent);
    return m;
  }
  m.kind = Meeting::two_points;
  const double height = std::sqrt(m.height2);
  m.error = dx + dy + 0.5 * error / height;
  m.above += height * at.e3;
  if (height > refinable * r1 && r1 > smallest) refine(at, radii, m.above);
  return m;
}

}  // namespace ninedof
