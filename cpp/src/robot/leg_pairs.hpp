#pragma once
/// Pairs of legs that can collide, and the distance between the axes of two legs.

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "math/numbers.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

/// The pairs of legs (order of leg_lengths) that can be apart. The internal legs all end in O, so that one leg of each
/// pair is external: three pairs of external legs, eighteen of an external and an internal one.
constexpr int leg_pairs = 21;

inline std::pair<int, int> leg_pair(int item) {
  if (item < 3) return {item, (item + 1) % 3};
  return {(item - 3) / 6, 3 + (item - 3) % 6};
}

/// Whether two joints are in the same place.
inline bool joints_coincide(const Vec3& x, const Vec3& y) {
  return (x - y).squaredNorm() <= 1e-24 * (x.squaredNorm() + y.squaredNorm());
}

/// Whether the legs of a pair share a joint; the twelve joints in the order of Points, each in the frame of its body.
inline bool share_joint(std::span<const Vec3, 12> joint, int pair) {
  const auto [a, b] = leg_pair(pair);
  const LegEnds one = leg_ends(a), two = leg_ends(b);
  const auto same = [&](int i, int j) { return joints_coincide(joint[at_index(i)], joint[at_index(j)]); };
  // Leg a is external, from the base to the platform. An upper leg starts on the platform, all others on the base.
  return same(two.from < point_u ? one.from : one.to, two.from) || (b < 3 && same(one.to, two.to));
}

/// The nearest points of two segments: the fractions s and t along them, and the vector from second to first.
struct Nearest {
  double s, t;
  Vec3 apart;
};

/// Of a-b and c-d. The squared distance is convex in (s, t): least inside the unit square or on one of its sides.
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

/// Of the axes of a pair of legs.
inline Nearest nearest(const Points& at, int pair) {
  const auto [a, b] = leg_pair(pair);
  const LegEnds one = leg_ends(a), two = leg_ends(b);
  const auto point = [&](int k) -> const Vec3& { return at[at_index(k)]; };
  return nearest(point(one.from), point(one.to), point(two.from), point(two.to));
}

}  // namespace ninedof
