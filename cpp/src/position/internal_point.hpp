#pragma once
/// Where O may be for given lengths of the internal legs, seen from both plates.

#include "ninedof/position/trilateration.hpp"
#include "ninedof/robot/geometry.hpp"
#include "position/rotation_problem.hpp"

namespace ninedof {

/// O seen from the base and from the platform (platform frame).
struct InternalPoints {
  Vec3 s, o;
};

/// The rotation problem of O at s and o, with what scales it back.
struct ScaledRotationProblem {
  RotationProblem unit;
  Vec3 base_distance, platform_distance;  ///< |d_i|, |w_i|
};

/// d_i = r_i - s, w_i = u_i - o, c_i = (|d_i|^2 + |w_i|^2 - l_i^2) / (2 |d_i| |w_i|). Beyond [-1, 1] where leg i
/// is too long or too short, not finite where O is on an external joint.
ScaledRotationProblem rotation_problem(const Geometry& g, const InternalPoints& at, const Vec3& external_lengths);

}  // namespace ninedof
