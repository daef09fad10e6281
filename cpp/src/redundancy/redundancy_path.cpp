#include "ninedof/redundancy/redundancy_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "math/numbers.hpp"
#include "math/sort_by.hpp"
#include "ninedof/math/error.hpp"
#include "redundancy/map/continuation.hpp"
#include "redundancy/search/pose_search.hpp"

namespace ninedof {
namespace {

constexpr std::size_t most_choices = 8;  // local minima a pose may be in
constexpr std::array<std::size_t, 3> round_counts{3, 5, 9};  // of a closed path
constexpr double meeting = 1e-6;     // distance of the two ends of a round, in parts of the largest coordinate of O
constexpr double same_pose = 1e-12;  // difference of the first and the last pose of a closed path

/// A pose of the path with its local minima; none where it allows no point.
struct PathPose {
  const PlatformPose* platform = nullptr;
  std::unique_ptr<ScaledPose> pose;
  std::unique_ptr<PoseObjective> objective;
  std::vector<LocalMinimum> choices;
};

/// The chamber of O, from pose to pose.
class ChamberTracker {
 public:
  explicit ChamberTracker(const std::optional<Vec3>& start) : start_(start) {}

  /// Points to start from at this pose: O of the pose before, or the default start if in the same chamber; at the first
  /// pose the caller's start. After a gap in another chamber the default start.
  std::vector<Vec3> starts(const ScaledPose& pose, const InternalPointProblem& problem) const {
    if (!signs_) return chamber_starts(pose, problem, start_);
    std::vector<Vec3> out;
    for (const Vec3& s : {last_, default_internal_point(pose.geometry(), pose.position(), pose.rotation())}) {
      const Vec3 x = pose.scaled(s);
      if (in_some_chamber(pose, problem, x) && pose.volumes(x).cwiseSign() == *signs_) out.push_back(x);
    }
    return out.empty() && gap_ ? chamber_starts(pose, problem, {}) : out;
  }

  /// Records a pose without a point: after it O may be in another chamber.
  void add_gap() { gap_ = true; }

  /// Records the chamber of O at one pose.
  void record(const ScaledPose& pose, const Vec3& x) {
    gap_ = false;
    signs_ = pose.volumes(x).cwiseSign();
    last_ = pose.unscaled(x);
  }

