#pragma once
/// Poses of the platform.

#include <vector>

#include "ninedof/redundancy/redundancy_path.hpp"
#include "support/arrays.hpp"

namespace ninedof::python {

/// n poses as (n, 3) and (n, 3, 3), which Python has checked.
inline std::vector<PlatformPose> poses_from(const Array& position, const Array& rotation) {
  std::vector<PlatformPose> poses(static_cast<std::size_t>(position.size() / 3));
  for (std::size_t k = 0; k < poses.size(); ++k)
    poses[k] = {Eigen::Map<const Vec3>(position.data() + 3 * k),
                Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data() + 9 * k)};
  return poses;
}

}  // namespace ninedof::python
