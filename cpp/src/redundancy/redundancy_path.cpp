#include "ninedof/redundancy/redundancy_path.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "redundancy/search/path_descent.hpp"
#include "redundancy/search/pose_search.hpp"
#include "redundancy/search/search.hpp"

namespace ninedof {
namespace {

constexpr std::size_t most_choices = 6;  // local minima a pose may be in

/// A pose of the path, its chamber, and the minima it offers; none where it allows no point.
struct Place {
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Merit> merit;
  std::vector<Local> choices;
};

/// Sides of a chamber, taken along from pose to pose.
class Chamber {
 public:
  explicit Chamber(const std::optional<Vec3>& start) : start_(start) {}

  /// Points of the chamber to start from at this pose: where O was before, or the middle; on the first pose the caller's start.
  std::vector<Vec3> starts(const Scene& scene, const InternalPointProblem& problem) const {
    if (!sides_) return chamber_starts(scene, problem, start_);
    std::vector<Vec3> out;
    for (const Vec3& s : {last_, default_internal_point(scene.geometry(), scene.position(), scene.rotation())}) {
      const Vec3 x = scene.inward(s);
      if (in_a_chamber(scene, problem, x) && scene.volumes(x).cwiseSign() == *sides_) out.push_back(x);
    }
    return out.empty() && gap_ ? chamber_starts(scene, problem, {}) : out;
  }

  /// A pose without a point: behind it O may be anywhere.
  void divide() { gap_ = true; }

  void leave(const Scene& scene, const Vec3& x) {
    gap_ = false;
    sides_ = scene.volumes(x).cwiseSign();
    last_ = scene.outward(x);
  }

 private:
  std::optional<Vec3> start_, sides_;
  Vec3 last_ = Vec3::Zero();
  bool gap_ = false;
};

InternalPoint with_status(InternalPointStatus status) {
  InternalPoint out;
  out.status = status;
  return out;
}

/// Everything the pose offers; `out` says why where it offers nothing.
Place look(const Geometry& g, const PlatformPose& pose, const InternalPointProblem& problem, Chamber& chamber,
           InternalPoint& out) {
  Place place;
  if (pose.position.hasNaN() || pose.rotation.hasNaN()) return place;
  out.active = external_out_of_limits(g, pose.position, pose.rotation, problem);
  if (!out.active.empty()) {
    out.status = InternalPointStatus::infeasible;
    return place;
  }
  place.scene = std::make_unique<Scene>(g, pose.position, pose.rotation, problem);
  place.merit = std::make_unique<Merit>(*place.scene, problem);
  out = with_status(InternalPointStatus::singular);
  for (const Vec3& x : chamber.starts(*place.scene, problem)) {
    place.merit->enter(x);
    Minima minima = local_minima(*place.merit, x);
    out = answer(*place.merit, minima);
    std::erase_if(minima.found,
                  [](const Local& m) { return m.ending == Ending::away || m.ending == Ending::in_joint; });
    if (minima.found.empty()) continue;
    minima.found.resize(std::min(minima.found.size(), most_choices), minima.found.front());
    place.choices = std::move(minima.found);
    chamber.leave(*place.scene, place.choices.front().x);
    break;
  }
  return place;
}

/// The choice at each pose that makes values and moves together least.
std::vector<std::size_t> best_sequence(std::span<const Place> places, double coupling) {
  std::vector<std::vector<double>> cost;
  std::vector<std::vector<std::size_t>> from;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto& choices = places[k].choices;
    cost.emplace_back(choices.size(), infinity);
    from.emplace_back(choices.size(), 0);
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (k == 0) {
        cost[k][i] = choices[i].value;
        continue;
      }
      const Vec3 here = places[k].scene->outward(choices[i].x);
      for (std::size_t j = 0; j < places[k - 1].choices.size(); ++j) {
        const Vec3 there = places[k - 1].scene->outward(places[k - 1].choices[j].x);
        const double sum = cost[k - 1][j] + choices[i].value + coupling * (here - there).squaredNorm();
        if (sum < cost[k][i]) {
          cost[k][i] = sum;
          from[k][i] = j;
        }
      }
    }
  }
  std::vector<std::size_t> out(places.size());
  out.back() = static_cast<std::size_t>(std::ranges::min_element(cost.back()) - cost.back().begin());
  for (std::size_t k = places.size() - 1; k > 0; --k) out[k - 1] = from[k][out[k]];
  return out;
}

void place_segment(std::span<const Place> places, double coupling, const std::stop_token& stop,
                   std::span<InternalPoint> out) {
  const std::vector<std::size_t> choice = best_sequence(places, coupling);
  std::vector<Stop> stops;
  for (std::size_t k = 0; k < places.size(); ++k)
    stops.push_back({places[k].merit.get(), places[k].choices[choice[k]].x});
  const bool settled = settle_path(stops, coupling, stop);
  for (std::size_t k = 0; k < places.size(); ++k)
    out[k] = internal_point(*stops[k].merit, stops[k].x,
                            settled ? InternalPointStatus::found : InternalPointStatus::stopped);
}

}  // namespace

std::vector<InternalPoint> best_internal_path(const Geometry& g, std::span<const PlatformPose> poses,
                                              const InternalPointProblem& problem, double smoothness,
                                              const std::optional<Vec3>& start, const Control& control) {
  validate(problem);
  require_positive("smoothness", smoothness);
  std::vector<InternalPoint> out(poses.size());
  std::vector<Place> places;
  Chamber chamber(start);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (control.stop.stop_requested()) throw Stopped{};
    places.push_back(look(g, poses[k], problem, chamber, out[k]));
    if (places.back().choices.empty()) chamber.divide();
    if (control.progress) control.progress(static_cast<long>(k + 1), static_cast<long>(poses.size()), not_a_number);
  }
  const auto first = std::ranges::find_if(places, [](const Place& p) { return p.scene != nullptr; });
  if (first == places.end()) return out;
  // n times the objective: the number of poses divides the values, not the points.
  const double n = static_cast<double>(poses.size()), unit = first->scene->unit();
  const double coupling = smoothness * std::max(1.0, n - 1.0) * n / (unit * unit);
  for (std::size_t k = 0; k < places.size();) {
    std::size_t end = k;
    while (end < places.size() && !places[end].choices.empty()) ++end;
    if (end > k) place_segment({&places[k], end - k}, coupling, control.stop, {&out[k], end - k});
    k = std::max(end, k + 1);
  }
  return out;
}

}  // namespace ninedof
