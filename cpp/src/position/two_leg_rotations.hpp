#pragma once
/// Whether a rotation can satisfy two of the three equations of the rotation problem.

#include "position/rotation_problem.hpp"

namespace ninedof {

/// Whether some Q satisfies the equations of legs i and j. If the third leg has no direction, this decides between
/// self-motion and no mode.
bool two_legs_fit(const RotationProblem& problem, std::size_t i, std::size_t j);

}  // namespace ninedof
