#pragma once
/// Poses of a region where a rule for O is fitted.

#include <vector>

#include "ninedof/proof/machine.hpp"

namespace ninedof {

/// Coordinates: the middle, sides and corners of the region with tilts all around, and points between.
std::vector<Vec6> first_rule_poses(const Region& region);

/// Coordinates of poses of a low-discrepancy sample.
std::vector<Vec6> sampled_poses(const Region& region, long first, long count);

/// The coordinates of a pose that a proof has met, in a region whose lengths are in parts of `unit`; on a path those of
/// the nearest point.
Vec6 region_coordinates(const Region& region, double unit, const MetAt& met);

}  // namespace ninedof
