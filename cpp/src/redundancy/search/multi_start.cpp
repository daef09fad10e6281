#include "redundancy/search/multi_start.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/numbers.hpp"
#include "math/sort_by.hpp"

namespace ninedof {
namespace {

constexpr std::array coarse{3e-2};

// Lengths are in sizes of the robot.
constexpr std::array reaches{0.15, 0.5, 1.5, 10.0};  // of points on rays
constexpr double near_by = 1.0;  // of them: ways to other parts of the chamber may lead outside of the grid of Reach
constexpr double apart = 0.3;        // least distance of two starts
constexpr double same = 1e-2;  // greatest distance of two ends of coarse descents that count as one
constexpr std::size_t most_starts = 8, limit_starts = 6;
constexpr double beside_joint = 1e-2;  // distance of the starts beside an internal joint
constexpr int around_joint = 128;  // directions there
constexpr double promising = 0.1;  // in the criterion above the best minimum: the best of them is refined
constexpr double close_to_joint = 1e-3, coarsest_turn = 0.2, finest_turn = 1e-3;
constexpr std::array before_joint{5e-4, 1e-3, 2e-3, 4e-3, 8e-3, 1.6e-2, 3.2e-2};  // distances of starts that leave it
constexpr int points_of_scan = 20;  // along each axis
constexpr double hopeless = 0.5;  // coarse descents that end this much above the best are abandoned

struct Sample {
  Vec3 x;
  double value;
};

/// The end of a coarse descent, and the smoothed criterion there.
struct End {
  Vec3 start, x;
  double value;
};

/// The best samples at least `apart` from each other, at most `count`.
std::vector<Vec3> best_apart(std::vector<Sample>& samples, std::size_t count) {
  sort_by(samples, &Sample::value);
  std::vector<Vec3> out;
  for (const Sample& s : samples) {
    if (out.size() == count) break;
    if (std::ranges::all_of(out, [&](const Vec3& y) { return (y - s.x).norm() > apart; })) out.push_back(s.x);
  }
  return out;
}

class Search {
 public:
  Search(const PoseObjective& objective, const Vec3& start)
      : objective_(objective),
        pose_(objective.pose()),
        reach_(objective.pose(), start),
        minima_{{}, infinity, start},
        soft_([this](const Vec3& x, double epsilon, Jet& out) { return objective_.soft(x, epsilon, out); }) {}

  /// Samples points on rays from x, none of them beyond a singularity.
  void sample_around(const Vec3& x) {
    add_sample(x);
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b)
        for (int c = -1; c <= 1; ++c) {
          if (a == 0 && b == 0 && c == 0) continue;
          const Vec3 direction = Vec3(a, b, c).normalized();
          const double way = pose_.step_to_singularity(x, direction, far_away);
          // Near the robot, and always closer than the singularity.
          for (const double reach : reaches) {
            const Vec3 y = x + direction * (way * reach / (way + reach));
            add_sample(y);
            if (reach > near_by) reach_.add_far(y);
          }
        }
  }

  /// Adds starts within the limits from samples outside them.
  void enter_limits() {
    for (const Vec3& start : best_apart(outside_, limit_starts)) {
      Vec3 x = start;
      if (ninedof::enter_limits(objective_, x, minima_)) add_sample(x);
    }
  }

  /// Runs coarse descents from the best samples.
  void descend_from_best() {
    for (const Vec3& start : best_apart(inside_, most_starts)) {
      const Descent d = descend(pose_, soft_, start, coarse);
      const auto known = [&](const End& end) { return (end.x - d.x).norm() <= same; };
      if (std::ranges::none_of(rough_, known)) rough_.push_back({start, d.x, d.at.value});
    }
    sort_by(rough_, &End::value);
  }

  /// Refines the coarse ends to minima.
  void refine_ends() {
    for (const End& end : rough_) {
      if (end.value > rough_.front().value + hopeless) break;
      Descent d = descend(pose_, soft_, end.x, final_epsilons());
      if (d.ending == Ending::away || d.ending == Ending::in_joint)
        d = descend(pose_, soft_, end.start, final_epsilons());
      minima_.add(end_of(objective_, d));
    }
    for (const LocalMinimum& m : minima_.found) reach_.add(m.x);
  }

