#pragma once
/// Eliminates free unknowns from a least-squares problem without forming normal equations.

#include <Eigen/QR>

#include "math/linear/negligible.hpp"

namespace ninedof {

/// X with |X y| = min over z of |kept y + free z| for every y: the part of `kept` orthogonal to the columns of `free`,
/// in an orthonormal basis. X^T X is the Schur complement of the normal equations. Correct also if `free` is
/// rank-deficient.
template <int Rows, int Kept>
Eigen::Matrix<double, Rows, Kept> eliminate(const Eigen::Matrix<double, Rows, 3>& free,
                                            const Eigen::Matrix<double, Rows, Kept>& kept) {
  Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Rows, 3>> qr(free);
  qr.setThreshold(negligible);
  Eigen::Matrix<double, Rows, Kept> x = qr.householderQ().adjoint() * kept;
  x.topRows(qr.rank()).setZero();
  return x;
}

}  // namespace ninedof
