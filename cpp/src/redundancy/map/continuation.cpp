#include "redundancy/map/continuation.hpp"

#include <algorithm>
#include <vector>

#include "redundancy/search/warm_descent.hpp"

namespace ninedof {
namespace {

constexpr double least_gain =
    1e-9;  // of the criterion's logarithm: less is rounding and would be passed on without end

bool has_point(const PoseResult& f) {
  return f.point.status == InternalPointStatus::found || f.point.status == InternalPointStatus::stopped;
}

}  // namespace

bool replaces(Criterion criterion, const PoseResult& a, const PoseResult& b) {
  if (b.signs.isZero()) return true;  // no result yet
  if (a.signs != b.signs && (has_point(a) || has_point(b))) {
    if (has_point(a) && has_point(b) && std::abs(a.value - b.value) <= least_gain) return false;
    return better(criterion, a.point, b.point);
  }
  return a.value < b.value - least_gain;
}

Continuation continued_from(const Geometry& g, const PlatformPose& pose, const InternalPointProblem& problem,
                            const std::optional<Vec3>& chamber_start, std::span<const Guess> guesses,
                            const PoseResult& so_far) {
  Continuation out{so_far};
  const ScaledPose scaled(g, pose.position, pose.rotation, problem);
  PoseObjective objective(scaled, problem);
  const std::vector<Vec3> chambers = chamber_starts(scaled, problem, chamber_start);
  std::vector<Vec3> signs, seen;
  for (const Vec3& x : chambers) signs.push_back(scaled.volumes(x).cwiseSign());
  if (!so_far.signs.isZero()) seen.push_back(so_far.s);
  for (const Guess& guess : guesses) {
    if (std::ranges::any_of(seen, [&](const Vec3& s) { return (s - guess.s).norm() < guess.reach; })) continue;
    const Vec3 x = scaled.scaled(guess.s);
    if (std::ranges::find(signs, scaled.volumes(x).cwiseSign()) == signs.end() || !in_some_chamber(scaled, problem, x))
      continue;
    objective.enter_chamber(x);
    const PoseResult found = pose_result(objective, warm_minimum(objective, x));
    ++out.count;
    seen.push_back(found.s);
    if (replaces(problem.criterion, found, out.best)) out.best = found;
  }
  return out;
}

}  // namespace ninedof
