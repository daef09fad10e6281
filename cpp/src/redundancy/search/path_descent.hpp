#pragma once
/// Newton's method on the internal points of a whole path.

#include <span>
#include <stop_token>
#include <vector>

#include "redundancy/search/pose_objective.hpp"

namespace ninedof {

/// One pose of a path: its objective, and O in the coordinates of its ScaledPose.
struct PathPoint {
  const PoseObjective* objective;
  Vec3 x;
};

/// Minimises sum f_k(x_k) + coupling sum |s_(k+1) - s_k|^2, s in lengths, over all points at once, from points inside
/// their chambers and limits. The Hessian is block tridiagonal, so that a step takes time proportional to the number of
/// poses. False without convergence. Throws Stopped on a stop.
bool minimize_path(std::span<PathPoint> points, double coupling, const std::stop_token& stop);

}  // namespace ninedof
