#pragma once
/// Whether a rotation can satisfy two of the three equations of the rotation problem.

#include "position/rotation_problem.hpp"

namespace ninedof {

/// Whether some Q has d_i . Q w_i = c_i for both i of a pair. With the third leg void this decides between self-motion and none.
bool two_legs_fit(const RotationProblem& problem, std::size_t i, std::size_t j);

}  // namespace ninedof
