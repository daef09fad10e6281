#pragma once
/// Newton's method on ever less smoothed functions: from one start to one local minimum, or over all poses of a path.

#include <functional>
#include <span>
#include <stop_token>

#include "redundancy/search/pose_objective.hpp"

namespace ninedof {

/// O farther away than this, in sizes of the robot, counts as lost.
constexpr double far_away = 100.0;

/// A function of O smoothed by epsilon; false where it is not defined.
using Smoothed = std::function<bool(const Vec3& x, double epsilon, Jet& out)>;

/// How a descent may end.
enum class Ending {
  minimum,   ///< the last decrement is small in epsilons, and no direction curves down
  stuck,     ///< one of the two conditions fails
  away,      ///< O is farther than far_away
  in_joint,  ///< O has reached a joint, where a direction and with it a determinant is undefined
};

struct Descent {
  Vec3 x;                          ///< the minimum at the last epsilon
  Vec3 limit;                      ///< the minimum extrapolated to epsilon = 0
  Jet at;                          ///< the function at x
  double decrement = 0.0;          ///< twice the decrease that a Newton step from x predicts
  Ending ending = Ending::stuck;
  int leg = -1;                    ///< the internal leg of that joint; -1 for a joint of an external leg
};

/// The Newton step with the absolute values of the Hessian's eigenvalues: always a descent direction.
Vec3 newton_step(const Jet& f);

/// Minimises for one epsilon from d.x, with d.at there, until the decrement is below `enough` epsilons; false if lost.
bool settle(const ScaledPose& pose, const Smoothed& f, double epsilon, double enough, Descent& d);

/// Minimises from `start`, where the function must be defined, for each epsilon in turn. The minimum is nearly linear
/// in epsilon, so that each next start is extrapolated.
Descent descend(const ScaledPose& pose, const Smoothed& f, const Vec3& start, std::span<const double> epsilons);

/// One pose of a path: its objective, and O in the coordinates of its ScaledPose.
struct PathPoint {
  const PoseObjective* objective;
  Vec3 x;
};

/// Minimises sum f_k(x_k) + coupling sum |s_(k+1) - s_k|^2, s in lengths, over all points at once, from points inside
/// their chambers and limits. The Hessian is block tridiagonal, so that a step takes time proportional to the number of
/// poses. False without convergence. Throws Stopped on a stop.
bool minimize_path(std::span<PathPoint> points, double coupling, const std::stop_token& stop);

}  // namespace ninedof
