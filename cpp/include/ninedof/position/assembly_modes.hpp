#pragma once
/// The result of direct position analysis.

#include <array>

#include "ninedof/robot/configuration.hpp"

namespace ninedof {

/// The solutions for the nine lengths.
enum class PositionStatus {
  found,        ///< finitely many modes, all simple: each changes smoothly with the lengths
  tangent,  ///< finitely many modes, two of which meet, within rounding, in a singular configuration: half the digits
  infeasible,  ///< no configuration has these lengths, or, if not `certain`, none was found
  self_motion,  ///< the robot can move with these lengths locked, within rounding: infinitely many modes, none listed
};

/// "found", "tangent", "infeasible", "self_motion".
const char* to_string(PositionStatus status);

/// Which legs make the lengths infeasible.
enum class PositionObstacle {
  none,
  lower_legs,  ///< the spheres of r1 r2 r3 have no common point
  upper_legs,  ///< the spheres of q1 q2 q3 have no common point
  external_leg_1,  ///< in every branch this leg is too long or too short for the position of O
  external_leg_2,
  external_leg_3,
  external_legs,  ///< each of the three fits in some branch, but no rotation fits all
};

/// "none", "lower_legs" and so on, as above.
const char* to_string(PositionObstacle obstacle);

struct AssemblyMode {
  Configuration configuration;
  /// Side of O relative to the plane of the base's internal joints: +1 along (c2 - c1) x (c3 - c1), -1 against it, 0 in
  /// it.
  int base_side;
  int platform_side;  ///< the same for the platform's internal joints, in the platform frame
  /// Smallest singular value of the matrix with rows (Q w_i) x d_i, d_i and w_i the unit vectors from O to the external
  /// joints: 0 where two modes meet, at most sqrt 3. Another mode with O on the same sides is at least about this angle
  /// away, in radians.
  double separation;
};

struct AssemblyModes {
  PositionStatus status = PositionStatus::infeasible;
  PositionObstacle obstacle = PositionObstacle::none;
  /// Whether the number of modes, zero included, is confirmed for lengths correct to rounding: every root of the
  /// eliminant was isolated and became a separate simple mode, or the null-space method found only simple ones. False
  /// near double solutions, and where the scales of robot and lengths are too different to decide.
  bool certain = true;
  int null_space_branches = 0;  ///< branches solved by the null-space method
  int count = 0;
  std::array<AssemblyMode, 32> mode;  ///< the first `count`

  const AssemblyMode* begin() const { return mode.data(); }
  const AssemblyMode* end() const { return mode.data() + count; }
};

/// The method that solves for the rotation.
enum class RotationMethod {
  automatic,  ///< elimination, and the null-space method where the number of modes is not confirmed
  elimination,  ///< elimination alone, for comparison; `certain` is false where it is unreliable
  null_space,  ///< the null-space method alone, for comparison
};

}  // namespace ninedof
