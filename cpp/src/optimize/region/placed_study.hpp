#pragma once
/// A study over a region with O placed anew at every pose.

#include "ninedof/optimize/region_study.hpp"

namespace ninedof {

/// A design is good if there is a range of lengths for each leg, allowed by the limits that compare poses, such that at
/// every pose some O keeps the index, the limits and the ranges. `shifted`: the optimum with O shifted, to begin from;
/// the result is not worse. `control` has the end of the time too, `caller` has not.
RegionResult optimize_region_placed(const Problem& problem, const Region& region, const RegionStudySettings& settings,
                                    const Control& control, const Control& caller, RegionResult shifted);

}  // namespace ninedof
