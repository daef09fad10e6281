#pragma once
/// The rule of a workspace for the position of O.

#include <cmath>
#include <span>
#include <stop_token>

#include "ninedof/redundancy/redundancy_map.hpp"
#include "ninedof/workspace/workspace.hpp"
#include "redundancy/map/continuation.hpp"

namespace ninedof {

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

  /// Bounds on the speed of O, and of O relative to the joint u~, per unit of translation or per radian.
  double speed_translating() const { return std::abs(share_); }
  double speed_turning() const { return std::abs(share_) * arm_.norm(); }
  double relative_translating() const { return std::abs(1.0 - share_); }
  double relative_turning(const Vec3& u_tilde) const {
    return rule_.kind == InternalPointRule::Kind::platform ? 0.0 : (share_ * arm_ - u_tilde).norm();
  }

 private:
  const Geometry& g_;
  InternalPointRule rule_;
  InternalPointProblem problem_;
  Vec3 lower_, upper_;  // centroids, base and platform frame
  double share_ = 0.0;  // O moves with this share of the platform's point `arm`, platform frame
  Vec3 arm_ = Vec3::Zero();
};

}  // namespace ninedof
