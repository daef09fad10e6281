#include "position/path_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

/// The largest absolute value of a function that is linear between two values.
double largest(double from, double to) {
  return std::max(std::abs(from), std::abs(to));
}

double squared(double x) {
  return x * x;
}

}  // namespace

PlatePoint::PlatePoint(const SphereCentres& plate, const Vec3& point, const Vec3& r) : radii(r) {
  const Vec3 from_first = point - plate.centre[0];
  x = plate.e1.dot(from_first);
  y = plate.e2.dot(from_first);
  height = plate.e3.dot(from_first);
}

PathBounds path_bounds(const SphereCentres& plate, const PlatePoint& from, const PlatePoint& to) {
  // x is a multiple of r1^2 - r2^2, y of r1^2 - r3^2 and x: their first derivatives are linear, the second constant.
  const Vec3 rate = to.radii - from.radii;
  const double p0 = from.radii[0] * rate[0], p1 = to.radii[0] * rate[0];  // of r1^2 / 2
  const double x0 = (p0 - from.radii[1] * rate[1]) / plate.length, x1 = (p1 - to.radii[1] * rate[1]) / plate.length;
  const double y0 = (p0 - from.radii[2] * rate[2] - plate.i * x0) / plate.j,
               y1 = (p1 - to.radii[2] * rate[2] - plate.i * x1) / plate.j;
  const double xx = x1 - x0, yy = y1 - y0;
  const double in_plane2 = squared(largest(x0, x1)) + squared(largest(y0, y1));
  // The squared height is r1^2 - x^2 - y^2: half its second derivative, then its distance from a straight line.
  const double curvature = std::max(rate[0] * rate[0], in_plane2) + largest(from.x, to.x) * std::abs(xx) +
                           largest(from.y, to.y) * std::abs(yy) + 0.125 * (xx * xx + yy * yy);
  const double h0 = from.height * from.height, h1 = to.height * to.height;
  const double least2 = std::min(h0, h1) - 0.25 * curvature;
  if (!(least2 > 0.0)) return {infinity, infinity};
  const double least = std::sqrt(least2);
  const double up = (0.5 * std::abs(h1 - h0) + 0.5 * curvature) / least;
  return {std::sqrt(in_plane2 + up * up), std::sqrt(xx * xx + yy * yy + squared((curvature + up * up) / least))};
}

}  // namespace ninedof
