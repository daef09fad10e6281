#pragma once
/// A scan of the chamber: the criterion on a regular grid of points, by the vector kernels.

#include <vector>

#include "redundancy/search/pose_objective.hpp"

namespace ninedof {

/// A point of the grid that is allowed and no worse than its neighbours.
struct Valley {
  Vec3 x;
  double value;  ///< of PoseObjective::exact
  double drop;   ///< how much lower the minimum near it may be, estimated from the neighbours
};

struct Scan {
  std::vector<Valley> valleys;  ///< lowest first
  std::vector<Vec3> outside;    ///< points next to which limits may leave room that the grid has not met, best first
  double cell = 0.0;            ///< diagonal of a cell
};

/// Scans the points whose determinants have the signs of the chamber, on a grid of n points along each axis. It covers
/// the box around the balls of the upper limits, or around the robot; and a second time, closer, the box around the
/// points that keep the limits, where they are few. Points of another chamber may have the same signs: see Reach.
Scan scan(const PoseObjective& objective, int n);

}  // namespace ninedof
