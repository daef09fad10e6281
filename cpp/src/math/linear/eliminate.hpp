#pragma once
/// Unknowns that settle where they like, taken out of a least-squares sum without squaring it.

#include <Eigen/QR>

#include "math/linear/negligible.hpp"

namespace ninedof {

/// X with |X y| = min over z of |kept y + free z| for every y: the part of `kept` that the columns of `free` cannot
/// reach, in an orthonormal basis. X^T X is the Schur complement of the normal equations, and stays right where `free`
/// has lost rank.
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
