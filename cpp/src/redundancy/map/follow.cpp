#include "redundancy/map/follow.hpp"

#include <algorithm>
#include <vector>

#include "redundancy/search/nearby.hpp"

namespace ninedof {
namespace {

constexpr double least_gain = 1e-9;  // of the criterion's logarithm: less is rounding, and would be passed on for ever

bool has_point(const Finding& f) {
  return f.point.status == InternalPointStatus::found || f.point.status == InternalPointStatus::stopped;
}

}  // namespace

bool takes_over(Criterion criterion, const Finding& a, const Finding& b) {
  if (b.sides.isZero()) return true;  // nothing yet
  if (a.sides != b.sides && (has_point(a) || has_point(b))) {
    if (has_point(a) && has_point(b) && std::abs(a.value - b.value) <= least_gain) return false;
    return better(criterion, a.point, b.point);
  }
  return a.value < b.value - least_gain;
}

Followed follow(const Geometry& g, const PlatformPose& pose, const InternalPointProblem& problem,
                const std::optional<Vec3>& chamber_start, std::span<const Lead> leads, const Finding& so_far) {
  Followed out{so_far};
  const Scene scene(g, pose.position, pose.rotation, problem);
  Merit merit(scene, problem);
  const std::vector<Vec3> chambers = chamber_starts(scene, problem, chamber_start);
  std::vector<Vec3> sides, seen;
  for (const Vec3& x : chambers) sides.push_back(scene.volumes(x).cwiseSign());
  if (!so_far.sides.isZero()) seen.push_back(so_far.s);
  for (const Lead& lead : leads) {
    if (std::ranges::any_of(seen, [&](const Vec3& s) { return (s - lead.s).norm() < lead.reach; })) continue;
    const Vec3 x = scene.inward(lead.s);
    if (std::ranges::find(sides, scene.volumes(x).cwiseSign()) == sides.end() || !in_a_chamber(scene, problem, x))
      continue;
    merit.enter(x);
    const Finding found = finding(merit, nearby_minimum(merit, x));
    ++out.count;
    seen.push_back(found.s);
    if (takes_over(problem.criterion, found, out.best)) out.best = found;
  }
  return out;
}

}  // namespace ninedof
