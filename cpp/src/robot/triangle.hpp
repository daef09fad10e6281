#pragma once
/// The shape of three joints.

#include <Eigen/Geometry>

#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// The least height over the longest side. Divided first: the cross product of very short or very long sides would
/// underflow or overflow.
inline double relative_height(const Triple& t, double longest) {
  return ((t[1] - t[0]) / longest).cross((t[2] - t[0]) / longest).norm();
}

inline Vec3 centroid(const Triple& t) {
  return (t[0] + t[1] + t[2]) / 3.0;
}

}  // namespace ninedof
