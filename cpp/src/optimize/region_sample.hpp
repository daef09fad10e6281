#pragma once
/// Poses of a region that a search looks at.

#include <cstdint>

#include "ninedof/problem/region.hpp"

namespace ninedof {

/// Coordinates of pose n of a low-discrepancy sample, many on the boundary; the neutral pose is the first.
Vec6 region_sample(const Region& region, long n, std::uint64_t seed);

/// Coordinates after move number `move`, by `step` parts of the region: along a coordinate, or, since balls, cylinders
/// and tilts have round boundaries, around an axis: the tilt vector about z, positions about x, y and z.
constexpr int region_moves = 10;
Vec6 region_moved(const Region& region, Vec6 at, int move, double step);

}  // namespace ninedof
