#include "redundancy/search/pose_search.hpp"

#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

// Lengths are in sizes of the robot.
constexpr double on_wall = 1e-12;      // |det| that is rounding
constexpr double contact = 1e-7;       // of a limit that is touched
constexpr double broken_alike = 1e-6;  // of limits broken by the same amount
constexpr std::array nudges{0.02, 0.1};

/// The criterion as it is reported.
double criterion_value(const Merit& merit, const Vec3& x) {
  const InternalPointProblem& problem = merit.problem();
  switch (problem.criterion) {
    case Criterion::condition_number:
      return condition_number(merit.scene().geometry(), merit.scene().configuration(x), problem.characteristic_length);
    case Criterion::singularity: return merit.scene().determinants(x).cwiseAbs().minCoeff();
    case Criterion::leg_centring: return merit.exact(x);
  }
  return not_a_number;
}

InternalPoint unbounded(const Local& local) {
  InternalPoint out;
  out.status = InternalPointStatus::unbounded;
  if (local.ending == Ending::in_joint) out.active.add(ActiveBounds::low(3 + local.leg));
  for (int k = 3; k < 9 && local.ending == Ending::away; ++k) out.active.add(ActiveBounds::high(k));
  return out;
}

}  // namespace

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

bool in_a_chamber(const Scene& scene, const InternalPointProblem& problem, const Vec3& x) {
  return (scene.determinants(x).cwiseAbs().array() > std::max(problem.clearance, on_wall)).all();
}

std::vector<Vec3> chamber_starts(const Scene& scene, const InternalPointProblem& problem,
                                 const std::optional<Vec3>& start) {
  const Vec3 x =
      scene.inward(start.value_or(default_internal_point(scene.geometry(), scene.position(), scene.rotation())));
  if (in_a_chamber(scene, problem, x)) return {x};
  std::vector<Vec3> out;
  if (start) return out;
  const Vec3 sides = scene.volumes(x).cwiseSign();
  for (const double side : {1.0, -1.0}) {
    const std::size_t before = out.size();
    for (const double nudge : nudges)
      for (int k = 0; k < 6 && out.size() == before; ++k) {
        const Vec3 y = x + (k < 3 ? nudge : -nudge) * Vec3::Unit(k % 3);
        const Vec3 there = scene.volumes(y).cwiseSign();
        if (in_a_chamber(scene, problem, y) && there[0] == sides[0] && there[1] == sides[1] && there[2] == side)
          out.push_back(y);
      }
  }
  return out;
}

InternalPoint internal_point(const Merit& merit, const Vec3& x, InternalPointStatus status) {
  return {merit.scene().outward(x), criterion_value(merit, x), status, merit.touched(x, contact)};
}

InternalPoint answer(const Merit& merit, const Minima& minima) {
  InternalPoint out;
  if (minima.found.empty()) {
    out.status = InternalPointStatus::infeasible;
    out.active = merit.broken(minima.nearest, broken_alike);
    return out;
  }
  const Local& best = minima.found.front();
  switch (best.ending) {
    case Ending::minimum: return internal_point(merit, best.x, InternalPointStatus::found);
    case Ending::stuck: return internal_point(merit, best.x, InternalPointStatus::stopped);
    case Ending::away:
    case Ending::in_joint: return unbounded(best);
  }
  return out;
}

bool better(Criterion criterion, const InternalPoint& a, const InternalPoint& b) {
  const auto has_point = [](const InternalPoint& p) {
    return p.status == InternalPointStatus::found || p.status == InternalPointStatus::stopped;
  };
  if (has_point(a) != has_point(b)) return has_point(a);
  return criterion == Criterion::singularity ? a.value > b.value : a.value < b.value;
}

Finding finding(const Merit& merit, const Minima& minima) {
  Finding out{answer(merit, minima), {}, merit.sides()};
  const bool none = minima.found.empty();
  out.s = merit.scene().outward(none ? minima.nearest : minima.found.front().x);
  if (!none) out.value = minima.found.front().value;
  return out;
}

Finding before_search(const Geometry& g, const Vec3& position, const Mat3& rotation,
                      const InternalPointProblem& problem) {
  Finding out;
  if (position.hasNaN() || rotation.hasNaN()) return out;
  out.point.active = external_out_of_limits(g, position, rotation, problem);
  out.point.status = out.point.active.empty() ? InternalPointStatus::singular : InternalPointStatus::infeasible;
  return out;
}

Finding search_pose(const Geometry& g, const Vec3& position, const Mat3& rotation, const InternalPointProblem& problem,
                    const std::optional<Vec3>& start) {
  Finding out = before_search(g, position, rotation, problem);
  if (start && start->hasNaN()) return {};
  if (out.point.status != InternalPointStatus::singular) return out;
  const Scene scene(g, position, rotation, problem);
  Merit merit(scene, problem);
  bool first = true;
  for (const Vec3& x : chamber_starts(scene, problem, start)) {
    merit.enter(x);
    const Finding found = finding(merit, local_minima(merit, x));
    if (first || better(problem.criterion, found.point, out.point)) out = found;
    first = false;
  }
  return out;
}

}  // namespace ninedof
