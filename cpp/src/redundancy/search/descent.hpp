#pragma once
/// Newton's method along a path of ever sharper functions, from one start to one local minimum.

#include <functional>
#include <span>

#include "redundancy/search/jet.hpp"
#include "redundancy/search/scene.hpp"

namespace ninedof {

/// O farther away than this, in sizes of the robot, has left it.
constexpr double far_away = 100.0;

/// A function of O softened by epsilon; false where it is not defined.
using Soft = std::function<bool(const Vec3& x, double epsilon, Jet& out)>;

/// How a descent may end.
enum class Ending {
  minimum,   ///< the last decrement is small in epsilons, and no direction curves down
  stuck,     ///< one of the two is not so
  away,      ///< O has left the surroundings of the robot
  in_joint,  ///< a leg has shrunk to nothing: without a direction the function has no value there
};

struct Descent {
  Vec3 x;                          ///< the minimum at the last epsilon
  Vec3 limit;                      ///< where it goes as epsilon goes to zero
  Jet at;                          ///< the function at x
  double decrement = 0.0;          ///< what a Newton step from x would still take off, twice over
  Ending ending = Ending::stuck;
  int leg = -1;                    ///< the internal leg that has shrunk
};

/// The step to the least value of the second-order model, curvatures taken by their size, whatever their sign.
Vec3 newton_step(const Jet& f);

/// As a descent ends for one epsilon: minimises from d.x, where the function is d.at, down to a decrement of `enough` epsilons; false
/// if O has left.
bool settle(const Scene& scene, const Soft& f, double epsilon, double enough, Descent& d);

/// Minimises from `start`, where the function must be defined, for each epsilon in turn. From one to the next the minimum moves
/// almost along a line, which is followed ahead.
Descent descend(const Scene& scene, const Soft& f, const Vec3& start, std::span<const double> epsilons);

}  // namespace ninedof
