#pragma once
/// One pose of a map, continued from what its neighbours have found.

#include <span>

#include "ninedof/redundancy/redundancy_path.hpp"
#include "redundancy/search/pose_search.hpp"

namespace ninedof {

/// Whether `a` takes the place of `b` at one pose.
bool takes_over(Criterion criterion, const Finding& a, const Finding& b);

struct Followed {
  Finding best;
  int count = 0;  ///< local optima sought
};

/// A point to go on from. Optima within `reach` of it are taken to be its own.
struct Lead {
  Vec3 s;
  double reach;
};

/// How far apart the optima of one branch may be at two poses `moved` apart, lengths. O moves no more than the platform, by and
/// large. `unit` is the size of the robot.
constexpr double branch_reach(double unit, double moved) {
  return 0.01 * unit + 0.5 * moved;
}

/// The best local optimum that the leads end in, those left out that are not in a chamber meant or where another one was or ended;
/// `so_far` if none is better. `chamber_start` is as in best_internal_point.
Followed follow(const Geometry& g, const PlatformPose& pose, const InternalPointProblem& problem,
                const std::optional<Vec3>& chamber_start, std::span<const Lead> leads, const Finding& so_far);

}  // namespace ninedof
