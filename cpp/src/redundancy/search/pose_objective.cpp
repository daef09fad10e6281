#include "redundancy/search/pose_objective.hpp"

#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/conditioning/conditioning.hpp"

namespace ninedof {
namespace {

constexpr double wall_contact = 1e-4;  // of the logarithm of the clearance, whose barrier is smooth

/// Distance of x from a joint.
Jet distance(const Vec3& x, const Vec3& joint) {
  Jet out;
  const Vec3 v = x - joint;
  out.value = v.norm();
  out.gradient = v / out.value;
  out.hessian = (Mat3::Identity() - out.gradient * out.gradient.transpose()) / out.value;
  return out;
}

/// Adds the barrier -epsilon log room of a bound at distance `room`, positive inside; d room = slope d f.
void add_barrier(double room, double slope, double epsilon, const Jet& f, Jet& out) {
  out.add_function(-epsilon * std::log(room), -epsilon * slope / room, epsilon * slope * slope / (room * room), f);
}

/// Adds epsilon log sum exp(jet / epsilon), the smoothed maximum of the first `count` jets.
template <std::size_t N>
void add_soft_largest(const std::array<Jet, N>& jets, std::size_t count, double epsilon, Jet& out) {
  double largest = -infinity, sum = 0.0;
  for (std::size_t k = 0; k < count; ++k) largest = std::max(largest, jets[k].value);
  for (std::size_t k = 0; k < count; ++k) sum += std::exp((jets[k].value - largest) / epsilon);
  Jet mean;
  Mat3 spread = Mat3::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const double share = std::exp((jets[k].value - largest) / epsilon) / sum;
    mean.add(share, jets[k]);
    spread += share * (jets[k].gradient * jets[k].gradient.transpose());
  }
  out.value += largest + epsilon * std::log(sum);
  out.gradient += mean.gradient;
  out.hessian += mean.hessian + (spread - mean.gradient * mean.gradient.transpose()) / epsilon;
}

/// The bound that a least distance of O from joint k stands for; next to an external joint det N has no limit.
int low_bound(int k) {
  return k < 6 ? ActiveBounds::low(3 + k) : ActiveBounds::clearance(2);
}

}  // namespace

PoseObjective::PoseObjective(const ScaledPose& pose, const InternalPointProblem& problem)
    : pose_(pose), problem_(problem) {
  for (int k = 0; k < 12; ++k)
    if (pose.low()[k] > 0.0 || pose.high()[k] < infinity) limited_.push_back(k);
}

bool PoseObjective::in_chamber(const Vec3& x) const {
  return (signs_.cwiseProduct(pose_.determinants(x)).array() > problem_.clearance).all();
}

PoseObjective::WorstLimit PoseObjective::worst_limit(const Vec3& x) const {
  WorstLimit worst{-infinity, Vec3::Zero()};
  for (const int k : limited_) {
    const double low = pose_.low()[k], high = pose_.high()[k];
    const Vec3 leg = x - pose_.joint(k);
    const double length = leg.norm();
    if (low - length > worst.broken) worst = {low - length, leg / length};
    if (length - high > worst.broken) worst = {length - high, -leg / length};
  }
  return worst;
}

double PoseObjective::project(Vec3& x, int most) const {
  WorstLimit worst = worst_limit(x);
  for (int k = 0; k < most && worst.broken > 0.0 && worst.way.allFinite(); ++k) {
    x += worst.broken * worst.way;
    worst = worst_limit(x);
  }
  return worst.broken;
}

double PoseObjective::exact(const Vec3& x) const {
  switch (problem_.criterion) {
    case Criterion::condition_number:
      return std::log(condition_number(pose_.geometry(), pose_.configuration(x), problem_.characteristic_length));
    case Criterion::singularity: return -std::log(pose_.determinants(x).cwiseAbs().minCoeff());
    case Criterion::leg_centring: {
      double sum = 0.0;
      for (int k = 0; k < 6; ++k) {
        const double middle = 0.5 * (pose_.low()[k] + pose_.high()[k]), half = 0.5 * (pose_.high()[k] - pose_.low()[k]);
        const double z = ((x - pose_.joint(k)).norm() - middle) / half;
        sum += z * z;
      }
      return sum;
    }
  }
  return infinity;
}

