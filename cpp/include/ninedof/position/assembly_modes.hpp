#pragma once
/// What direct position analysis answers with.

#include <array>

#include "ninedof/robot/configuration.hpp"

namespace ninedof {

/// What the nine lengths allow.
enum class PositionStatus {
  found,        ///< finitely many modes, all of them simple: every mode goes on smoothly as the lengths change
  tangent,  ///< finitely many, and two of them meet here: the configuration is singular, its coordinates good to half the digits
  infeasible,  ///< no configuration has these lengths
  self_motion,  ///< the robot moves with these lengths held: no list exists and none is given
};

/// "found", "tangent", "infeasible", "self_motion".
const char* to_string(PositionStatus status);

/// Which legs leave no configuration.
enum class PositionObstacle {
  none,
  lower_legs,  ///< the spheres of r1 r2 r3 have no common point
  upper_legs,  ///< the spheres of q1 q2 q3 have no common point
  external_leg_1,  ///< in every branch this leg is too long or too short for O where it is
  external_leg_2,
  external_leg_3,
  external_legs,  ///< each of the three fits in some way, no rotation fits all
};

/// "none", "lower_legs", ... as above.
const char* to_string(PositionObstacle obstacle);

struct AssemblyMode {
  Configuration configuration;
  /// Side of the plane of the base's internal joints on which O lies: +1 along (c2 - c1) x (c3 - c1), -1 against it, 0 in it.
  int base_side;
  int platform_side;  ///< the same for the platform's internal joints, seen in the platform frame
  /// Smallest singular value of the rows (Q w_i) x d_i, d_i and w_i the unit vectors from O to the external joints: 0 where two modes
  /// meet, at most sqrt 3. Another mode with O on the same sides is at least about this far off, in radians.
  double separation;
};

struct AssemblyModes {
  PositionStatus status = PositionStatus::infeasible;
  PositionObstacle obstacle = PositionObstacle::none;
  /// Whether the number of modes is confirmed: every root of the eliminant was isolated and became a mode of its own, or the null-space
  /// method found its solutions well apart. False near double solutions.
  bool certain = true;
  int null_space_branches = 0;  ///< branches the fast elimination handed over
  int count = 0;
  std::array<AssemblyMode, 32> mode;  ///< the first `count`

  const AssemblyMode* begin() const { return mode.data(); }
  const AssemblyMode* end() const { return mode.data() + count; }
};

/// Which method solves for the rotation.
enum class RotationMethod {
  automatic,  ///< elimination, and the null-space method where its count does not come out
  elimination,  ///< alone: for comparison; `certain` is false where it should not be trusted
  null_space,  ///< alone: for comparison
};

}  // namespace ninedof
