#pragma once
/// The search at one pose: checks before it, chambers to search, and the result as the caller sees it.

#include <optional>
#include <vector>

#include "math/numbers.hpp"
#include "ninedof/redundancy/redundancy.hpp"
#include "redundancy/search/multi_start.hpp"

namespace ninedof {

/// Whether x is off every singularity, so that it lies in a chamber; it may be within a clearance above 1e-10.
bool in_some_chamber(const ScaledPose& pose, const InternalPointProblem& problem, const Vec3& x);

/// One point in each chamber to search; none if the start is singular. The default start may happen to lie on det N =
/// 0, between two chambers: both are then searched.
std::vector<Vec3> chamber_starts(const ScaledPose& pose, const InternalPointProblem& problem,
                                 const std::optional<Vec3>& start);

/// The internal point at x, with the bounds it touches.
InternalPoint internal_point(const PoseObjective& objective, const Vec3& x, InternalPointStatus status);

/// The internal point that the search of one chamber leads to.
InternalPoint internal_point(const PoseObjective& objective, const Minima& minima);

/// An internal point with what is needed to continue it and to compare it.
struct PoseResult {
  InternalPoint point;
  Vec3 s = Vec3::Zero();  ///< O: at the optimum, where the descent was lost, or where the limits are broken least
  Vec3 signs = Vec3::Zero();  ///< of the chamber's determinants; zero where the pose alone excludes a point
  double value = infinity;  ///< of PoseObjective::exact
};
PoseResult pose_result(const PoseObjective& objective, const Minima& minima);

/// The result as far as the pose alone decides it: missing, or infeasible for external legs; `singular` if undecided.
PoseResult checked_pose(const Geometry& g, const Vec3& position, const Mat3& rotation,
                        const InternalPointProblem& problem);

/// best_internal_point with arguments already checked.
PoseResult search_pose(const Geometry& g, const Vec3& position, const Mat3& rotation,
                       const InternalPointProblem& problem, const std::optional<Vec3>& start);

/// Whether a search ended at a point, and whether `a` is the better of two results for one pose.
bool has_point(const InternalPoint& p);
bool better(Criterion criterion, const InternalPoint& a, const InternalPoint& b);

}  // namespace ninedof
