#pragma once
/// Names for the small fixed-size arrays of every room.

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "ninedof/math/xyz.hpp"

namespace ninedof {

using Vec3 = Eigen::Vector3d;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Vec9 = Eigen::Matrix<double, 9, 1>;
using Mat3 = Eigen::Matrix3d;
using Mat36 = Eigen::Matrix<double, 3, 6>;
using Mat39 = Eigen::Matrix<double, 3, 9>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat69 = Eigen::Matrix<double, 6, 9>;
using Mat9 = Eigen::Matrix<double, 9, 9>;
using Mat96 = Eigen::Matrix<double, 9, 6>;
using Mat93 = Eigen::Matrix<double, 9, 3>;

/// One vector for each of the three legs of a kind; 9 doubles, joint after joint.
using Triple = std::array<Vec3, 3>;

/// Converts a signed index, at least 0, to the index type of the standard library.
constexpr std::size_t at_index(std::ptrdiff_t k) {
  return static_cast<std::size_t>(k);
}

EIGEN_ALWAYS_INLINE Xyz<double> xyz(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
EIGEN_ALWAYS_INLINE Vec3 vec3(const Xyz<double>& v) {
  return {v.x, v.y, v.z};
}

}  // namespace ninedof
