#pragma once
/// The part of the internal legs that no motion of O can take away.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Nq of an orthonormal basis [Nq Nr] of the left null space of the 6x3 matrix [C; B]: the last three columns of its full
/// Householder Q, upper half, transposed. Exact where C or B is singular.
Mat3 null_space_part(const Mat3& c, const Mat3& b);

}  // namespace ninedof
