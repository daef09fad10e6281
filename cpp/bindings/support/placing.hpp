#pragma once
/// What the placing of O has to reach, from what Python has of it.

#include <optional>
#include <vector>

#include "ninedof/optimize/region_placement.hpp"
#include "support/struct.hpp"

namespace ninedof::python {

/// A design of a problem without poses, and what placing O in a region has to reach for it.
struct PlacedDesign {
  Problem problem;
  Eigen::VectorXd variables;
  double log_index = 0.0;
  std::optional<LegLimits> leg_ranges;  ///< the lengths of the legs at every pose
  std::vector<Vec3> known;              ///< shifts of s in zp

  PlacementGoal goal() const {
    PlacementGoal out{log_index, {}};
    if (leg_ranges) out.ranges.push_back(range_of(*leg_ranges, problem.unit()));
    return out;
  }
};

}  // namespace ninedof::python
