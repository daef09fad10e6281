#pragma once
/// Leg forces from the matrix of leg rates alone. Defined in statics/statics.cpp.

#include "ninedof/statics/statics.hpp"

namespace ninedof {

/// leg_forces for H with rotations and moments scaled by a length (kinematics/rate_matrix.hpp).
LegForces leg_forces(const Mat9& h, double length, const Load& load);

}  // namespace ninedof
