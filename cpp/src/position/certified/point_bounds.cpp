#include "position/certified/point_bounds.hpp"

#include "position/certified/quadratics.hpp"

namespace ninedof {
namespace {

/// A point of three spheres that lies in these bounds, in bounds at most as wide: rounding adds less to equations about
/// the middle than to the coordinates of a plane.
PointBounds narrowed(const PointBounds& bounds, const Triple& centres, const Vec3& radii) {
  std::array<Interval, 3> x{bounds.x, bounds.y, bounds.z};
  const Vec3 at{middle(x[0]), middle(x[1]), middle(x[2])};
  Vec3 reach;
  Quadratics spheres;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    reach[k] = std::max(detail::above(x[i].hi - at[k]), detail::above(at[k] - x[i].lo));
    const PointBounds away = bounds_of(at) - bounds_of(centres[i]);
    const Interval two = 2.0;
    spheres[i] = {square(away.x) + square(away.y) + square(away.z) - square(Interval(radii[k])),
                  {two * away.x, two * away.y, two * away.z},
                  {1.0, 0.0, 1.0, 0.0, 0.0, 1.0}};
  }
  const auto solved = solved_for_linear(spheres);
  if (!solved) return bounds;
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval y = Interval(at[static_cast<Eigen::Index>(i)]) - range((*solved)[i], reach);
    x[i] = {std::max(x[i].lo, y.lo), std::min(x[i].hi, y.hi)};
  }
  return {x[0], x[1], x[2]};
}

}  // namespace

std::vector<SidedPointBounds> meeting_bounds(const Triple& centres, const Vec3& radii) {
  // As `meet`, in intervals.
  const PointBounds c1 = bounds_of(centres[0]), a = bounds_of(centres[1]) - c1, b = bounds_of(centres[2]) - c1;
  const Interval one = 1.0, half = 0.5, length = norm(a);
  const PointBounds e1 = (one / length) * a, normal = cross(e1, b);
  const Interval i = dot(e1, b), j = norm(normal), r1 = radii[0], r2 = radii[1], r3 = radii[2];
  const PointBounds e3 = (one / j) * normal, e2 = cross(e3, e1);
  const Interval x = half * ((r1 - r2) * (r1 + r2) / length + length);
  const Interval y = half * ((r1 - r3) * (r1 + r3) + square(i) + square(j) - Interval(2.0) * x * i) / j;
  const Interval rho = sqrt(square(x) + square(y)), height2 = (r1 - rho) * (r1 + rho), height = sqrt(height2);
  if (height2.hi < 0.0) return {};
  const PointBounds foot = c1 + x * e1 + y * e2;
  if (height2.lo > 0.0)
    return {{narrowed(foot + height * e3, centres, radii), 1}, {narrowed(foot - height * e3, centres, radii), -1}};
  return {{foot + Interval(-height.hi, height.hi) * e3, 0}};
}

}  // namespace ninedof
