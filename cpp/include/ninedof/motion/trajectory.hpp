#pragma once
/// Poses of the platform over time.

#include <vector>

#include "ninedof/redundancy/redundancy_path.hpp"

namespace ninedof {

struct Trajectory {
  std::vector<double> time;         ///< increasing, at least three
  std::vector<PlatformPose> poses;  ///< one for each time, base frame

  /// Throws InvalidArgument naming what is wrong.
  void validate() const;
};

}  // namespace ninedof