 private:
  std::optional<Vec3> start_, signs_;
  Vec3 last_ = Vec3::Zero();
  bool gap_ = false;
};

/// The local minima of a pose; where there are none, `out` says why.
PathPose search_minima(const Geometry& g, const PlatformPose& pose, const InternalPointProblem& problem,
                       ChamberTracker& chamber, InternalPoint& out) {
  PathPose found{&pose, {}, {}, {}};
  out = checked_pose(g, pose.position, pose.rotation, problem).point;
  if (out.status != InternalPointStatus::singular) return found;
  found.pose = std::make_unique<ScaledPose>(g, pose.position, pose.rotation, problem);
  found.objective = std::make_unique<PoseObjective>(*found.pose, problem);
  for (const Vec3& x : chamber.starts(*found.pose, problem)) {
    found.objective->enter_chamber(x);
    Minima minima = local_minima(*found.objective, x);
    out = internal_point(*found.objective, minima);
    std::erase_if(minima.found,
                  [](const LocalMinimum& m) { return m.ending == Ending::away || m.ending == Ending::in_joint; });
    if (minima.found.empty()) continue;
    minima.found.resize(std::min(minima.found.size(), most_choices), minima.found.front());
    found.choices = std::move(minima.found);
    chamber.record(*found.pose, found.choices.front().x);
    break;
  }
  return found;
}

/// Adds local minima that a pose lacks: those to which the minima of the pose next to it lead.
void add_continued(const PathPose& from, PathPose& to) {
  if (from.choices.empty() || to.choices.empty()) return;
  const double moved = (from.platform->position - to.platform->position).norm() +
                       to.pose->unit() * (from.platform->rotation - to.platform->rotation).norm();
  const double near = branch_reach(to.pose->unit(), moved) / to.pose->unit();
  Reach reach(*to.pose, to.choices.front().x);
  Minima minima{to.choices};
  for (const LocalMinimum& choice : from.choices) {
    const Vec3 x = to.pose->scaled(from.pose->unscaled(choice.x));
    const auto same = [&](const LocalMinimum& m) { return (m.x - x).norm() < near; };
    if (std::ranges::any_of(minima.found, same) || !to.objective->in_chamber(x)) continue;
    for (const LocalMinimum& m : warm_minimum(*to.objective, x).found)
      if (m.ending == Ending::minimum && reach.reaches(m.x)) minima.add(m);
  }
  sort_by(minima.found, &LocalMinimum::value);
  minima.found.resize(std::min(minima.found.size(), most_choices), minima.found.front());
  to.choices = std::move(minima.found);
}

/// The choice at each pose that minimises the sum of values and moves, by dynamic programming.
std::vector<std::size_t> best_sequence(std::span<const PathPose> path_poses, double coupling,
                                       const std::stop_token& stop) {
  std::vector<std::vector<double>> cost;
  std::vector<std::vector<std::size_t>> from;
  for (std::size_t k = 0; k < path_poses.size(); ++k) {
    if (stop.stop_requested()) throw Stopped{};
    const auto& choices = path_poses[k].choices;
    cost.emplace_back(choices.size(), infinity);
    from.emplace_back(choices.size(), 0);
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (k == 0) {
        cost[k][i] = choices[i].value;
        continue;
      }
      const Vec3 here = path_poses[k].pose->unscaled(choices[i].x);
      for (std::size_t j = 0; j < path_poses[k - 1].choices.size(); ++j) {
        const Vec3 there = path_poses[k - 1].pose->unscaled(path_poses[k - 1].choices[j].x);
        const double sum = cost[k - 1][j] + choices[i].value + coupling * (here - there).squaredNorm();
        if (sum < cost[k][i]) {
          cost[k][i] = sum;
          from[k][i] = j;
        }
      }
    }
  }
  std::vector<std::size_t> out(path_poses.size());
  out.back() = at_index(std::ranges::min_element(cost.back()) - cost.back().begin());
  for (std::size_t k = path_poses.size() - 1; k > 0; --k) out[k - 1] = from[k][out[k]];
  return out;
}

void minimize_segment(std::span<const PathPose> path_poses, double coupling, const std::stop_token& stop,
                      std::span<InternalPoint> out) {
  const std::vector<std::size_t> choice = best_sequence(path_poses, coupling, stop);
  std::vector<PathPoint> path;
  for (std::size_t k = 0; k < path_poses.size(); ++k)
    path.push_back({path_poses[k].objective.get(), path_poses[k].choices[choice[k]].x});
  const bool settled = minimize_path(path, coupling, stop);
  for (std::size_t k = 0; k < path_poses.size(); ++k) {
    if (stop.stop_requested()) throw Stopped{};
    out[k] = internal_point(*path[k].objective, path[k].x,
                            settled ? InternalPointStatus::found : InternalPointStatus::stopped);
  }
}

/// The path with both ends free.
std::vector<InternalPoint> open_path(const Geometry& g, std::span<const PlatformPose> poses,
                                     const InternalPointProblem& problem, double smoothness,
                                     const std::optional<Vec3>& start, const Control& control) {
  std::vector<InternalPoint> out(poses.size());
  std::vector<PathPose> path_poses;
  ChamberTracker chamber(start);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (control.stop.stop_requested()) throw Stopped{};
    path_poses.push_back(search_minima(g, poses[k], problem, chamber, out[k]));
    if (path_poses.back().choices.empty()) chamber.add_gap();
    if (control.progress) control.progress(static_cast<long>(k + 1), static_cast<long>(poses.size()), not_a_number);
  }
  // A branch that one search has missed is continued along the path, forth and back.
  for (std::size_t k = 1; k < path_poses.size(); ++k) {
    if (control.stop.stop_requested()) throw Stopped{};
    add_continued(path_poses[k - 1], path_poses[k]);
  }
  for (std::size_t k = path_poses.size(); k-- > 1;) {
    if (control.stop.stop_requested()) throw Stopped{};
    add_continued(path_poses[k], path_poses[k - 1]);
  }
  const auto first = std::ranges::find_if(path_poses, [](const PathPose& p) { return p.pose != nullptr; });
  if (first == path_poses.end()) return out;
  // n times the objective: the sum over poses is not divided by n.
  const double n = static_cast<double>(poses.size()), unit = first->pose->unit();
  const double coupling = smoothness * std::max(1.0, n - 1.0) * n / (unit * unit);
  for (std::size_t k = 0; k < path_poses.size();) {
    std::size_t end = k;
    while (end < path_poses.size() && !path_poses[end].choices.empty()) ++end;
    if (end > k) minimize_segment({&path_poses[k], end - k}, coupling, control.stop, {&out[k], end - k});
    k = std::max(end, k + 1);
  }
  return out;
}

