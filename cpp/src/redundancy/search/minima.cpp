#include "redundancy/search/minima.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

// A multi-start search begins with strong smoothing, which merges many starts. From a start near a minimum the first
// smoothing is only as strong as the distance to it requires: the result stays near the start, after few steps.
constexpr std::array close{1e-4, 1e-6, 1e-8};
constexpr std::array near{3e-3, 1e-4, 1e-6, 1e-8};
constexpr std::array fine{3e-2, 3e-3, 1e-4, 1e-6, 1e-8};
constexpr std::array into_limits{1e-1, 1e-2};
constexpr std::array into_corners{1e-2, 1e-4, 1e-6, 1e-8};
constexpr double same_minimum = 1e-6;  // greatest distance of two minima that count as one, in sizes of the robot

/// Decrements, in epsilons. Below the first Newton's method needs few steps. The second ends a descent, earlier ones
/// than the last included: the step to the next epsilon needs an accurate minimum.
constexpr double within_reach = 3.0, settled = 1e-6;
constexpr double relative_change = 1e-4;  // of epsilon, in finite differences
constexpr int most_pushes = 6;

/// The nearest three bounds with a margin below `margin`: each with its margin and the gradient of it.
class NearBounds {
 public:
  NearBounds(const PoseObjective& objective, const Vec3& x, double margin) : margin_(margin) {
    const ScaledPose& pose = objective.pose();
    for (int k = 0; k < 12; ++k) {
      const double low = pose.low()[k], high = pose.high()[k];
      const Vec3 leg = x - pose.joint(k);
      const double length = leg.norm();
      if (low > 0.0) add(length - low, leg / length);
      add(high - length, -leg / length);
    }
    const double clearance = objective.problem().clearance;
    if (pose.determinants(x).cwiseAbs().minCoeff() > clearance * (1.0 + 2.0 * margin)) return;
    for (const Jet& f : pose.log_determinants(x)) add(f.value - std::log(clearance), f.gradient);
  }

  bool none() const { return count_ == 0; }

  /// The shortest step that restores the margin `wish` of each, to first order.
  Vec3 step(double wish) const {
    Mat3 gram = way_.transpose() * way_;
    Vec3 lack = Vec3::Zero();
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (i < count_) lack[i] = wish - left_[i];
      else gram(i, i) = 1.0;
      gram(i, i) *= 1.0 + 1e-9;  // parallel gradients
    }
    return way_ * (gram.inverse() * lack);
  }

 private:
  void add(double left, const Vec3& way) {
    if (!(left < margin_)) return;
    Eigen::Index place = count_;
    if (count_ == 3) {
      if (left_.maxCoeff(&place) <= left) return;
    } else {
      ++count_;
    }
    left_[place] = left;
    way_.col(place) = way;
  }

  double margin_;
  Vec3 left_ = Vec3::Zero();
  Mat3 way_ = Mat3::Zero();
  Eigen::Index count_ = 0;
};

/// Moves x off the bounds it breaks or touches; false if some margin stays below half of `margin`.
bool push_inside(const PoseObjective& objective, double margin, Vec3& x) {
  for (int k = 0; k < most_pushes; ++k) {
    const NearBounds bounds(objective, x, 0.5 * margin);
    if (bounds.none()) return true;
    const Vec3 way = bounds.step(margin);
    if (!way.allFinite()) return false;
    x += std::min(1.0, 0.5 * objective.pose().step_to_singularity(x, way, 2.0)) * way;
  }
  return NearBounds(objective, x, 0.5 * margin).none();
}

/// Whether Newton's method needs only a few steps from a point where the function is f.
bool in_reach(const Jet& f, double epsilon) {
  return -newton_step(f).dot(f.gradient) <= within_reach * epsilon;
}

/// The minimum for the epsilon `to`, predicted from that for `from`: one Newton step in x and epsilon together. The
/// derivative of the gradient by epsilon is a finite difference; its error costs steps, not accuracy.
Vec3 predicted(const Smoothed& f, double from, double to, const Descent& d) {
  Jet other;
  if (!f(d.x, from * (1.0 + relative_change), other)) return d.x;
  Jet there = d.at;
  there.gradient += (to - from) / (relative_change * from) * (other.gradient - d.at.gradient);
  return d.x + newton_step(there);
}

/// As `descend`, from d.x, where the function is d.at.
void sharpen(const ScaledPose& pose, const Smoothed& f, std::span<const double> epsilons, Descent& d) {
  for (std::size_t k = 0; k < epsilons.size(); ++k) {
    const double epsilon = epsilons[k];
    const Vec3 before = d.x;
    if (k > 0) {
      const Vec3 ahead = predicted(f, epsilons[k - 1], epsilon, d);
      Jet there;
      const bool near_by = pose.step_to_singularity(d.x, ahead - d.x, 1.0) >= 1.0 && f(ahead, epsilon, there);
      if (near_by && in_reach(there, epsilon)) {
        d.x = ahead;
        d.at = there;
      } else if (!f(d.x, epsilon, d.at)) {
        d.ending = Ending::stuck;
        return;
      }
    }
    if (!settle(pose, f, epsilon, settled, d)) return;
    if (k > 0) d.limit = d.x - (d.x - before) * (epsilon / (epsilon - epsilons[k - 1]));
  }
}

