#pragma once
/// Where O is along a trajectory.

#include <vector>

#include "ninedof/motion/trajectory.hpp"

namespace ninedof {

/// The rule for O along a trajectory.
struct TrajectoryRule {
  enum class Kind {
    carried,  ///< as a point of the platform: Q^T (s - p) stays as at home
    shifted,  ///< with the platform's origin: s - p stays as at home, in base axes
    held,     ///< where it is at home
    between,  ///< on the way from the centroid of the lower to that of the upper internal joints
    best,     ///< best_internal_path, at up to `most_searched` poses, with a cubic spline between them
  };
  Kind kind = Kind::carried;
  double fraction = 0.5;  ///< of the way, for `between`

  static constexpr std::size_t most_searched = 201;
};

/// O at each pose. `problem`: what `best` looks for, from O carried at the first pose; a closed trajectory has a closed
/// path of O.
///
/// Throws InvalidArgument for a fraction that is not finite, and with `best` as best_internal_path does and at a pose
/// that allows no O; Stopped on a stop.
std::vector<Vec3> internal_points(const Geometry& g, const Trajectory& trajectory, const Configuration& home,
                                  const TrajectoryRule& rule, const InternalPointProblem& problem = {},
                                  const Control& control = {});

}  // namespace ninedof
