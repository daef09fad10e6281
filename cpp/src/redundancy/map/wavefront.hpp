#pragma once
/// A map of internal points by wavefront propagation, from the first searches to the audit.

#include "ninedof/redundancy/redundancy_map.hpp"

namespace ninedof {

/// best_internal_map with arguments already checked.
InternalPointMap map_by_wavefront(const Geometry& g, const PoseGrid& grid, const InternalPointProblem& problem,
                                  const MapSettings& settings, const Control& control);

}  // namespace ninedof
