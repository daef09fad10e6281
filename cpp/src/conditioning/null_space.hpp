#pragma once
/// The left null space of the internal legs: combinations of their rates that no motion of O changes.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// N_q of an orthonormal basis [N_q N_r] of the left null space of the 6x3 matrix [C; B]: the upper half of the last
/// three columns of its full Householder Q, transposed. Valid also where C or B is singular.
Mat3 null_space_part(const Mat3& c, const Mat3& b);

/// M = [A; N_q E] from the rows of A and then of E, and from C and B.
inline Mat6 conditioning_rows(const Mat6& a_e, const Mat3& c, const Mat3& b) {
  Mat6 m;
  m.topRows<3>() = a_e.topRows<3>();
  m.bottomRows<3>().noalias() = null_space_part(c, b).lazyProduct(a_e.bottomRows<3>());
  return m;
}

}  // namespace ninedof
