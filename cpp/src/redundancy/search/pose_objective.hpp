#pragma once
/// The function minimised over O at one pose: the smoothed criterion plus a logarithmic barrier for every bound.

#include <vector>

#include "ninedof/conditioning/sensitivity.hpp"
#include "redundancy/search/scaled_pose.hpp"

namespace ninedof {

/// Lengths may break their limits by this much, in sizes of the robot.
constexpr double limit_tolerance = 1e-10;

/// The logarithm of the condition number, smoothed: epsilon log sum (sigma_k)^(1/epsilon) + epsilon log sum
/// (sigma_k)^(-1/epsilon), at most 2 epsilon log 6 above log(sigma_1 / sigma_6). Symmetric in the singular values,
/// it is smooth in O even where they coincide. Every sigma must be positive.
Jet soft_condition(const Points& at, const NineLegs& legs, const Spectrum& s, double epsilon);

/// The criterion as a quantity to minimise (the logarithm of the condition number, minus the logarithm of the least
/// |det|, the sum of squares) and the bounds, for one pose and one chamber.
class PoseObjective {
 public:
  PoseObjective(const ScaledPose& pose, const InternalPointProblem& problem);

  const ScaledPose& pose() const { return pose_; }
  const InternalPointProblem& problem() const { return problem_; }

  /// Selects the chamber of x by the signs of the three volumes.
  void enter_chamber(const Vec3& x) { signs_ = pose_.volumes(x).cwiseSign(); }
  const Vec3& signs() const { return signs_; }
  /// Whether the three determinants have the signs of the chamber and are greater than the clearance.
  bool in_chamber(const Vec3& x) const;

  /// The largest violation of a limit at x, in sizes of the robot; negative inside.
  double violation(const Vec3& x) const { return worst_limit(x).broken; }

  /// Moves x to the limit it breaks most, at most `most` times; the violation then.
  double project(Vec3& x, int most) const;

  /// Whether x is a point that a search may return: in the chamber, above the clearance, within the limits.
  bool allows(const Vec3& x) const { return in_chamber(x) && violation(x) <= limit_tolerance; }

  /// The criterion without smoothing; infinite where singular.
  double exact(const Vec3& x) const;

  /// Criterion and barriers smoothed: the minimum is O(epsilon) from the exact one. False outside, without `out`.
  bool soft(const Vec3& x, double epsilon, Jet& out) const;

  /// The smoothed largest violation, with the barriers of the chamber: its minimum is an allowed point if any is.
  bool soft_violation(const Vec3& x, double epsilon, Jet& out) const;

  /// The bounds that x touches: `contact` from a limit, in sizes of the robot, or from the logarithm of the clearance.
  ActiveBounds touched(const Vec3& x, double contact) const;

  /// The limits that x breaks most, all of those within `contact` of the worst.
  ActiveBounds broken(const Vec3& x, double contact) const;

  /// The determinants that are not above the clearance at x.
  ActiveBounds below_clearance(const Vec3& x) const;

 private:
  /// A limit's violation and the direction that lessens it.
  struct WorstLimit {
    double broken;
    Vec3 way;
  };
  WorstLimit worst_limit(const Vec3& x) const;
  bool add_clearance(const std::array<Jet, 3>& logs, double epsilon, Jet& out) const;

  const ScaledPose& pose_;
  const InternalPointProblem& problem_;
  Vec3 signs_ = Vec3::Ones();
  std::vector<int> limited_;  // joints whose distance from O has a limit
};

}  // namespace ninedof
