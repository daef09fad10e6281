#include "redundancy/search/descent.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

// Lengths here are in sizes of the robot.
constexpr double next_to_joint = 1e-4;
constexpr double longest_step = 0.5;  // for O near the middle; grows with its distance
constexpr double short_of_wall = 0.9;  // part of the way to a singularity that a step may take
constexpr int most_steps = 40;         // for one epsilon
constexpr double rounding = 8.0 * eps;

/// Decrements, in epsilons, that end the descent for one epsilon, and for the last one.
constexpr double nearly = 1e-3, fully = 1e-12;

/// Curvature, relative to the largest, below which a point counts as a saddle, and the first step away from it.
constexpr double falling = -1e-6, first_try = 0.1;

/// The quadratic model at a point.
struct Model {
  Vec3 way;            ///< the Newton step, with absolute curvatures
  double decrement;    ///< twice the predicted decrease
  Vec3 ridge;          ///< the direction of least curvature
  bool saddle;         ///< whether that curvature is negative
};

Model model_of(const Jet& f) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(f.hessian);
  const Vec3 size = eigen.eigenvalues().cwiseAbs();
  const double largest = size.maxCoeff();
  const Vec3 along = eigen.eigenvectors().transpose() * f.gradient;
  Model m;
  m.way = -(eigen.eigenvectors() * along.cwiseQuotient(size.cwiseMax(std::max(1e-12 * largest, 1e-9))));
  m.decrement = -m.way.dot(f.gradient);
  m.ridge = eigen.eigenvectors().col(0);
  m.saddle = eigen.eigenvalues()[0] < falling * largest;
  return m;
}

/// Takes `way`, halved until the decrease is sufficient (Armijo); false if no part of it is.
bool step(const ScaledPose& pose, const Smoothed& f, double epsilon, Vec3 way, Descent& d) {
  const double longest = longest_step * (1.0 + d.x.norm());
  if (way.norm() > longest) way *= longest / way.norm();
  const double promise = std::max(0.0, -way.dot(d.at.gradient)), slack = rounding * (1.0 + std::abs(d.at.value));
  double part = std::min(1.0, short_of_wall * pose.step_to_singularity(d.x, way, 2.0));
  for (int halving = 0; halving < 30; ++halving, part *= 0.5) {
    Jet next;
    const Vec3 x = d.x + part * way;
    if (!f(x, epsilon, next) || !(next.value <= d.at.value - 1e-4 * part * promise + slack)) continue;
    d.x = x;
    d.at = next;
    return true;
  }
  return false;
}

/// Leaves a saddle along `ridge`, to the lower side.
bool leave_saddle(const ScaledPose& pose, const Smoothed& f, double epsilon, const Vec3& ridge, Descent& d) {
  Descent one = d, other = d;
  const double worth = 10.0 * rounding * (1.0 + std::abs(d.at.value));
  const bool forth = step(pose, f, epsilon, first_try * ridge, one) && one.at.value < d.at.value - worth;
  const bool back = step(pose, f, epsilon, -first_try * ridge, other) && other.at.value < d.at.value - worth;
  if (!forth && !back) return false;
  d = forth && (!back || one.at.value <= other.at.value) ? one : other;
  return true;
}

/// Whether O is lost: far away or in a joint.
bool lost(const ScaledPose& pose, Descent& d) {
  if (d.x.norm() > far_away) {
    d.ending = Ending::away;
    return true;
  }
  // Next to an external joint det N has no limit: its value depends on the direction in which O comes.
  for (int k = 0; k < 12; ++k) {
    if (!((d.x - pose.joint(k)).norm() < next_to_joint)) continue;
    d.ending = Ending::in_joint;
    if (k < 6) d.leg = k;
    return true;
  }
  return false;
}

}  // namespace

bool settle(const ScaledPose& pose, const Smoothed& f, double epsilon, double enough, Descent& d) {
  d.ending = Ending::stuck;
  for (int k = 0; k < most_steps; ++k) {
    const Model m = model_of(d.at);
    d.decrement = m.decrement;
    const bool flat = m.decrement <= nearly * epsilon;
    d.ending = flat && !m.saddle ? Ending::minimum : Ending::stuck;
    const bool moved = flat && m.saddle                  ? leave_saddle(pose, f, epsilon, m.ridge, d)
                       : m.decrement <= enough * epsilon ? false
                                                         : step(pose, f, epsilon, m.way, d);
    if (!moved) return true;
    if (lost(pose, d)) return false;
  }
  return true;
}

Vec3 newton_step(const Jet& f) {
  return model_of(f).way;
}

Descent descend(const ScaledPose& pose, const Smoothed& f, const Vec3& start, std::span<const double> epsilons) {
  Descent d;
  d.x = d.limit = start;
  Vec3 before = start;
  for (std::size_t k = 0; k < epsilons.size(); ++k) {
    const double epsilon = epsilons[k];
    const Vec3 last = d.x;
    if (!f(d.x, epsilon, d.at)) {
      d.ending = Ending::stuck;
      return d;
    }
    if (k >= 2) {
      const double on = (epsilon - epsilons[k - 1]) / (epsilons[k - 1] - epsilons[k - 2]);
      const Vec3 ahead = d.x + on * (d.x - before);
      Jet there;
      if (pose.step_to_singularity(d.x, ahead - d.x, 1.0) >= 1.0 && f(ahead, epsilon, there) &&
          there.value <= d.at.value) {
        d.x = ahead;
        d.at = there;
      }
    }
    before = last;
    if (!settle(pose, f, epsilon, k + 1 < epsilons.size() ? nearly : fully, d)) return d;
    d.limit = k == 0 ? d.x : Vec3(d.x - (d.x - before) * (epsilon / (epsilon - epsilons[k - 1])));
  }
  return d;
}

}  // namespace ninedof
