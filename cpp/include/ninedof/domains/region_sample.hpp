#pragma once
/// Poses of a region to look at: samples, corners, and moves from one to another. All as coordinates, see Region.

#include <cstdint>
#include <vector>

#include "ninedof/domains/region.hpp"

namespace ninedof {

/// Pose n, from 0, of a low-discrepancy sample that is even in positions, in the tilt vector and in the yaw.
Vec6 even_sample(const Region& region, long n, std::uint64_t seed = 0);

/// Pose n of a sample to search in: the neutral pose, then poses drawn from a region larger by a quarter, those outside
/// moved to the boundary.
Vec6 region_sample(const Region& region, long n, std::uint64_t seed = 0);

/// The corners of the positions and yaws, each at the greatest tilt in `turns` directions. On a path: its ends.
std::vector<Vec6> region_corners(const Region& region, int turns);

/// Coordinates after move number `move`, by `step` parts of the region: along a coordinate, or, since balls, cylinders
/// and tilts have round boundaries, around an axis: the tilt vector about z, positions about x, y and z.
constexpr int region_moves = 10;
Vec6 region_moved(const Region& region, Vec6 at, int move, double step);

}  // namespace ninedof
