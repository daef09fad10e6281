#include "ninedof/statics/accuracy.hpp"

#include <Eigen/LU>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/math/error.hpp"
#include "singularity/unit_rows.hpp"
#include "statics/corners.hpp"

namespace ninedof {
namespace {

void require_tolerance(const char* name, double value) {
  if (value < 0.0 || std::isinf(value)) throw InvalidArgument(name, format_number(value), "finite lengths >= 0");
}

/// The joints at the lower and the upper end of leg k: indices into Tolerances::joints, -1 for O.
constexpr std::array<std::array<int, 2>, 9> joints_of_leg{
    {{0, 6}, {1, 7}, {2, 8}, {9, -1}, {10, -1}, {11, -1}, {3, -1}, {4, -1}, {5, -1}}};

}  // namespace

void validate(const Tolerances& t) {
  for (const double leg : t.legs) require_tolerance("leg_errors", leg);
  for (const double joint : t.joints) require_tolerance("joint_errors", joint);
}

Mat9 error_map(const Geometry& g, const Configuration& c) {
  const UnitRows rows = unit_rows(spans(g, c));
  const Mat3 n = rows_of(rows.n), b = rows_of(rows.b), upper = rows_of(rows.c);
  if (!(n + b + upper).allFinite()) return Mat9::Constant(not_a_number);
  Mat9 map = Mat9::Constant(infinity);
  if (!regular(b)) return map;
  map.bottomRows<3>() << Mat3::Zero(), Mat3::Zero(), b.inverse();
  if (regular(upper) && regular(n)) map.topRows<6>() = jacobian(g, c);
  return map;
}

ErrorBounds error_bounds(const Geometry& g, const Configuration& c, const Tolerances& t) {
  validate(t);
  const Mat9 map = error_map(g, c);
  Vec9 box = t.legs, variance = t.legs.cwiseAbs2() / 3.0;
  for (Eigen::Index leg = 0; leg < 9; ++leg)
    for (const int joint : joints_of_leg[at_index(leg)]) {
      if (joint < 0) continue;
      const double radius = t.joints[at_index(joint)];
      box[leg] += radius;                       // a joint error along its leg
      variance[leg] += radius * radius / 5.0;   // variance of one coordinate in a ball
    }
  if (map.hasNaN() || box.hasNaN()) {
    const Mat9 nothing = Mat9::Constant(not_a_number);
    return {nothing.col(0), not_a_number, not_a_number, not_a_number, nothing};
  }
  ErrorBounds out{Vec9::Constant(infinity), infinity, infinity, infinity, Mat9::Constant(not_a_number)};
  out.covariance.diagonal().setConstant(infinity);
  // The lengths determine nothing, O alone, or everything.
  const Eigen::Index first = std::isinf(map(8, 8)) ? 9 : std::isinf(map(0, 0)) ? 6 : 0, known = 9 - first;
  const Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::ColMajor, 9, 9> rows = map.bottomRows(known);
  out.components.tail(known) = (rows * box.asDiagonal()).rowwise().lpNorm<1>();
  out.covariance.bottomRightCorner(known, known) = rows * variance.asDiagonal() * rows.transpose();
  if (first <= 6) out.internal_point = farthest_corner(map.bottomRows<3>() * box.asDiagonal());
  if (first == 0) {
    out.rotation = farthest_corner(map.topRows<3>() * box.asDiagonal());
    out.position = farthest_corner(map.middleRows<3>(3) * box.asDiagonal());
  }
  return out;
}

}  // namespace ninedof
