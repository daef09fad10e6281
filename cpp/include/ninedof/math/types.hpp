#pragma once
/// Names for the small fixed-size arrays every layer speaks in. Aliases only.

#include <Eigen/Core>
#include <array>

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
using Mat93 = Eigen::Matrix<double, 9, 3>;

/// One vector for each of the three legs of a kind; 9 doubles, joint after joint.
using Triple = std::array<Vec3, 3>;

}  // namespace ninedof
