#pragma once
/// Least-squares problems of the sizes used here. Eigen's factorizations are compiled once, in least_squares.cpp.

#include <optional>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// X with |X y| = min over z of |kept y + free z| for every y: the part of `kept` that the columns of `free` cannot
/// reach, in an orthonormal basis. X^T X is the Schur complement of the normal equations, and stays right where `free`
/// has lost rank.
Mat96 eliminate(const Mat93& free, const Mat96& kept);
Mat93 eliminate(const Mat93& free, const Mat93& kept);

/// The triangular factor R of X = Q R.
Mat6 triangular_factor(const Mat96& x);

/// The solution of a x = b; nothing if a pivot is at most `least_pivot` times the largest.
std::optional<Vec9> solve_regular(const Mat9& a, const Vec9& b, double least_pivot);

/// The solution of a x = b for a symmetric `a` that is positive definite, a column for each of b.
Eigen::MatrixXd solve_definite(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// A least-squares solution of a x = b; entries that the rank leaves open are zero.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The least-squares solution of a x = b of least norm.
Eigen::VectorXd least_norm(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Vec3 least_norm(const Eigen::Matrix<double, 6, 3>& a, const Vec6& b);

/// The least-squares solution of a^T x = b of least norm.
Eigen::VectorXd least_norm_transposed(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// min |a w - b| over w >= 0 (Lawson and Hanson's active-set method).
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace ninedof
