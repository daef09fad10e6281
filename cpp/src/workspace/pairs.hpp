#pragma once
/// Distances of the axes of legs that share no joint.

#include <array>
#include <utility>

#include "ninedof/configuration.hpp"
#include "ninedof/geometry.hpp"

namespace ninedof {

/// The 21 pairs of legs (order of leg_lengths) that need not meet: the internal ones all end in O, so one of two is external.
constexpr int leg_pairs = 21;
std::pair<int, int> leg_pair(int item);

/// Which pairs share a joint in this robot.
std::array<bool, leg_pairs> pairs_sharing_a_joint(const Geometry& g);

struct Closest {
  double distance;
  int pair;  ///< -1 where every pair shares a joint
};
Closest closest_legs(const Geometry& g, const Configuration& c, const std::array<bool, leg_pairs>& exempt);

}  // namespace ninedof
