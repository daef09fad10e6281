#include "redundancy/search/nearby.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

constexpr std::array close{1e-4, 1e-6, 1e-8};
constexpr std::array near{3e-3, 1e-4, 1e-6, 1e-8};

/// Decrements, in epsilons: from the first one on Newton's method needs few steps. The second is that of a minimum: sharper than a
/// search asks for, because what is to be carried to the next epsilon must be known well against that.
constexpr double within_reach = 3.0, settled = 1e-6;
constexpr double relative_change = 1e-4;  // of epsilon, in differences
constexpr int most_pushes = 6;

/// The bounds with less than `margin` in front of them, the nearest three: what is left there, and the way in which that grows.
class Tight {
 public:
  Tight(const Merit& merit, const Vec3& x, double margin) : margin_(margin) {
    const Scene& scene = merit.scene();
    for (int k = 0; k < 6; ++k) {
      const double low = scene.low()[k], high = scene.high()[k];
      const Vec3 leg = x - scene.joint(k);
      const double length = leg.norm();
      if (low > 0.0) add(length - low, leg / length);
      add(high - length, -leg / length);
    }
    const double clearance = merit.problem().clearance;
    if (scene.determinants(x).cwiseAbs().minCoeff() > clearance * (1.0 + 2.0 * margin)) return;
    for (const Jet& f : scene.log_determinants(x)) add(f.value - std::log(clearance), f.gradient);
  }

  bool none() const { return count_ == 0; }

  /// The shortest step that leaves `wish` before each of them, to first order.
  Vec3 step(double wish) const {
    Mat3 gram = way_.transpose() * way_;
    Vec3 lack = Vec3::Zero();
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (i < count_) lack[i] = wish - left_[i];
      else gram(i, i) = 1.0;
      gram(i, i) *= 1.0 + 1e-9;  // parallel ways
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

/// Moves x off the bounds it breaks or touches; false if that did not leave a margin before all of them.
bool push_inside(const Merit& merit, double margin, Vec3& x) {
  for (int k = 0; k < most_pushes; ++k) {
    const Tight tight(merit, x, 0.5 * margin);
    if (tight.none()) return true;
    const Vec3 way = tight.step(margin);
    if (!way.allFinite()) return false;
    x += std::min(1.0, 0.5 * merit.scene().clear_way(x, way, 2.0)) * way;
  }
  return Tight(merit, x, 0.5 * margin).none();
}

/// Whether Newton's method needs few steps from a point where the function is f.
bool in_reach(const Jet& f, double epsilon) {
  return -newton_step(f).dot(f.gradient) <= within_reach * epsilon;
}

/// The minimum for one epsilon, from that for another: one Newton step in x and epsilon at once. The change of the gradient with
/// epsilon is a difference; an error of it costs steps, not accuracy.
Vec3 carried(const Soft& f, double from, double to, const Descent& d) {
  Jet other;
  if (!f(d.x, from * (1.0 + relative_change), other)) return d.x;
  Jet there = d.at;
  there.gradient += (to - from) / (relative_change * from) * (other.gradient - d.at.gradient);
  return d.x + newton_step(there);
}

/// As `descend`, from where the function is d.at already.
void sharpen(const Scene& scene, const Soft& f, std::span<const double> epsilons, Descent& d) {
  for (std::size_t k = 0; k < epsilons.size(); ++k) {
    const double epsilon = epsilons[k];
    const Vec3 before = d.x;
    if (k > 0) {
      const Vec3 ahead = carried(f, epsilons[k - 1], epsilon, d);
      Jet there;
      const bool near_by = scene.clear_way(d.x, ahead - d.x, 1.0) >= 1.0 && f(ahead, epsilon, there);
      if (near_by && in_reach(there, epsilon)) {
        d.x = ahead;
        d.at = there;
      } else if (!f(d.x, epsilon, d.at)) {
        d.ending = Ending::stuck;
        return;
      }
    }
    if (!settle(scene, f, epsilon, settled, d)) return;
    if (k > 0) d.limit = d.x - (d.x - before) * (epsilon / (epsilon - epsilons[k - 1]));
  }
}

/// As enter_limits, but from a point next to where it ends.
bool enter_nearby(const Merit& merit, Vec3& x, Minima& minima) {
  const Soft violation = [&merit](const Vec3& at, double epsilon, Jet& f) {
    return merit.soft_violation(at, epsilon, f);
  };
  Descent d;
  d.x = d.limit = x;
  if (!violation(x, close[0], d.at) || !in_reach(d.at, close[0])) return enter_limits(merit, x, minima);
  sharpen(merit.scene(), violation, close, d);
  if (d.ending != Ending::minimum) return enter_limits(merit, x, minima);
  x = minima.nearest = d.x;
  minima.violation = merit.violation(x);
  return minima.violation < limit_tolerance;
}

}  // namespace

Minima nearby_minimum(const Merit& merit, const Vec3& start) {
  Minima out{{}, infinity, Vec3::Zero()};
  const Soft soft = [&merit](const Vec3& x, double epsilon, Jet& f) { return merit.soft(x, epsilon, f); };
  for (const std::span<const double> epsilons : {std::span<const double>(close), {near}}) {
    Descent d;
    d.x = start;
    if (!push_inside(merit, epsilons[0], d.x) || !merit.soft(d.x, epsilons[0], d.at)) continue;
    if (epsilons.size() == close.size() && !in_reach(d.at, epsilons[0])) continue;
    d.limit = d.x;
    sharpen(merit.scene(), soft, epsilons, d);
    if (d.ending != Ending::minimum) continue;
    out.found.push_back(local_end(merit, d));
    return out;
  }
  Vec3 x = start;
  if (merit.violation(x) >= limit_tolerance && !enter_nearby(merit, x, out)) return out;
  out.found.push_back(local_end(merit, descend(merit.scene(), soft, x, sharpening())));
  return out;
}

}  // namespace ninedof
