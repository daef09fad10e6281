#pragma once
/// Bounds of the points that have given distances from three others: O relative to the base or to the platform.

#include <vector>

#include "ninedof/math/interval.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

using PointBounds = Xyz<Interval>;

inline PointBounds bounds_of(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

inline Interval norm(const PointBounds& v) {
  return sqrt(square(v.x) + square(v.y) + square(v.z));
}

struct SidedPointBounds {
  PointBounds point;
  int side;  ///< of the plane of the centres, as in AssemblyMode; 0: this may hold both points, one or none
};

/// Every point of three spheres lies in one of these. Those on a side exist, each once: the other side has its own.
std::vector<SidedPointBounds> meeting_bounds(const Triple& centres, const Vec3& radii);

}  // namespace ninedof
