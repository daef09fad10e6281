#pragma once
/// The rule of a workspace for the position of O.

#include <span>
#include <stop_token>

#include "ninedof/redundancy/redundancy_map.hpp"
#include "ninedof/workspace/workspace.hpp"
#include "redundancy/map/continuation.hpp"

namespace ninedof {

/// The point share p + Q arm + at.
struct Motion {
  double share;
  Vec3 arm, at;
};

class Placement {
 public:
  Placement(const Geometry& g, const InternalPointRule& rule, const WorkspaceCriteria& criteria);

  bool searched() const { return rule_.kind == InternalPointRule::Kind::best; }
  Vec3 point(const Vec3& p, const Mat3& q) const;

  /// The best point of the chamber between the plates, and its condition number. NaN where there is none.
  InternalPoint best(const PlatformPose& pose) const;
  /// The same, continued from known points nearby, or by a search where that fails.
  InternalPoint best(const PlatformPose& pose, std::span<const Guess> guesses) const;
  /// The same at all poses of a grid.
  InternalPointMap best(const PoseGrid& grid, int threads, const std::stop_token& stop) const;
  /// The result for a point that was found before; s may be NaN.
  InternalPoint found_before(const PlatformPose& pose, const Vec3& s) const;

  /// O as it moves with the platform.
  Motion motion() const;

 private:
  const Geometry& g_;
  InternalPointRule rule_;
  InternalPointProblem problem_;
  Vec3 lower_, upper_;  // centroids, base and platform frame
  double share_ = 0.0;  // O moves with this share of the platform's point `arm`, platform frame
  Vec3 arm_ = Vec3::Zero();
};

}  // namespace ninedof
