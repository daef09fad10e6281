#pragma once
/// Least squares with nonnegative unknowns.

#include <Eigen/Core>

namespace ninedof {

/// min |A w - b| over w >= 0 (Lawson and Hanson's active-set method).
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace ninedof
