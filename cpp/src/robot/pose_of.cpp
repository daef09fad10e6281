#include "robot/pose_of.hpp"

#include <algorithm>
#include <cmath>

namespace ninedof {

std::array<FormVector, 3> rotation_columns(const Mat3& q) {
  // A matrix with the singular values x is within max |x - 1| <= max |x^2 - 1| of its rotation, and that is at most
  // three times the greatest entry of Q^T Q - 1, itself rounded by less than 2^-50.
  const double defect = (q.transpose() * q - Mat3::Identity()).cwiseAbs().maxCoeff();
  const double error = 0x1p-49 + 3.0 * (1.0 + 0x1p-40) * defect;
  const auto entry = [&](Eigen::Index i, Eigen::Index j) {
    PoseForm out(q(i, j));
    out.r = error;
    return out;
  };
  std::array<FormVector, 3> out;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto col = static_cast<Eigen::Index>(k);
    out[k] = {entry(0, col), entry(1, col), entry(2, col)};
  }
  return out;
}

FormPose form_pose(const Configuration& c) {
  return {constant<PoseForm>(c.position), constant<PoseForm>(c.internal_point), rotation_columns(c.rotation)};
}

}  // namespace ninedof
