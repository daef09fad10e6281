#pragma once
/// The rates of the legs as rows, of a robot given by its points.

#include <Eigen/Geometry>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

struct LegRows {
  Mat6 a_e;   ///< rows of A, then of E
  Mat3 c, b;  ///< unit vectors of the upper and of the lower internal legs
};

inline LegRows leg_rows(const Points& at, const NineLegs& legs, double lc) {
  LegRows out;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &external = legs.direction[at_index(i)], &upper = legs.direction[at_index(i + 3)];
    const Vec3 u = at[at_index(point_u + i)] - at[point_p], u_tilde = at[at_index(point_u_tilde + i)] - at[point_p];
    out.a_e.row(i) << u.cross(external).transpose() / lc, external.transpose();
    out.a_e.row(i + 3) << u_tilde.cross(upper).transpose() / lc, upper.transpose();
    out.c.row(i) = upper;
    out.b.row(i) = legs.direction[at_index(i + 6)];
  }
  return out;
}

}  // namespace ninedof
