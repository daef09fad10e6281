#pragma once
/// The three 3x3 matrices behind the determinants of singularity.hpp. Their rows have no unit and length 1 at most.

#include <Eigen/Geometry>
#include <array>

#include "math/rows_of.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Unit vectors of a robot, base frame. A vector without direction is zero, and so is the row made of it.
struct UnitVectors {
  Triple d;        ///< from O to the base joint of external leg i
  Triple w;        ///< from O to its platform joint
  Triple e_tilde;  ///< upper internal legs
  Triple e_hat;    ///< lower internal legs
};

/// Rows of N, B and C.
struct UnitRows {
  Triple n, b, c;
};

/// Definition of the rows: N has d^_i x w^_i, B has e^_i, C has e~_i.
inline UnitRows unit_rows(const UnitVectors& v) {
  return {{v.d[0].cross(v.w[0]), v.d[1].cross(v.w[1]), v.d[2].cross(v.w[2])}, v.e_hat, v.e_tilde};
}

/// Their determinant, in [-1, 1]. Never -0.0: a singularity has no side.
inline double determinant(const Triple& rows) {
  return rows[0].dot(rows[1].cross(rows[2])) + 0.0;
}

/// A vector between two points: length, and direction if it has one.
struct Span {
  double length = 0.0;
  Vec3 direction = Vec3::Zero();
};

/// The vectors of the three matrices, base frame. Differences of points below the rounding of coordinates are zero.
struct Spans {
  std::array<Span, 3> d, w;  ///< O -> base joint, O -> platform joint, of the external legs
  std::array<Span, 3> external, upper, lower;
};
Spans spans(const Geometry& g, const Configuration& c);

/// The rows of a robot. A leg of zero length makes its row zero, in N too.
UnitRows unit_rows(const Spans& k);

/// Whether the smallest singular value of a matrix is above rounding; false where it has NaN.
bool regular(const Mat3& rows);

/// Signs of det N, det B and det C, 0 where singular. They are constant along every motion without a singularity.
std::array<int, 3> sides(const UnitRows& rows);

}  // namespace ninedof
