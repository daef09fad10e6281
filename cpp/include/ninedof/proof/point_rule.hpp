#pragma once
/// A rule that says where O is at every pose of a region: a polynomial in the coordinates of the pose.

#include <array>
#include <vector>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// s is its neutral position plus the sum of the coefficients, each times the product of the powers of x_k / scale_k,
/// where x is the shift of p (three lengths), the tilt (two components) and the yaw. All numbers are meant exactly.
struct PointRule {
  Vec6 scale = Vec6::Ones();
  std::vector<std::array<int, 6>> powers;
  std::vector<Vec3> coefficients;  ///< one for each term, lengths

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;
};

}  // namespace ninedof