/// As enter_limits, from a point near its end.
bool enter_limits_warm(const PoseObjective& objective, Vec3& x, Minima& minima) {
  const Smoothed violation = [&objective](const Vec3& at, double epsilon, Jet& f) {
    return objective.soft_violation(at, epsilon, f);
  };
  Descent d;
  d.x = d.limit = x;
  if (!violation(x, close[0], d.at) || !in_reach(d.at, close[0])) return enter_limits(objective, x, minima);
  sharpen(objective.pose(), violation, close, d);
  if (d.ending != Ending::minimum) return enter_limits(objective, x, minima);
  x = minima.nearest = d.x;
  minima.violation = objective.violation(x);
  return minima.violation < limit_tolerance;
}

}  // namespace

double Minima::best() const {
  return found.empty() ? infinity : std::ranges::min(found, {}, &LocalMinimum::value).value;
}

void Minima::add(const LocalMinimum& minimum) {
  const auto same = [&](const LocalMinimum& other) { return (other.x - minimum.x).norm() < same_minimum; };
  const auto known = std::ranges::find_if(found, same);
  if (known == found.end()) {
    found.push_back(minimum);
  } else if (minimum.value < known->value) {
    known->x = minimum.x;
    known->value = minimum.value;
  }
}

LocalMinimum end_of(const PoseObjective& objective, const Descent& d) {
  const double soft = objective.exact(d.x);
  if (objective.violation(d.limit) <= limit_tolerance && objective.in_chamber(d.limit)) {
    const double sharp = objective.exact(d.limit);
    if (sharp <= soft) return {d.limit, sharp, d.ending, d.leg};
  }
  return {d.x, soft, d.ending, d.leg};
}

bool enter_limits(const PoseObjective& objective, Vec3& x, Minima& minima) {
  const Smoothed violation = [&objective](const Vec3& at, double epsilon, Jet& out) {
    return objective.soft_violation(at, epsilon, out);
  };
  Descent d = descend(objective.pose(), violation, x, into_limits);
  if (objective.violation(d.x) >= 0.0) d = descend(objective.pose(), violation, d.x, into_corners);
  for (const Vec3& end : {d.x, d.limit}) {
    const double broken = objective.violation(end);
    if (broken < minima.violation) {
      minima.violation = broken;
      minima.nearest = end;
    }
  }
  x = d.x;
  return objective.violation(x) < limit_tolerance;
}

std::span<const double> final_epsilons() {
  return fine;
}

Minima warm_minimum(const PoseObjective& objective, const Vec3& start) {
  Minima out{{}, infinity, start};
  const Smoothed soft = [&objective](const Vec3& x, double epsilon, Jet& f) { return objective.soft(x, epsilon, f); };
  for (const std::span<const double> epsilons : {std::span<const double>(close), {near}}) {
    Descent d;
    d.x = start;
    if (!push_inside(objective, epsilons[0], d.x) || !objective.soft(d.x, epsilons[0], d.at)) continue;
    if (epsilons.size() == close.size() && !in_reach(d.at, epsilons[0])) continue;
    d.limit = d.x;
    sharpen(objective.pose(), soft, epsilons, d);
    if (d.ending != Ending::minimum) continue;
    out.found.push_back(end_of(objective, d));
    return out;
  }
  Vec3 x = start;
  if (!objective.in_chamber(x)) return out;  // within the clearance
  if (objective.violation(x) >= limit_tolerance && !enter_limits_warm(objective, x, out)) return out;
  out.found.push_back(end_of(objective, descend(objective.pose(), soft, x, final_epsilons())));
  return out;
}

LocalMinimum minimum_from(const PoseObjective& objective, const Vec3& start) {
  const double value = objective.exact(start), enough = value + least_gain;
  Descent d;
  d.x = d.limit = start;
  const Smoothed soft = [&objective](const Vec3& x, double epsilon, Jet& f) { return objective.soft(x, epsilon, f); };
  if (push_inside(objective, close[0], d.x) && objective.soft(d.x, close[0], d.at)) {
    sharpen(objective.pose(), soft, close, d);
    const LocalMinimum end = end_of(objective, d);
    if (end.ending != Ending::stuck && end.value <= enough) return end;
  }
  for (const LocalMinimum& end : warm_minimum(objective, start).found)
    if (end.value <= enough) return end;
  return {start, value, Ending::stuck};
}

}  // namespace ninedof
