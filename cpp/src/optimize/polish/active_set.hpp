#pragma once
/// What binds at a point, and whether the point is stationary: the nonsmooth first-order test, made without the solver.

#include <map>

#include "optimize/minimax/look.hpp"

namespace ninedof {

/// Objective rows that rule their level, margins at zero, coordinates on a bound.
struct ActiveSet {
  std::vector<int> uses;             ///< indices into Prepared::uses
  std::vector<int> margins;          ///< indices into Prepared::margins
  std::vector<int> at_low, at_high;  ///< free coordinates
  bool order = false;                ///< zs has run up to zp
};

/// Which coordinates count as on a bound: those exactly there, which an answer must be, or those near it, which Newton's method
/// puts there. A length of 1e-9 is not on its bound at 0: designs that shrink for ever would pass for optima.
enum class Contact { exact, near };

ActiveSet active_set(const Prepared& p, const Look& l, const Eigen::VectorXd& y, Contact contact = Contact::exact);

/// Names of the variables and constraints in an active set, each once.
std::vector<std::string> names(const Prepared& p, const ActiveSet& a);

/// The least Euclidean norm of  sum w1 grad(objective rows) - sum w2 grad(constraints)  over weights w >= 0, those of each
/// level summing to the objective's slope in that level, in solver coordinates. Zero exactly where no direction lowers the
/// objective to first order and keeps the constraints.
///
/// Where singular values of a displaced pose coincide, the derivatives of single ones depend on the choice of their vectors:
/// there every direction of the cluster counts as a row, and the ones that matter are found one by one.
struct Stationarity {
  double residual = 0.0;
  std::map<std::string, double> prices;  ///< see Candidate::prices
};
Stationarity stationarity(const Prepared& p, const Look& l, const ActiveSet& a);

/// Names of what is in conflict at a point of least violation: the constraints violated most and the bounds that, weighted,
/// balance their gradients. Bounds that merely touch have no weight and are not named.
std::vector<std::string> conflict(const Prepared& p, const Look& l, const Eigen::VectorXd& y);

/// min |A w - b| over w >= 0 (Lawson and Hanson's active-set method).
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace ninedof
