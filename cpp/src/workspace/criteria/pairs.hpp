#pragma once
/// Distances of the axes of legs that share no joint.

#include <array>

#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof {

/// Which pairs share a joint in this robot.
std::array<bool, leg_pairs> pairs_sharing_a_joint(const Geometry& g);

struct Closest {
  double distance;
  int pair;  ///< -1 where every pair shares a joint
};
Closest closest_legs(const Geometry& g, const Configuration& c, const std::array<bool, leg_pairs>& exempt);

}  // namespace ninedof
