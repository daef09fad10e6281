#pragma once
/// Whether O can move from one point to another without a singularity, by straight lines.

#include <vector>

#include "redundancy/search/scaled_pose.hpp"

namespace ninedof {

/// The chamber of a point as far as it is known: every point of it is reached from the first on straight lines.
class Reach {
 public:
  Reach(const ScaledPose& pose, const Vec3& from) : pose_(pose), known_{from} {}

  /// Adds a point that is known to be in the chamber.
  void add(const Vec3& x) { known_.push_back(x); }

  /// Adds a point that is known to be in the chamber, from which only what the known points do not see is looked for.
  void add_far(const Vec3& x) { far_.push_back(x); }

  /// Whether a straight line from some known or far point reaches x, or a way of several lines over a grid, searched
  /// from both ends. A passage narrower than the grid may be missed.
  bool reaches(const Vec3& x);

 private:
  bool finds(const Vec3& x) const;

  const ScaledPose& pose_;
  std::vector<Vec3> known_, far_, beyond_;  // points of the chamber, and points that no way led to
};

}  // namespace ninedof