/// A closed path: the middle one of several rounds. The effect of the free ends fades from round to round, faster for a
/// small smoothness. Rounds are added until the ends of the middle one meet.
std::vector<InternalPoint> closed_path(const Geometry& g, std::span<const PlatformPose> poses,
                                       const InternalPointProblem& problem, double smoothness,
                                       const std::optional<Vec3>& start, const Control& control) {
  const std::size_t count = poses.size() - 1;
  std::vector<InternalPoint> out;
  for (const std::size_t rounds : round_counts) {
    std::vector<PlatformPose> around;
    for (std::size_t round = 0; round < rounds; ++round) around.insert(around.end(), poses.begin(), poses.end() - 1);
    // open_path scales the moves of O by (poses - 1) poses; for one round this is to be count^2.
    const auto one = static_cast<double>(count), all = static_cast<double>(around.size());
    const double weight = smoothness * (one / (all - 1.0)) * (one / all);
    const std::vector<InternalPoint> found = open_path(g, around, problem, weight, start, control);
    const auto begin = found.begin() + static_cast<std::ptrdiff_t>(rounds / 2 * count);
    const Vec3 gap = begin[static_cast<std::ptrdiff_t>(count)].s - begin->s;
    out.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    out.push_back(out.front());
    double largest = 0.0;
    for (const InternalPoint& point : found)
      if (!point.s.hasNaN()) largest = std::max(largest, point.s.cwiseAbs().maxCoeff());
    if (!(gap.cwiseAbs().array() > meeting * largest).any()) break;
  }
  return out;
}

}  // namespace

bool is_closed(std::span<const PlatformPose> poses) {
  if (poses.size() < 4) return false;
  double largest = 0.0;
  for (const PlatformPose& pose : poses)
    for (const double x : pose.position) largest = std::max(largest, std::abs(x));  // NaN does not count
  const PlatformPose &first = poses.front(), &last = poses.back();
  const auto moved = [&](const PlatformPose& pose) {
    return pose.position != first.position || pose.rotation != first.rotation;
  };
  return ((last.position - first.position).cwiseAbs().array() <= same_pose * largest).all() &&
         ((last.rotation - first.rotation).cwiseAbs().array() <= same_pose).all() && std::ranges::any_of(poses, moved);
}

std::vector<InternalPoint> best_internal_path(const Geometry& g, std::span<const PlatformPose> poses,
                                              const InternalPointProblem& problem, double smoothness,
                                              const std::optional<Vec3>& start, const Control& control) {
  validate(problem);
  require_positive("smoothness", smoothness);
  return (is_closed(poses) ? closed_path : open_path)(g, poses, problem, smoothness, start, control);
}

}  // namespace ninedof
