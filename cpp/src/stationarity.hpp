#pragma once
/// Is a point stationary? The nonsmooth first-order test, computed without the solver.

#include <Eigen/Core>

namespace ninedof {

/// Gradients at a point, one column each, in solver coordinates.
struct ActiveGradients {
  Eigen::MatrixXd maxima;       ///< of the largest log singular values (those that tie)
  Eigen::MatrixXd minima;       ///< of the smallest
  Eigen::MatrixXd constraints;  ///< of margins and bounds that bind, pointing into the allowed side
};

/// Least Euclidean norm of  maxima w1 - minima w2 - constraints w3  over weights w >= 0 with sum w1 = sum w2 = 1: zero
/// exactly where no direction lowers log kappa to first order and keeps the constraints.
double stationarity_residual(const ActiveGradients& g);

/// min |A w - b| over w >= 0 (Lawson and Hanson's active-set method).
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace ninedof
