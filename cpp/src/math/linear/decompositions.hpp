#pragma once
/// Eigen's decompositions of the sizes used in few places, compiled once, in decompositions.cpp: each costs seconds of
/// compile time.

#include <complex>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Singular values, descending, and the right singular vectors in the same order, one a column.
template <int N>
struct TallSvd {
  Eigen::Matrix<double, N, 1> sigma;
  Eigen::Matrix<double, N, N> v;
};
TallSvd<9> right_svd(const Eigen::Matrix<double, 27, 9>& a);
TallSvd<3> right_svd(const Mat93& a);

/// Eigenvalues of an 8x8 matrix. A real eigenvalue has one column of `vectors`; a conjugate pair has two, the real and
/// the imaginary part of an eigenvector.
struct RealEigen8 {
  bool converged = false;
  Eigen::Matrix<std::complex<double>, 8, 1> values;
  Eigen::Matrix<double, 8, 8> vectors;
};
RealEigen8 real_eigen(const Eigen::Matrix<double, 8, 8>& a);

/// The unit eigenvector of the least eigenvalue of a symmetric matrix.
Eigen::VectorXd least_eigenvector(const Eigen::MatrixXd& symmetric);

/// The orthogonal matrix nearest to a square one.
Eigen::MatrixXd nearest_orthogonal(const Eigen::MatrixXd& square);

}  // namespace ninedof
