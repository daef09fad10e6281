#pragma once
/// One local minimum from a start near it, such as the best point of a neighbouring pose.

#include "redundancy/search/multi_start.hpp"

namespace ninedof {

/// The minimum reached from `start`, which lies in the chamber of the objective: at most one, none where no point near
/// the start keeps the limits.
///
/// A multi-start search begins with strong smoothing, which merges many starts. Here the first smoothing is only as
/// strong as the distance to the minimum requires: the result stays near the start, and few steps are needed.
Minima warm_minimum(const PoseObjective& objective, const Vec3& start);

}  // namespace ninedof
