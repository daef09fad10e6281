#pragma once
/// Singular value decompositions of small matrices by two-sided Jacobi rotations, compiled once for all sizes.
///
/// The rotations of JacobiSVD of Eigen 3.4 in the same order, with the same bits; its templates took half a minute of
/// compile time, most of it in code for large matrices.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// a = U diag(sigma) V^T, sigma descending. All NaN if `a` has an entry that is not finite.
template <int N>
struct Svd {
  Eigen::Matrix<double, N, 1> sigma;
  Eigen::Matrix<double, N, N> u, v;

  /// How many singular values are at least `threshold` times the largest.
  Eigen::Index rank(double threshold) const;
};
Svd<3> jacobi_svd(const Mat3& a);
Svd<6> jacobi_svd(const Mat6& a);
Svd<9> jacobi_svd(const Mat9& a);

/// Singular values, descending, and the right singular vectors in the same order, one a column.
template <int N>
struct RightSvd {
  Eigen::Matrix<double, N, 1> sigma;
  Eigen::Matrix<double, N, N> v;
};
RightSvd<6> jacobi_right_svd(const Mat6& a);
RightSvd<9> jacobi_right_svd(const Eigen::Matrix<double, 27, 9>& a);
RightSvd<3> jacobi_right_svd(const Mat93& a);

/// The orthogonal matrix nearest to a square one.
Eigen::MatrixXd nearest_orthogonal(const Eigen::MatrixXd& square);

}  // namespace ninedof
