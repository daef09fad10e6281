#include "redundancy/map/continuation.hpp"

#include <algorithm>
#include <vector>

#include "math/sort_by.hpp"

namespace ninedof {

bool replaces(Criterion criterion, const PoseResult& a, const PoseResult& b) {
  if (a.signs.isZero()) return false;  // no result
  if (b.signs.isZero()) return true;
  const bool of_a = has_point(a.point), of_b = has_point(b.point);
  if (a.signs != b.signs && (of_a || of_b)) {
    if (of_a && of_b && std::abs(a.value - b.value) <= least_gain) return false;
    return better(criterion, a.point, b.point);
  }
  return a.value < b.value - least_gain;  // rounding would be passed on without end
}

Continuation continued_from(const Geometry& g, const PlatformPose& pose, const InternalPointProblem& problem,
                            const std::optional<Vec3>& chamber_start, std::span<const Guess> guesses,
                            const PoseResult& so_far) {
  Continuation out{so_far};
  const ScaledPose scaled(g, pose.position, pose.rotation, problem);
  PoseObjective objective(scaled, problem);
  const std::vector<Vec3> chambers = chamber_starts(scaled, problem, chamber_start);
  std::vector<Vec3> signs, seen;
  std::vector<Reach> reach;
  for (const Vec3& x : chambers) {
    signs.push_back(scaled.volumes(x).cwiseSign());
    reach.emplace_back(scaled, x);
  }
  if (!so_far.signs.isZero()) seen.push_back(so_far.s);
  for (const Guess& guess : guesses) {
    if (std::ranges::any_of(seen, [&](const Vec3& s) { return (s - guess.s).norm() < guess.reach; })) continue;
    const Vec3 x = scaled.scaled(guess.s);
    const auto chamber = std::ranges::find(signs, scaled.volumes(x).cwiseSign());
    if (chamber == signs.end() || !in_some_chamber(scaled, problem, x)) continue;
    objective.enter_chamber(x);
    const PoseResult found = pose_result(objective, warm_minimum(objective, x));
    ++out.count;
    seen.push_back(found.s);
    if (!replaces(problem.criterion, found, out.best)) continue;
    // Of the same signs there may be several chambers.
    if (!reach[at_index(chamber - signs.begin())].reaches(has_point(found.point) ? scaled.scaled(found.s) : x))
      continue;
    out.best = found;
  }
  return out;
}

Continuation scanned_from(const Geometry& g, const PlatformPose& pose, const InternalPointProblem& problem,
                          const std::optional<Vec3>& chamber_start, const PoseResult& so_far) {
  constexpr int points = 12;  // of the scan, along each axis
  Continuation out{so_far};
  const ScaledPose scaled(g, pose.position, pose.rotation, problem);
  PoseObjective objective(scaled, problem);
  for (const Vec3& x : chamber_starts(scaled, problem, chamber_start)) {
    objective.enter_chamber(x);
    Minima minima{{}, infinity, x};
    if (so_far.value < infinity) minima.found.push_back({scaled.scaled(so_far.s), so_far.value, Ending::minimum});
    const std::size_t known = minima.found.size();
    Reach reach(scaled, x);
    add_valleys(objective, points, reach, minima);
    out.examined &= minima.examined;
    minima.found.erase(minima.found.begin(), minima.found.begin() + static_cast<std::ptrdiff_t>(known));
    sort_by(minima.found, &LocalMinimum::value);
    for (const LocalMinimum& m : minima.found) {
      ++out.count;
      const PoseResult found = pose_result(objective, {{m}, 0.0, x});
      if (!replaces(problem.criterion, found, out.best)) continue;
      out.best = found;
      break;
    }
  }
  return out;
}

}  // namespace ninedof
