#pragma once
/// The axes of two legs as segments, and which two legs can meet at all.

#include <algorithm>
#include <utility>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// The pairs of legs (order of leg_lengths) that need not meet: the internal ones all end in O, so that one of every two is
/// external. Three pairs of external legs, eighteen of an external and an internal one.
constexpr int leg_pairs = 21;

inline std::pair<int, int> leg_pair(int item) {
  if (item < 3) return {item, (item + 1) % 3};
  return {(item - 3) / 6, 3 + (item - 3) % 6};
}

/// Whether two joints are one.
inline bool joints_coincide(const Vec3& x, const Vec3& y) {
  return (x - y).squaredNorm() <= 1e-24 * (x.squaredNorm() + y.squaredNorm());
}

/// Where two segments come nearest: `s` and `t` of the way along each, and the vector from the second to the first.
struct Nearest {
  double s, t;
  Vec3 apart;
};

/// Of the segments from a to b and from c to d. The square of the distance is convex in (s, t): its least is inside the unit
/// square or on one of four sides.
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
