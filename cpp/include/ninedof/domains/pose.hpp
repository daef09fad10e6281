#pragma once
/// Poses of an objective, as displacements from the neutral configuration of each design.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// A displacement from the neutral configuration (eq. 6) of a design.
struct Pose {
  Vec3 position = Vec3::Zero();  ///< shift of p
  Vec3 rotation = Vec3::Zero();  ///< rotation vector, base axes, radians, after the neutral rotation
  Vec3 internal = Vec3::Zero();  ///< shift of s
  bool best_internal = false;    ///< the optimizer chooses s, starting from that shift
  bool in_zp = false;            ///< shifts are fractions of zp, else lengths
  double weight = 1.0;           ///< in a mean over poses; 0: of these the limits alone hold, and the worst counts
};

}  // namespace ninedof