bool PoseObjective::add_clearance(const std::array<Jet, 3>& logs, double epsilon, Jet& out) const {
  const double least = std::log(problem_.clearance);
  for (const Jet& f : logs) {
    if (!(f.value > least)) return false;
    add_barrier(f.value - least, 1.0, epsilon, f, out);
  }
  return true;
}

bool PoseObjective::soft(const Vec3& x, double epsilon, Jet& out) const {
  out = Jet{};
  if ((pose_.volumes(x).cwiseSign().array() != signs_.array()).any()) return false;
  const std::array<Jet, 3> logs = pose_.log_determinants(x);
  if (!add_clearance(logs, epsilon, out)) return false;
  for (const int k : limited_) {
    const double low = pose_.low()[k], high = pose_.high()[k];
    const bool finite = std::isfinite(high);
    const Jet length = distance(x, pose_.joint(k));
    const double above = length.value - low + limit_tolerance, below = high - length.value + limit_tolerance;
    if (!(above > 0.0) || !(below > 0.0)) return false;
    if (low > 0.0) add_barrier(above, 1.0, epsilon, length, out);
    if (finite) add_barrier(below, -1.0, epsilon, length, out);
    if (problem_.criterion != Criterion::leg_centring || k >= 6) continue;
    const double half = 0.5 * (high - low), z = (length.value - 0.5 * (low + high)) / half;
    out.add_function(z * z, 2.0 * z / half, 2.0 / (half * half), length);
  }
  if (problem_.criterion == Criterion::singularity) {
    std::array<Jet, 3> negative;
    for (std::size_t k = 0; k < 3; ++k) negative[k].add(-1.0, logs[k]);
    add_soft_largest(negative, 3, epsilon, out);
  }
  if (problem_.criterion == Criterion::condition_number) {
    const Points at = pose_.points(x);
    const NineLegs legs = nine_legs(at);
    const Spectrum s = spectrum(at, legs, pose_.characteristic_length());
    if (!(s.sigma[5] > 0.0)) return false;
    out.add(1.0, soft_condition(at, legs, s, epsilon));
  }
  return out.gradient.allFinite() && out.hessian.allFinite();
}

bool PoseObjective::soft_violation(const Vec3& x, double epsilon, Jet& out) const {
  out = Jet{};
  if ((pose_.volumes(x).cwiseSign().array() != signs_.array()).any()) return false;
  if (!add_clearance(pose_.log_determinants(x), epsilon, out)) return false;
  std::array<Jet, 24> broken;
  std::size_t count = 0;
  for (const int k : limited_) {
    const double low = pose_.low()[k], high = pose_.high()[k];
    const Jet length = distance(x, pose_.joint(k));
    if (low > 0.0) broken[count++].add_function(low - length.value, -1.0, 0.0, length);
    if (std::isfinite(high)) broken[count++].add_function(length.value - high, 1.0, 0.0, length);
  }
  add_soft_largest(broken, count, epsilon, out);
  return out.gradient.allFinite() && out.hessian.allFinite();
}

ActiveBounds PoseObjective::touched(const Vec3& x, double contact) const {
  ActiveBounds out;
  for (int k = 0; k < 12; ++k) {
    const double length = (x - pose_.joint(k)).norm();
    if (pose_.low()[k] > 0.0 && length - pose_.low()[k] <= contact) out.add(low_bound(k));
    if (pose_.high()[k] - length <= contact) out.add(ActiveBounds::high(3 + k));
  }
  const Vec3 determinants = pose_.determinants(x).cwiseAbs();
  for (int k = 0; k < 3; ++k)
    if (std::log(determinants[k] / problem_.clearance) <= wall_contact) out.add(ActiveBounds::clearance(k));
  return out;
}

ActiveBounds PoseObjective::broken(const Vec3& x, double contact) const {
  ActiveBounds out;
  const double worst = violation(x) - contact;
  for (int k = 0; k < 12; ++k) {
    const double length = (x - pose_.joint(k)).norm();
    if (pose_.low()[k] - length >= worst) out.add(low_bound(k));
    if (length - pose_.high()[k] >= worst) out.add(ActiveBounds::high(3 + k));
  }
  return out;
}

ActiveBounds PoseObjective::below_clearance(const Vec3& x) const {
  ActiveBounds out;
  const Vec3 determinants = pose_.determinants(x).cwiseAbs();
  for (int k = 0; k < 3; ++k)
    if (determinants[k] <= problem_.clearance) out.add(ActiveBounds::clearance(k));
  return out;
}

}  // namespace ninedof
