#pragma once
/// From an end point of SLSQP to a point that satisfies the first-order conditions up to rounding.

#include "optimize/minimax/design_evaluation.hpp"

namespace ninedof {

/// Newton's method on the first-order conditions of the active set at `y`: active rows and margins as equations, second
/// derivatives by differences of exact gradients. Returns the last point reached, inside the bounds; the caller judges
/// it.
///
/// `smoothing`: that of the problem `y` solves, see DesignEvaluation; singular values about as close as that are held
/// equal.
Eigen::VectorXd polish(const PreparedProblem& p, const Eigen::VectorXd& y, double smoothing = 0.0);

}  // namespace ninedof
