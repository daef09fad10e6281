#pragma once
/// The legs at the joints of a body, and the angle of each from the axis of its joint's cone.

#include <cmath>

#include "ninedof/math/xyz.hpp"
#include "ninedof/robot/points.hpp"

namespace ninedof {

/// Number of legs at each body: the external ones, then the internal ones that end on it.
constexpr int legs_at_body = 6;

/// Leg k of a body in the order of leg_ends.
constexpr int leg_at(bool platform, int k) {
  return k < 3 || platform ? k : k + 3;
}

/// The joint of a leg on a body; s for an internal leg of the other one.
constexpr int joint_at(bool platform, int leg) {
  const LegEnds ends = leg_ends(leg);
  return (ends.from >= point_u && ends.from < point_p) == platform ? ends.from : ends.to;
}

/// 1 if the leg points away from its joint on the body, else -1: external legs point from the base to the platform.
constexpr double sense_at(bool platform, int k) {
  return platform && k < 3 ? -1.0 : 1.0;
}

/// Angle between a leg and an axis, 0 to pi; both in one frame, of any length.
inline double cone_angle(const Xyz<double>& leg, const Xyz<double>& axis) {
  const Xyz<double> across = cross(leg, axis);
  return std::atan2(std::sqrt(dot(across, across)), dot(leg, axis));
}

}  // namespace ninedof
