#pragma once
/// The direct position problem once O is known in both frames: a rotation, and two methods that find it.

#include <array>

#include "ninedof/position/trilateration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// |c_i| above 1 by no more is rounding: O on the line of the leg.
inline constexpr double cosine_slack = 1e-9;

/// Error of O, as a fraction of the largest length, from which on the lengths do not place it: it may be anywhere.
inline constexpr double unknown_point = 1e-6;

/// Throws InvalidArgument unless all are finite, none is negative and at least one is positive.
void require_leg_lengths(const Vec9& lengths);

/// Rotations Q with d_i . Q w_i = c_i for three pairs of unit vectors: d in base axes, w in platform axes.
struct RotationProblem {
  Triple d, w;
  Vec3 c;
};

/// O in the base frame and in the platform frame.
struct InternalPoints {
  Vec3 s, o;
};

/// The rotation problem for O at s and o, and the lengths of its unscaled vectors.
struct ScaledRotationProblem {
  RotationProblem unit;
  Vec3 base_distance, platform_distance;  ///< |d_i|, |w_i|
};

/// d_i = r_i - s, w_i = u_i - o, c_i = (|d_i|^2 + |w_i|^2 - l_i^2) / (2 |d_i| |w_i|). Outside [-1, 1] if leg i
/// is too long or too short, not finite if O is on an external joint.
ScaledRotationProblem rotation_problem(const Geometry& g, const InternalPoints& at, const Vec3& external_lengths);

/// Approximations of the real solutions, at most eight; polish_rotation refines them.
struct RotationCandidates {
  std::array<Mat3, 8> rotation;
  int count = 0;
  bool self_motion = false;  ///< the solutions seem to form a family, possibly complex, and none is listed
  bool reliable = true;      ///< false if a solution may be missing
  double sensitivity = 1.0;  ///< of the null-space method: factor from an error of the equations to one of its basis
};

/// The fast method. The equation of leg `pivot` is satisfied identically. Unreliable where two solutions share or
/// nearly share an angle or directions are nearly parallel: there the null-space method is used. `error` is the
/// absolute error of the equations if it exceeds rounding.
RotationCandidates eliminated_rotations(const RotationProblem& problem, int pivot, double error = 0.0);

/// By linear algebra, without start values or a chart of the rotations. Candidates have an error of 1e-10 in general
/// position, about 1e-8 at a double root and 1e-4 where eight roots merge. Expects |c_i| <= 1 up to rounding: otherwise
/// no rotation is real. Does not allocate.
RotationCandidates null_space_rotations(const RotationProblem& problem);

}  // namespace ninedof
