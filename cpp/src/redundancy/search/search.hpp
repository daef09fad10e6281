#pragma once
/// Local minima of one pose in one chamber, from many starts.

#include <vector>

#include "redundancy/search/descent.hpp"
#include "redundancy/search/merit.hpp"

namespace ninedof {

/// A local minimum, or where one was lost.
struct Local {
  Vec3 x;
  double value;   ///< of the criterion itself
  Ending ending;
  int leg = -1;   ///< the internal leg that has shrunk
};

/// The end of a descent without what the last epsilon has left of softness.
Local local_end(const Merit& merit, const Descent& d);

/// What a search found.
struct Minima {
  std::vector<Local> found;       ///< distinct, best first; empty where no point keeps the limits
  double violation = 0.0;         ///< then: the least largest violation, in sizes of the robot,
  Vec3 nearest = Vec3::Zero();    ///< and where
};

/// Moves x, in the chamber but outside the limits, to where they are broken least, and notes that place; whether it is inside.
bool enter_limits(const Merit& merit, Vec3& x, Minima& minima);

/// The epsilons of a descent to a minimum, descending.
std::span<const double> sharpening();

/// Searches the chamber of `start`, which the merit has entered.
Minima local_minima(const Merit& merit, const Vec3& start);

}  // namespace ninedof
