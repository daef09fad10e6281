#pragma once
/// Numerical continuation: the optimum of one pose from those of neighbouring poses.

#include <span>

#include "ninedof/redundancy/redundancy_path.hpp"
#include "redundancy/search/pose_search.hpp"

namespace ninedof {

/// Whether `a` replaces `b` as the result of one pose.
bool replaces(Criterion criterion, const PoseResult& a, const PoseResult& b);

struct Continuation {
  PoseResult best;
  int count = 0;  ///< local optima sought
  bool examined = true;  ///< as in Minima
};

/// An initial guess. An optimum within `reach` of it is taken to be of the same branch.
struct Guess {
  Vec3 s;
  double reach;
};

/// The greatest distance between optima of one branch at two poses `moved` apart, in lengths: O usually moves no more
/// than the platform. `unit` is the size of the robot.
constexpr double branch_reach(double unit, double moved) {
  return 0.01 * unit + 0.5 * moved;
}

/// The best local optimum reached from the guesses; `so_far` if none is better. Guesses outside the chambers of
/// `chamber_start`, as in best_internal_point, are left out, and so are those near an optimum that is known already.
Continuation continued_from(const Geometry& g, const PlatformPose& pose, const InternalPointProblem& problem,
                            const std::optional<Vec3>& chamber_start, std::span<const Guess> guesses,
                            const PoseResult& so_far);

/// The best local optimum of valleys of a coarse scan that may be better than `so_far`, else that.
Continuation scanned_from(const Geometry& g, const PlatformPose& pose, const InternalPointProblem& problem,
                          const std::optional<Vec3>& chamber_start, const PoseResult& so_far);

}  // namespace ninedof
