#pragma once
/// A design as the optimizer differentiates it: twelve joints in their bodies' frames, the neutral configuration (eq.
/// 6), and the partial derivatives of both with respect to the variables of a family.

#include <array>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

/// More than any family has; keeps gradients off the heap.
constexpr int max_variables = 40;

/// Rows of Blueprint::gradient: three for each joint (in the order of PointIndex), then these.
enum BlueprintRow : int { row_zp = 36, row_zs, row_theta_z, blueprint_rows };

struct Blueprint {
  std::array<Vec3, 12> joint;  ///< r, r^ in the base frame; u, u~ in the platform frame
  double zp = 0.0, zs = 0.0, theta_z = 0.0;
  /// One row a number above, one column a variable.
  Eigen::Matrix<double, blueprint_rows, Eigen::Dynamic, Eigen::RowMajor, blueprint_rows, max_variables> gradient;
};

}  // namespace ninedof
