#pragma once
/// Where a study looks besides the neutral configuration: displacements that mean the same for every design.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// A displacement from the neutral configuration (eq. 6) of whatever design is looked at.
struct Pose {
  Vec3 position = Vec3::Zero();  ///< shift of p
  Vec3 rotation = Vec3::Zero();  ///< rotation vector, base axes, radians, after the neutral rotation
  Vec3 internal = Vec3::Zero();  ///< shift of s
  bool best_internal = false;    ///< s is placed by the optimizer, starting from that shift
  bool in_zp = false;            ///< shifts are fractions of zp, else lengths
};

}  // namespace ninedof
