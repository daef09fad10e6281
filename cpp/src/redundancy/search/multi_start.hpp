#pragma once
/// Local minima of one pose in one chamber: from many starts, or from one start near a minimum.

#include <vector>

#include "redundancy/search/descent.hpp"

namespace ninedof {

/// The end of a descent: a local minimum, or the place where the descent left the chamber's bounded part.
struct LocalMinimum {
  Vec3 x;
  double value;  ///< of the criterion without smoothing
  Ending ending;
  int leg = -1;  ///< as in Descent, for Ending::in_joint
};

/// The end of a descent, extrapolated to zero smoothing where that is better.
LocalMinimum end_of(const PoseObjective& objective, const Descent& d);

/// What a search found.
struct Minima {
  std::vector<LocalMinimum> found;  ///< distinct, best first; empty where no point keeps the limits
  double violation = 0.0;  ///< if empty: the least of the largest violations met, in sizes of the robot,
  Vec3 nearest = Vec3::Zero();  ///< and where
};

/// Moves x within its chamber to where it breaks the limits least and records that place; true if it keeps them there.
bool enter_limits(const PoseObjective& objective, Vec3& x, Minima& minima);

/// The smoothings of a descent to a minimum, decreasing.
std::span<const double> final_epsilons();

/// Searches the chamber of the objective from `start`, a point of it.
Minima local_minima(const PoseObjective& objective, const Vec3& start);

/// The minimum reached from `start`, a point of the chamber near it, such as the best point of a neighbouring pose: at
/// most one, none where no point near the start keeps the limits.
Minima warm_minimum(const PoseObjective& objective, const Vec3& start);

}  // namespace ninedof
