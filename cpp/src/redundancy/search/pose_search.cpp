#include "redundancy/search/pose_search.hpp"

#include <algorithm>

#include "math/numbers.hpp"
#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

// Lengths are in sizes of the robot.
constexpr double on_singularity = 1e-12;  // |det| below which its sign is rounding
constexpr double nearly_singular = 1e-10;  // |det| above which its sign is beyond doubt
constexpr double contact = 1e-7;  // distance from a limit that counts as touching
constexpr double broken_alike = 1e-6;  // violations closer than this count as equal
constexpr std::array nudges{0.02, 0.1};  // shifts of the default start off det N = 0

/// The criterion as reported to the caller.
double criterion_value(const PoseObjective& objective, const Vec3& x) {
  const InternalPointProblem& problem = objective.problem();
  switch (problem.criterion) {
    case Criterion::condition_number:
      return condition_number(objective.pose().geometry(), objective.pose().configuration(x),
                              problem.characteristic_length);
    case Criterion::singularity: return objective.pose().determinants(x).cwiseAbs().minCoeff();
    case Criterion::leg_centring: return objective.exact(x);
  }
  return not_a_number;
}

InternalPoint unbounded(const LocalMinimum& local) {
  InternalPoint out;
  out.status = InternalPointStatus::unbounded;
  if (local.ending == Ending::in_joint)
    out.active.add(local.leg >= 0 ? ActiveBounds::low(3 + local.leg) : ActiveBounds::clearance(2));
  for (int k = 3; k < 9 && local.ending == Ending::away; ++k) out.active.add(ActiveBounds::high(k));
  return out;
}

/// The limits of external legs that a pose breaks; they do not depend on O.
ActiveBounds external_out_of_limits(const Geometry& g, const Vec3& position, const Mat3& rotation,
                                    const InternalPointProblem& problem) {
  const Vec9 length = leg_lengths(g, {position, rotation, position});
  const double slack = limit_tolerance * length.head<3>().maxCoeff();
  ActiveBounds out;
  for (int k = 0; k < 3; ++k) {
    if (length[k] < problem.limits.low[k] - slack) out.add(ActiveBounds::low(k));
    if (length[k] > problem.limits.high[k] + slack) out.add(ActiveBounds::high(k));
  }
  return out;
}

}  // namespace

bool in_some_chamber(const ScaledPose& pose, const InternalPointProblem& problem, const Vec3& x) {
  return (pose.determinants(x).cwiseAbs().array() > std::clamp(problem.clearance, on_singularity, nearly_singular))
      .all();
}

std::vector<Vec3> chamber_starts(const ScaledPose& pose, const InternalPointProblem& problem,
                                 const std::optional<Vec3>& start) {
  const Vec3 x = pose.scaled(start.value_or(default_internal_point(pose.geometry(), pose.position(), pose.rotation())));
  if (in_some_chamber(pose, problem, x)) return {x};
  std::vector<Vec3> out;
  if (start) return out;
  const Vec3 signs = pose.volumes(x).cwiseSign();
  for (const double side : {1.0, -1.0}) {
    const std::size_t before = out.size();
    for (const double nudge : nudges)
      for (int k = 0; k < 6 && out.size() == before; ++k) {
        const Vec3 y = x + (k < 3 ? nudge : -nudge) * Vec3::Unit(k % 3);
        const Vec3 there = pose.volumes(y).cwiseSign();
        if (in_some_chamber(pose, problem, y) && there[0] == signs[0] && there[1] == signs[1] && there[2] == side)
          out.push_back(y);
      }
  }
  return out;
}

InternalPoint internal_point(const PoseObjective& objective, const Vec3& x, InternalPointStatus status) {
  return {objective.pose().unscaled(x), criterion_value(objective, x), status, objective.touched(x, contact)};
}

InternalPoint internal_point(const PoseObjective& objective, const Minima& minima) {
  InternalPoint out;
  if (minima.found.empty()) {
    out.status = InternalPointStatus::infeasible;
    out.active = minima.violation < infinity ? objective.broken(minima.nearest, broken_alike)
                                             : objective.below_clearance(minima.nearest);
    return out;
  }
  const LocalMinimum& best = minima.found.front();
  switch (best.ending) {
    case Ending::minimum:
      return internal_point(objective, best.x,
                            minima.examined ? InternalPointStatus::found : InternalPointStatus::local);
    case Ending::stuck: return internal_point(objective, best.x, InternalPointStatus::stopped);
    case Ending::away:
    case Ending::in_joint: return unbounded(best);
  }
  return out;
}

bool has_point(const InternalPoint& p) {
  using enum InternalPointStatus;
  return p.status == found || p.status == local || p.status == stopped;
}

bool better(Criterion criterion, const InternalPoint& a, const InternalPoint& b) {
  if (has_point(a) != has_point(b)) return has_point(a);
  return criterion == Criterion::singularity ? a.value > b.value : a.value < b.value;
}

PoseResult pose_result(const PoseObjective& objective, const Minima& minima) {
  PoseResult out{internal_point(objective, minima), {}, objective.signs()};
  const bool none = minima.found.empty();
  out.s = objective.pose().unscaled(none ? minima.nearest : minima.found.front().x);
  if (!none) out.value = minima.found.front().value;
  return out;
}

PoseResult checked_pose(const Geometry& g, const Vec3& position, const Mat3& rotation,
                        const InternalPointProblem& problem) {
  PoseResult out;
  if (position.hasNaN() || rotation.hasNaN()) return out;
  out.point.active = external_out_of_limits(g, position, rotation, problem);
  out.point.status = out.point.active.empty() ? InternalPointStatus::singular : InternalPointStatus::infeasible;
  return out;
}

PoseResult search_pose(const Geometry& g, const Vec3& position, const Mat3& rotation,
                       const InternalPointProblem& problem, const std::optional<Vec3>& start) {
  PoseResult out = checked_pose(g, position, rotation, problem);
  if (start && start->hasNaN()) return {};
  if (out.point.status != InternalPointStatus::singular) return out;
  const ScaledPose pose(g, position, rotation, problem);
  PoseObjective objective(pose, problem);
  bool first = true;
  for (const Vec3& x : chamber_starts(pose, problem, start)) {
    objective.enter_chamber(x);
    const PoseResult found = pose_result(objective, local_minima(objective, x));
    if (first || better(problem.criterion, found.point, out.point)) out = found;
    first = false;
  }
  return out;
}

}  // namespace ninedof
