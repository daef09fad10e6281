#pragma once
/// A robot in a configuration as fourteen points in the base frame. Derivatives are taken with respect to these points.

#include <array>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {

/// Indices into Points: joint i of a triple has the index `triple + i`.
enum PointIndex : int {
  point_r = 0,         ///< r_i, base joints of the external legs
  point_r_hat = 3,     ///< r^_i, base joints of the lower internal legs
  point_u = 6,         ///< p + Q u_i
  point_u_tilde = 9,   ///< p + Q u~_i
  point_p = 12,
  point_s = 13,
  point_count = 14
};

/// The points, or the derivatives of a number with respect to them.
using Points = std::array<Vec3, point_count>;

/// The two ends of leg k, in the order of eq. (35b): l1 l2 l3 q1 q2 q3 r1 r2 r3. The unit vectors e, e~ and e^ point
/// from `from` to `to`.
struct LegEnds {
  int from, to;
};
constexpr LegEnds leg_ends(int k) {
  if (k < 3) return {point_r + k, point_u + k};
  if (k < 6) return {point_u_tilde + k - 3, point_s};
  return {point_r_hat + k - 6, point_s};
}

/// Lengths and directions of the nine legs. A leg of zero length has the direction zero.
struct NineLegs {
  Vec9 length;
  std::array<Vec3, 9> direction;
};
NineLegs nine_legs(const Points& at);

/// A robot at a pose: its points, its legs, and Q.
struct PosedPoints {
  Points at;
  NineLegs legs;
  Mat3 rotation;
};
PosedPoints posed_points(const Geometry& g, const Configuration& c);

/// The points of a robot in a configuration.
Points points(const Geometry& g, const Configuration& c);

}  // namespace ninedof