  /// Descends into the internal joints: the criterion depends on the direction there, which the grid of a scan misses.
  void descend_into_joints() {
    for (int k = 0; k < 6; ++k) {
      Vec3 best = Vec3::Zero();
      double least = minima_.best() + promising;
      for (int n = 0; n < around_joint; ++n) {
        // A spiral over the sphere, with the golden angle.
        const double z = (2.0 * n + 1.0) / around_joint - 1.0, turn = 2.399963229728653 * n;
        const double flat = std::sqrt(1.0 - z * z);
        const Vec3 x = pose_.joint(k) + beside_joint * Vec3(flat * std::cos(turn), flat * std::sin(turn), z);
        if (const double value = allowed_value(x); value < least) {
          best = x;
          least = value;
        }
      }
      if (!(least < minima_.best() + promising)) continue;
      const bool lower = least < minima_.best();
      if (!lower) least = turn_about_joint(k, best);
      if (!(least < minima_.best()) || !reach_.reaches(best)) continue;
      // From so near, a descent begun with strong smoothing would leave the joint.
      minima_.add(lower ? end_of(objective_, descend(pose_, soft_, best, final_epsilons()))
                        : minimum_from(objective_, best));
    }
  }

  /// Where the best end is a joint, looks for a better one beside it: a crease of the criterion that leads into the
  /// joint may have its lowest point so near that the coarse descents pass it.
  void search_before_joint() {
    if (minima_.found.empty()) return;
    const LocalMinimum best = *std::ranges::min_element(minima_.found, {}, &LocalMinimum::value);
    if (best.ending != Ending::in_joint || best.leg < 0) return;
    const Vec3 joint = pose_.joint(best.leg), way = (best.x - joint).normalized();
    for (const double distance : before_joint) {
      const Vec3 x = joint + distance * way;
      if (objective_.allows(x) && reach_.reaches(x)) minima_.add(minimum_from(objective_, x));
    }
  }

  /// The start is a candidate as well: the answer is never worse.
  void descend_from_start(const Vec3& start) {
    if (!objective_.allows(start)) return;
    for (const LocalMinimum& end : warm_minimum(objective_, start).found) minima_.add(end);
    if (objective_.exact(start) < minima_.best() - least_gain) minima_.add(minimum_from(objective_, start));
  }

  void scan_chamber() { add_valleys(objective_, points_of_scan, reach_, minima_); }

  /// The minima, best first.
  Minima finish() {
    sort_by(minima_.found, &LocalMinimum::value);
    return std::move(minima_);
  }

 private:
  /// The criterion at x; infinite where the chamber or the limits exclude it.
  double allowed_value(const Vec3& x) const {
    const bool allowed = objective_.in_chamber(x) && objective_.violation(x) < limit_tolerance;
    return allowed ? objective_.exact(x) : infinity;
  }

  /// Moves x close to a joint and turns it about it to where the criterion is least: the directions looked at are too
  /// few to show how low it is there. Returns the value.
  double turn_about_joint(int k, Vec3& x) const {
    const Vec3 joint = pose_.joint(k);
    x = joint + close_to_joint * (x - joint).normalized();
    double least = allowed_value(x);
    for (double turn = coarsest_turn; turn > finest_turn;) {
      const Vec3 way = (x - joint).normalized(), side = way.unitOrthogonal(), other = way.cross(side);
      bool lower = false;
      for (const Vec3& step : {side, Vec3(-side), other, Vec3(-other)}) {
        const Vec3 y = joint + close_to_joint * (way + turn * step).normalized();
        const double value = allowed_value(y);
        if (!(value < least)) continue;
        least = value;
        x = y;
        lower = true;
      }
      if (!lower) turn *= 0.5;
    }
    return least;
  }

  void add_sample(const Vec3& x) {
    if (!objective_.in_chamber(x)) return;
    const double broken = objective_.violation(x);
    if (broken < limit_tolerance) {
      inside_.push_back({x, objective_.exact(x)});
    } else {
      outside_.push_back({x, broken});
    }
  }

  const PoseObjective& objective_;
  const ScaledPose& pose_;
  Reach reach_;
  Minima minima_;
  Smoothed soft_;
  std::vector<Sample> inside_, outside_;
  std::vector<End> rough_;
};

}  // namespace

Minima local_minima(const PoseObjective& objective, const Vec3& start) {
  Search search(objective, start);
  search.sample_around(start);
  search.enter_limits();
  search.descend_from_best();
  search.refine_ends();
  search.descend_from_start(start);
  search.descend_into_joints();
  search.scan_chamber();
  search.search_before_joint();
  return search.finish();
}

}  // namespace ninedof
