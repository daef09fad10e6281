#pragma once
/// The minima of one pose in one chamber, from many starts.

#include "redundancy/search/minima.hpp"
#include "redundancy/search/reach.hpp"

namespace ninedof {

/// Scans the chamber that `reach` knows on a grid of n points along each axis, divided where the criterion may be lower
/// than the best so far, and adds the minima of those places: no point of the scan is better than the best minimum.
void add_valleys(const PoseObjective& objective, int n, Reach& reach, Minima& minima);

/// Searches the chamber of the objective from `start`, a point of it, which may be within the clearance.
Minima local_minima(const PoseObjective& objective, const Vec3& start);

}  // namespace ninedof
