#pragma once
/// Where O is at a pose: the rule of a workspace.

#include "ninedof/workspace.hpp"

namespace ninedof {

class Placement {
 public:
  Placement(const Geometry& g, const InternalPointRule& rule, const WorkspaceCriteria& criteria);

  bool searched() const { return rule_.kind == InternalPointRule::Kind::best; }
  Vec3 point(const Vec3& p, const Mat3& q) const;

  /// The best point of the chamber between the plates, and its condition number. NaN where there is none. Of the pose alone:
  /// not of what was found nearby, so that a map does not depend on the order of its poses.
  InternalPoint best(const Vec3& p, const Mat3& q) const;

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
