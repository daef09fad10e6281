#pragma once
/// What is minimised over O at one pose: the criterion without kinks, and a wall in front of every bound.

#include "redundancy/search/jet.hpp"
#include "redundancy/search/scene.hpp"

namespace ninedof {

/// Lengths may break their limits by this much, in units of the robot's size.
constexpr double limit_tolerance = 1e-10;

/// The criterion as it is minimised (the logarithm of the condition number, minus the logarithm of the least |det|, the sum of
/// squares) and the bounds, of one pose in one chamber.
class Merit {
 public:
  Merit(const Scene& scene, const InternalPointProblem& problem) : scene_(scene), problem_(problem) {}

  const Scene& scene() const { return scene_; }
  const InternalPointProblem& problem() const { return problem_; }

  /// Fixes the chamber: the signs of the three volumes.
  void enter(const Vec3& x) { sides_ = scene_.volumes(x).cwiseSign(); }
  void enter_sides(const Vec3& sides) { sides_ = sides; }
  const Vec3& sides() const { return sides_; }
  /// Whether the three determinants have the signs of the chamber and are greater than the clearance.
  bool in_chamber(const Vec3& x) const;

  /// By how much x breaks the limit it breaks most, in units of the robot's size; negative inside.
  double violation(const Vec3& x) const;

  /// The criterion itself, infinite where singular.
  double exact(const Vec3& x) const;

  /// Criterion and walls, softened by epsilon: within O(epsilon) of the exact minimum at their own. False where x is outside,
  /// `out` then undefined.
  bool soft(const Vec3& x, double epsilon, Jet& out) const;

  /// A soft largest violation of the limits, and the walls of the chamber: what leads to an allowed point.
  bool soft_violation(const Vec3& x, double epsilon, Jet& out) const;

  /// The bounds that x touches: within `contact` of a limit, in sizes of the robot, or of the logarithm of the clearance.
  ActiveBounds touched(const Vec3& x, double contact) const;

  /// The limits that x breaks most, all of those within `contact` of the worst.
  ActiveBounds broken(const Vec3& x, double contact) const;

 private:
  bool add_clearance(const std::array<Jet, 3>& logs, double epsilon, Jet& out) const;

  const Scene& scene_;
  const InternalPointProblem& problem_;
  Vec3 sides_ = Vec3::Ones();
};

}  // namespace ninedof
