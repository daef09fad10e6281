#pragma once
/// What binds at a point, and whether the point is stationary: the nonsmooth first-order test, made without the solver.

#include "prepared.hpp"

namespace ninedof {

/// Singular values that tie for largest or smallest, margins at zero, coordinates on a bound.
struct ActiveSet {
  std::vector<int> maxima, minima;   ///< rows of DesignPoint
  std::vector<int> margins;          ///< indices into Prepared::margins
  std::vector<int> at_low, at_high;  ///< free coordinates
  bool order = false;                ///< zs has run up to zp
};

ActiveSet active_set(const Prepared& p, const Look& l, const Eigen::VectorXd& y);

/// Names of the variables and constraints in an active set, each once.
std::vector<std::string> names(const Prepared& p, const ActiveSet& a);

/// The least Euclidean norm of  sum w1 grad(maxima) - sum w2 grad(minima) - sum w3 grad(constraints)  over weights w >= 0
/// with sum w1 = sum w2 = 1, in solver coordinates. Zero exactly where no direction lowers log kappa to first order and
/// keeps the constraints. Weights come in the order maxima, minima, margins, at_low, at_high, order.
struct Stationarity {
  double residual = 0.0;
  Eigen::VectorXd weights;
};
Stationarity stationarity(const Prepared& p, const Look& l, const ActiveSet& a);

/// Names of what is in conflict at a point of least violation: the constraints violated most and the bounds that, weighted,
/// balance their gradients. Bounds that merely touch have no weight and are not named.
std::vector<std::string> conflict(const Prepared& p, const Look& l, const Eigen::VectorXd& y);

/// min |A w - b| over w >= 0 (Lawson and Hanson's active-set method).
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace ninedof
