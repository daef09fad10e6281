#pragma once
/// The left null space of the internal legs: combinations of their rates that no motion of O changes.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// An orthonormal basis [N_q N_r] of the left null space of the 6x3 matrix [C; B]: the last three columns of its full
/// Householder Q, transposed. Valid also where C or B is singular.
Mat36 null_space(const Mat3& c, const Mat3& b);

/// The first three columns: a basis of the rates that motions of O cause, where these are three.
Mat36 range_space(const Mat3& c, const Mat3& b);

/// M = [A; N_q E] from the rows of A and then of E, and from C and B.
inline Mat6 conditioning_rows(const Mat6& a_e, const Mat3& c, const Mat3& b) {
  Mat6 m;
  m.topRows<3>() = a_e.topRows<3>();
  const Mat3 n_q = null_space(c, b).leftCols<3>();
  m.bottomRows<3>().noalias() = n_q.lazyProduct(a_e.bottomRows<3>());
  return m;
}

}  // namespace ninedof
