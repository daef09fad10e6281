#include "redundancy/map/continuation.hpp"

#include <algorithm>
#include <vector>

namespace ninedof {

bool replaces(Criterion criterion, const PoseResult& a, const PoseResult& b) {
  constexpr double least_gain = 1e-9;  // of the criterion's logarithm: less is rounding, passed on without end
  if (b.signs.isZero()) return true;   // no result yet
  const bool of_a = has_point(a.point), of_b = has_point(b.point);
  if (a.signs != b.signs && (of_a || of_b)) {
    if (of_a && of_b && std::abs(a.value - b.value) <= least_gain) return false;
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
