#pragma once
/// The left null space of the internal legs: combinations of their rates that no motion of O changes.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// N_q of an orthonormal basis [N_q N_r] of the left null space of the 6x3 matrix [C; B]: the upper half of the last
/// three columns of its full Householder Q, transposed. Valid also where C or B is singular.
Mat3 null_space_part(const Mat3& c, const Mat3& b);

}  // namespace ninedof
