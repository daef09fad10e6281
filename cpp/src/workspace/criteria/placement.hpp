#pragma once
/// Where O is at a pose: the rule of a workspace.

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
  /// The same, by going on from what is known nearby; by a search where that comes to nothing.
  InternalPoint best(const PlatformPose& pose, std::span<const Guess> guesses) const;
  /// The same at all poses of a grid.
  InternalPointMap best(const PoseGrid& grid, int threads, const std::stop_token& stop) const;
  /// What there is to say of a point that was found before; s may be NaN.
  InternalPoint found_before(const PlatformPose& pose, const Vec3& s) const;

  /// How fast O, and O seen from the platform's point u~, move at most: by unit of translation, or by radian.
  double speed_translating() const;
  double speed_turning() const;
  double relative_translating() const;
  double relative_turning(const Vec3& u_tilde) const;

 private:
  const Geometry& g_;
  InternalPointRule rule_;
  InternalPointProblem problem_;
  Vec3 lower_, upper_;  // centroids, base and platform frame
};

}  // namespace ninedof
