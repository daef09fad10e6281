#pragma once
/// Eigenvectors by Eigen, compiled once, in eigenvectors.cpp: they cost seconds of compile time.

#include <complex>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// Eigenvalues of an 8x8 matrix. A real eigenvalue has one column of `vectors`; a conjugate pair has two, the real and
/// the imaginary part of an eigenvector.
struct RealEigen8 {
  bool converged = false;
  Eigen::Matrix<std::complex<double>, 8, 1> values;
  Eigen::Matrix<double, 8, 8> vectors;
};
RealEigen8 real_eigen(const Eigen::Matrix<double, 8, 8>& a);

/// Of a symmetric matrix of at most eight columns: eigenvalues, the least first, and a unit vector of each in a column.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& symmetric);

}  // namespace ninedof
