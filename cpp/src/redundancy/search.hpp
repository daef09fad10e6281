#pragma once
/// Local minima of one pose in one chamber, from many starts.

#include <vector>

#include "redundancy/descent.hpp"
#include "redundancy/merit.hpp"

namespace ninedof {

/// A local minimum, or where one was lost.
struct Local {
  Vec3 x;
  double value;   ///< of the criterion itself
  Ending ending;
  int leg = -1;   ///< the internal leg that has shrunk
};

/// What a search found.
struct Minima {
  std::vector<Local> found;       ///< distinct, best first; empty where no point keeps the limits
  double violation = 0.0;         ///< then: the least largest violation, in sizes of the robot,
  Vec3 nearest = Vec3::Zero();    ///< and where
};

/// The epsilons of a descent to a minimum, descending.
std::span<const double> sharpening();

/// Searches the chamber of `start`, which the merit has entered.
Minima local_minima(const Merit& merit, const Vec3& start);

}  // namespace ninedof
