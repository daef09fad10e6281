#pragma once
/// From a point SLSQP left near an optimum to one that satisfies the first-order conditions to rounding.

#include "optimize/minimax/look.hpp"

namespace ninedof {

/// Newton's method on the first-order conditions of the active set at `y`: active rows and margins as equations, second
/// derivatives by differences of exact gradients. Returns the last point reached, inside the bounds; the caller judges it.
///
/// `smoothing`: that of the problem `y` solves, see Look; singular values about as close as that are held together.
Eigen::VectorXd polish(const Prepared& p, const Eigen::VectorXd& y, double smoothing = 0.0);

}  // namespace ninedof
