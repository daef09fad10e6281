#pragma once
/// The duty of a machine: what its legs push, and how fast its platform moves.

#include <vector>

#include "ninedof/dynamics/inverse_dynamics.hpp"
#include "ninedof/kinematics/leg_motion.hpp"

namespace ninedof {

/// What limits of forces, rates and powers are about.
struct Duty {
  std::vector<Load> loads = {Load{}};  ///< the weights of all masses are added to each
  Masses masses = {};
  Vec3 gravity = Vec3::Zero();  ///< force per mass, base axes
  PlatformMotion motion = {};   ///< in any direction
};

}  // namespace ninedof
