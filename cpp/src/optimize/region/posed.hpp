#pragma once
/// A study over a region with listed poses in the place of the region.

#include "ninedof/domains/region.hpp"
#include "ninedof/problem/problem.hpp"

namespace ninedof {

/// Poses of a region by their coordinates; the first are the nodes of a mean.
struct Imposed {
  std::vector<Vec6> nodes, at;
};

/// Where a study is solved first: the neutral pose, and the corners of the positions with the greatest turns.
std::vector<Vec6> cover(const Region& region);

/// Fewer: the corners without turns, and the greatest turns about each axis at the neutral position.
std::vector<Vec6> coarse_cover(const Region& region);

/// The poses as an objective lists them: of weight 1 where they count in a mean.
std::vector<Pose> poses_of(const Problem& problem, const Region& region, const Imposed& imposed);

/// The problem with further poses.
Problem posed(const Problem& problem, const std::vector<Pose>& poses);

/// The problem without poses of its own.
Problem without_poses(Problem problem);

/// The problem with one pose, off the axis so that the closed form is not used.
Problem with_one_pose(Problem problem);

/// The variables of the problem without poses, of a full set.
Eigen::VectorXd own_variables(const Problem& problem, const Eigen::VectorXd& x);

/// A full set, from those and the shift of s at each pose; a shift that is no variable is left out.
Eigen::VectorXd with_shifts(const Problem& problem, const Eigen::VectorXd& own, const std::vector<Vec3>& shifts);

/// The shift of s, in zp, that moves it with the platform's origin.
Vec3 shifted_with(const Pose& pose, double zp);

/// The largest difference of two poses in parts of the region.
double distance_in(const Region& region, const Vec6& a, const Vec6& b);

}  // namespace ninedof
