#pragma once
/// Local minima of one pose in one chamber, and descents to them from a start near one.

#include <span>
#include <vector>

#include "redundancy/search/descent.hpp"

namespace ninedof {

/// Values of the criterion closer than this are equal but for rounding.
constexpr double least_gain = 1e-9;

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
  /// If empty: the least of the largest violations met, in sizes of the robot; infinite where no point of the chamber
  /// was found that keeps the clearance.
  double violation = 0.0;
  Vec3 nearest = Vec3::Zero();  ///< where that is; the start, if infinite
  bool examined = true;  ///< whether the scan divided every cell that may be lower than the best

  /// The least value; infinite if empty.
  double best() const;
  /// Adds a minimum, or lowers the known one at its place.
  void add(const LocalMinimum& minimum);
};

/// Moves x within its chamber to where it breaks the limits least and records that place; true if it keeps them there.
bool enter_limits(const PoseObjective& objective, Vec3& x, Minima& minima);

/// The smoothings of a descent to a minimum, decreasing.
std::span<const double> final_epsilons();

/// The minimum reached from `start`, a point of the chamber near it, such as the best point of a neighbouring pose: at
/// most one, none where no point near the start keeps the limits.
Minima warm_minimum(const PoseObjective& objective, const Vec3& start);

/// The minimum that a descent from an allowed point leads to; never worse than that point.
LocalMinimum minimum_from(const PoseObjective& objective, const Vec3& start);

}  // namespace ninedof
