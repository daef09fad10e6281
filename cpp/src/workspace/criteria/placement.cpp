#include "workspace/criteria/placement.hpp"

#include "ninedof/conditioning/conditioning.hpp"
#include "robot/triangle.hpp"

namespace ninedof {

using Kind = InternalPointRule::Kind;

Placement::Placement(const Geometry& g, const InternalPointRule& rule, const WorkspaceCriteria& criteria)
    : g_(g), rule_(rule), lower_(centroid(g.base_internal())), upper_(centroid(g.platform_internal())) {
  if (rule.kind == Kind::between || rule.kind == Kind::best) {
    share_ = searched() ? 0.5 : rule.fraction;
    arm_ = upper_;
  } else if (rule.kind == Kind::platform) {
    share_ = 1.0;
    arm_ = rule.point;
  }
  if (criteria.legs) problem_.limits = *criteria.legs;
  problem_.characteristic_length = criteria.characteristic_length;
}

Vec3 Placement::point(const Vec3& p, const Mat3& q) const {
  switch (rule_.kind) {
    case Kind::fixed: return rule_.point;
    case Kind::platform: return p + q * rule_.point;
    case Kind::between:
    case Kind::best: break;
  }
  return lower_ + share_ * (p + q * upper_ - lower_);
}

Motion Placement::motion() const {
  if (rule_.kind == Kind::fixed) return {0.0, Vec3::Zero(), rule_.point};
  if (rule_.kind == Kind::platform) return {1.0, rule_.point, Vec3::Zero()};
  return {share_, share_ * arm_, (1.0 - share_) * lower_};
}

InternalPoint Placement::best(const PlatformPose& pose) const {
  return best_internal_point(g_, pose.position, pose.rotation, problem_);
}

InternalPoint Placement::best(const PlatformPose& pose, std::span<const Guess> guesses) const {
  const InternalPoint before = checked_pose(g_, pose.position, pose.rotation, problem_).point;
  if (before.status != InternalPointStatus::singular) return before;
  const Continuation followed = continued_from(g_, pose, problem_, {}, guesses, {});
  return followed.best.point.status == InternalPointStatus::found ? followed.best.point : best(pose);
}

InternalPointMap Placement::best(const PoseGrid& grid, int threads, const std::stop_token& stop) const {
  MapSettings settings;
  settings.threads = threads;
  return best_internal_map(g_, grid, problem_, settings, {stop, {}});
}

InternalPoint Placement::found_before(const PlatformPose& pose, const Vec3& s) const {
  if (s.hasNaN()) return {};
  return {s,
          condition_number(g_, {pose.position, pose.rotation, s}, problem_.characteristic_length),
          InternalPointStatus::found,
          {}};
}

}  // namespace ninedof
