#pragma once
/// Pairs of legs that could collide, and the distance of two legs as segments.

#include <algorithm>
#include <utility>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// The pairs of legs (in the order of leg_lengths) that do not share a joint. All internal legs end in O, so at least
/// one leg of a pair is external: three pairs of external legs, eighteen of an external and an internal leg.
constexpr int leg_pairs = 21;

inline std::pair<int, int> leg_pair(int item) {
  if (item < 3) return {item, (item + 1) % 3};
  return {(item - 3) / 6, 3 + (item - 3) % 6};
}

/// Whether two joints coincide, to rounding.
inline bool joints_coincide(const Vec3& x, const Vec3& y) {
  return (x - y).squaredNorm() <= 1e-24 * (x.squaredNorm() + y.squaredNorm());
}

/// The nearest points of two segments: their positions along each, from 0 to 1, and the vector from the second to the
/// first.
struct Nearest {
  double s, t;
  Vec3 apart;
};

/// For the segments from a to b and from c to d. The squared distance is convex in (s, t): its minimum lies inside the
/// unit square or on one of its four sides.
inline Nearest nearest(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
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
  return {s, t, w + s * u - t * v};
}

}  // namespace ninedof
