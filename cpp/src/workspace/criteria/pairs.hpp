#pragma once
/// The closest pair of legs that share no joint.

#include <array>

#include "ninedof/robot/geometry.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof {

/// The pairs that share a joint in this robot.
std::array<bool, leg_pairs> pairs_sharing_a_joint(const Geometry& g);

struct Closest {
  double distance;
  int pair;  ///< -1 where every pair shares a joint
};
Closest closest_legs(const Points& at, const std::array<bool, leg_pairs>& exempt);

}  // namespace ninedof
