#include "redundancy/search/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/rotation.hpp"

namespace ninedof {
namespace {

constexpr std::array coarse{3e-2};
constexpr std::array fine{3e-2, 3e-3, 1e-4, 1e-6, 1e-8};
constexpr std::array into_limits{1e-1, 1e-2};
constexpr std::array into_corners{1e-2, 1e-4, 1e-6, 1e-8};

// Lengths are in sizes of the robot.
constexpr std::array reaches{0.15, 0.5, 1.5, 10.0};  // of points on rays
constexpr double apart = 0.3;        // least distance of two starts
constexpr double same = 1e-2;        // of two ends of coarse descents that are one
constexpr double same_minimum = 1e-6;  // of two minima that are one
constexpr std::size_t first_starts = 8, more_starts = 8, limit_starts = 6;
constexpr std::size_t looked_from = 5;  // minima that are looked around from again
constexpr int most_rounds = 4;
constexpr double hopeless = 0.5;  // of the criterion: coarse descents that end this much above the best are left

struct Sample {
  Vec3 x;
  double value;
};

/// Where a coarse descent ended, and the softened criterion there.
struct End {
  Vec3 start, x;
  double value;
};

bool far_from(const std::vector<Vec3>& others, const Vec3& x, double distance) {
  return std::ranges::all_of(others, [&](const Vec3& y) { return (y - x).norm() > distance; });
}

/// The best samples with `distance` between each other and from `taken`, at most `count`; they join `taken`.
std::vector<Vec3> best_apart(std::vector<Sample>& samples, std::size_t count, std::vector<Vec3>& taken) {
  std::ranges::stable_sort(samples, {}, &Sample::value);
  std::vector<Vec3> out;
  for (const Sample& s : samples) {
    if (out.size() == count) break;
    if (!far_from(taken, s.x, apart)) continue;
    out.push_back(s.x);
    taken.push_back(s.x);
  }
  return out;
}

class Search {
 public:
  explicit Search(const Merit& merit)
      : merit_(merit),
        scene_(merit.scene()),
        soft_([this](const Vec3& x, double epsilon, Jet& out) { return merit_.soft(x, epsilon, out); }) {}

  void turn() { turn_ = exp_rotation(Vec3(0.4, 0.3, 0.2)) * turn_; }

  /// Points on rays from x, each with nothing singular on the way to it.
  void look_around(const Vec3& x) {
    note(x);
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b)
        for (int c = -1; c <= 1; ++c) {
          if (a == 0 && b == 0 && c == 0) continue;
          const Vec3 direction = turn_ * Vec3(a, b, c).normalized();
          const double way = scene_.clear_way(x, direction, far_away);
          // Near the robot, and never beyond the way.
          for (const double reach : reaches) note(x + direction * (way * reach / (way + reach)));
        }
  }

  /// Starts in the limits from points outside, as far as there are any.
  void enter_limits() {
    for (const Vec3& start : best_apart(outside_, limit_starts, taken_outside_)) {
      Vec3 x = start;
      if (ninedof::enter_limits(merit_, x, minima_)) note(x);
    }
  }

  /// Coarse descents from the best samples not near an earlier start; whether one ended somewhere new.
  bool descend_from_best(std::size_t count) {
    bool fresh = false;
    for (const Vec3& start : best_apart(inside_, count, taken_)) {
      const Descent d = descend(scene_, soft_, start, coarse);
      if (!far_from(ends_, d.x, same)) continue;
      ends_.push_back(d.x);
      rough_.push_back({start, d.x, d.at.value});
      fresh = true;
    }
    return fresh;
  }

  /// Ends of coarse descents, best first.
  void sort_ends() { std::ranges::stable_sort(rough_, {}, &End::value); }
  const std::vector<End>& ends() const { return rough_; }

  /// Coarse ends made sharp.
  Minima finish() {
    sort_ends();
    for (const End& end : rough_) {
      if (end.value > rough_.front().value + hopeless) break;
      Descent d = descend(scene_, soft_, end.x, fine);
      if (d.ending == Ending::away || d.ending == Ending::in_joint) d = descend(scene_, soft_, end.start, fine);
      const Local found = local_end(merit_, d);
      if (std::ranges::none_of(minima_.found, [&](const Local& o) { return (o.x - found.x).norm() < same_minimum; }))
        minima_.found.push_back(found);
    }
    std::ranges::stable_sort(minima_.found, {}, &Local::value);
    return std::move(minima_);
  }

  bool inside() const { return !inside_.empty(); }

 private:
  void note(const Vec3& x) {
    if (!merit_.in_chamber(x)) return;
    const double broken = merit_.violation(x);
    if (broken < limit_tolerance) {
      if (!far_from(taken_, x, apart)) return;  // would never be a start
      inside_.push_back({x, merit_.exact(x)});
    } else {
      outside_.push_back({x, broken});
    }
  }

  const Merit& merit_;
  const Scene& scene_;
  Soft soft_;
  std::vector<Sample> inside_, outside_;
  std::vector<Vec3> taken_, taken_outside_, ends_;
  std::vector<End> rough_;
  Mat3 turn_ = Mat3::Identity();
  Minima minima_{{}, infinity, Vec3::Zero()};
};

}  // namespace

Local local_end(const Merit& merit, const Descent& d) {
  const double soft = merit.exact(d.x);
  if (merit.violation(d.limit) <= limit_tolerance && merit.in_chamber(d.limit)) {
    const double sharp = merit.exact(d.limit);
    if (sharp <= soft) return {d.limit, sharp, d.ending, d.leg};
  }
  return {d.x, soft, d.ending, d.leg};
}

bool enter_limits(const Merit& merit, Vec3& x, Minima& minima) {
  const Soft violation = [&merit](const Vec3& at, double epsilon, Jet& out) {
    return merit.soft_violation(at, epsilon, out);
  };
  Descent d = descend(merit.scene(), violation, x, into_limits);
  if (merit.violation(d.x) >= 0.0) d = descend(merit.scene(), violation, d.x, into_corners);
  for (const Vec3& end : {d.x, d.limit}) {
    const double broken = merit.violation(end);
    if (broken < minima.violation) {
      minima.violation = broken;
      minima.nearest = end;
    }
  }
  x = d.x;
  return merit.violation(x) < limit_tolerance;
}

std::span<const double> sharpening() {
  return fine;
}

Minima local_minima(const Merit& merit, const Vec3& start) {
  Search search(merit);
  search.look_around(start);
  search.enter_limits();
  if (!search.inside()) return search.finish();
  search.descend_from_best(first_starts);
  for (int round = 1; round < most_rounds; ++round) {
    search.sort_ends();
    const std::size_t count = std::min(looked_from, search.ends().size());
    search.turn();
    std::vector<Vec3> from;
    for (std::size_t k = 0; k < count; ++k) from.push_back(search.ends()[k].x);
    for (const Vec3& x : from) search.look_around(x);
    if (!search.descend_from_best(more_starts)) break;
  }
  return search.finish();
}

}  // namespace ninedof
