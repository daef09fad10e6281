#include "workspace/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ninedof {
namespace {

/// The square of the distance of two segments is convex in the places along them: its least is inside the unit square or on
/// one of four sides.
double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const auto clamp = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 1e-14 * uu * vv ? clamp((uv * vw - vv * uw) / determinant) : 0.0;
  double t = vv > 0.0 ? (uv * s + vw) / vv : 0.0;
  if (t < 0.0 || t > 1.0) {
    t = clamp(t);
    s = uu > 0.0 ? clamp((uv * t - uw) / uu) : 0.0;
  }
  return (w + s * u - t * v).norm();
}

}  // namespace

std::pair<int, int> leg_pair(int item) {
  if (item < 3) return {item, (item + 1) % 3};
  return {(item - 3) / 6, 3 + (item - 3) % 6};
}

std::array<bool, leg_pairs> pairs_sharing_a_joint(const Geometry& g) {
  const auto same = [](const Vec3& x, const Vec3& y) {
    return (x - y).squaredNorm() <= 1e-24 * (x.squaredNorm() + y.squaredNorm());
  };
  std::array<bool, leg_pairs> out{};
  for (int item = 0; item < leg_pairs; ++item) {
    const auto [one, two] = leg_pair(item);
    const auto a = static_cast<std::size_t>(one), b = static_cast<std::size_t>(two);
    const bool below = two < 3    ? same(g.base_external()[a], g.base_external()[b])
                       : two >= 6 ? same(g.base_external()[a], g.base_internal()[b - 6])
                                  : false;
    const bool above = two < 3   ? same(g.platform_external()[a], g.platform_external()[b])
                       : two < 6 ? same(g.platform_external()[a], g.platform_internal()[b - 3])
                                 : false;
    out[static_cast<std::size_t>(item)] = below || above;
  }
  return out;
}

Closest closest_legs(const Geometry& g, const Configuration& c, const std::array<bool, leg_pairs>& exempt) {
  std::array<Vec3, 9> from, to;
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = g.base_external()[i];
    to[i] = c.position + c.rotation * g.platform_external()[i];
    from[i + 3] = c.position + c.rotation * g.platform_internal()[i];
    from[i + 6] = g.base_internal()[i];
    to[i + 3] = to[i + 6] = c.internal_point;
  }
  Closest out{std::numeric_limits<double>::infinity(), -1};
  for (int item = 0; item < leg_pairs; ++item) {
    if (exempt[static_cast<std::size_t>(item)]) continue;
    const auto [one, two] = leg_pair(item);
    const auto a = static_cast<std::size_t>(one), b = static_cast<std::size_t>(two);
    const double distance = segment_distance(from[a], to[a], from[b], to[b]);
    if (distance < out.distance) out = {distance, item};
  }
  return out;
}

}  // namespace ninedof
