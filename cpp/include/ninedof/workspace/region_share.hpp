#pragma once
/// How much of a region of poses keeps the criteria of a workspace.

#include <string>
#include <vector>

#include "ninedof/domains/region.hpp"
#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

struct RegionShare {
  double share = 0.0;               ///< of the even poses, 0 to 1
  long poses = 0;                   ///< looked at
  std::vector<std::string> passed;  ///< criteria that some pose passes
};

/// Looks at `count` even poses of a region, with its tilts and its rule for O, and at as many toward its boundary.
/// Poses count as connected with `home` where no determinant has changed its sign. Throws InvalidArgument for a region
/// or criteria that are not valid, Stopped on a stop.
RegionShare region_share(const Geometry& g, const Configuration& home, const WorkspaceCriteria& criteria,
                         const Region& region, long count, const Control& control = {});

}  // namespace ninedof
