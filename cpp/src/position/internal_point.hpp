#pragma once
/// The position of O in both frames, and the rotation problem it leaves.

#include "ninedof/position/trilateration.hpp"
#include "ninedof/robot/geometry.hpp"
#include "position/rotation_problem.hpp"

namespace ninedof {

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

}  // namespace ninedof
