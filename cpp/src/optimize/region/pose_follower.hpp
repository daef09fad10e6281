#pragma once
/// How the worst poses of a design move with it.

#include <memory>

#include "optimize/region/design_at_poses.hpp"
#include "optimize/region/look.hpp"

namespace ninedof {

class PoseFollower {
 public:
  /// `x`: variables of the problem, of which those of its own poses do not count.
  PoseFollower(const Problem& problem, const Region& region, const Eigen::VectorXd& x);

  /// Where a local worst goes, to first order: the slopes of its number by the pose stay 0, or those along the edge of
  /// the region. Null where it stays: at a corner, or where the number hardly changes around it.
  std::shared_ptr<const FollowingPose> following(const Look::Worst& worst);

 private:
  Region region_;
  Eigen::VectorXd variables_;
  DesignAtPoses design_;
};

}  // namespace ninedof
