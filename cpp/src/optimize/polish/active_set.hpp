#pragma once
/// What is active at a point, whether it is stationary (tested without the solver), and Newton's method from there.

#include <map>

#include "optimize/minimax/design_evaluation.hpp"

namespace ninedof {

/// Objective rows equal to their level, margins at zero, coordinates on a bound.
struct ActiveSet {
  std::vector<int> row_levels;             ///< indices into PreparedProblem::row_levels
  std::vector<int> margins;          ///< indices into PreparedProblem::margins
  std::vector<int> at_low, at_high;  ///< free coordinates
  bool order = false;                ///< zs has reached zp
};

/// Which coordinates are on a bound: those exactly there, for checks, or those near it, which Newton's method moves
/// there. A length of 1e-9 is not on its bound at 0; otherwise designs that keep shrinking would pass as optima.
/// `wide`: rows and margins too, as at a design found by another solver.
enum class Contact { exact, near, wide };

ActiveSet active_set(const PreparedProblem& p, const DesignEvaluation& design, const Eigen::VectorXd& y,
                     Contact contact = Contact::exact);

/// Evaluates the design at `y`, with the derivatives of what is active there.
ActiveSet evaluate_active(const PreparedProblem& p, const Eigen::VectorXd& y, Contact contact,
                          DesignEvaluation& design);

/// Names of the variables and constraints in an active set, each once.
std::vector<std::string> names(const PreparedProblem& p, const ActiveSet& a);

/// The least Euclidean norm of  sum w1 grad(objective rows) - sum w2 grad(constraints)  over weights w >= 0, those of
/// each level summing to the objective's slope in that level, in solver coordinates. Zero exactly where no direction
/// lowers the objective to first order and keeps the constraints.
///
/// Where singular values of a displaced pose coincide, the derivatives of single ones depend on the choice of their
/// vectors: there every direction of the cluster counts as a row, and the rows that matter are added one by one.
struct Stationarity {
  double residual = 0.0;
  /// By how much the objective could be lower, relative and to first order, because what counts as active is so only to
  /// 1e-6: the distances of the active values from their limits, weighted.
  double slack = 0.0;
  std::map<std::string, double> prices;  ///< see Candidate::prices
  ActiveSet support;                     ///< the active set without rows and margins of no weight
};
Stationarity stationarity(const PreparedProblem& p, const DesignEvaluation& design, const ActiveSet& a);

/// The slack of a stationary point with the fewest active values that make it stationary: neighbouring poses have
/// nearly the same gradients, and any of them may carry the weight.
double least_slack(const PreparedProblem& p, const Eigen::VectorXd& y);

/// Newton's method on the first-order conditions of an active set near `y`: its rows and margins as equations, second
/// derivatives by differences of exact gradients. Returns the last point reached, inside the bounds; the caller judges
/// it. Singular values of an active pose no farther apart than `gap`, in logarithms, are held equal (0: none are).
Eigen::VectorXd polish(const PreparedProblem& p, const Eigen::VectorXd& y, const ActiveSet& active, double gap = 0.0);

}  // namespace ninedof
