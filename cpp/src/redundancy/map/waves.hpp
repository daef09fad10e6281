#pragma once
/// A map of internal points, from seeds to audit.

#include "ninedof/redundancy/redundancy_map.hpp"

namespace ninedof {

/// best_internal_map, its arguments checked.
InternalPointMap map_in_waves(const Geometry& g, const PoseGrid& grid, const InternalPointProblem& problem,
                              const MapSettings& settings, const Control& control);

}  // namespace ninedof
