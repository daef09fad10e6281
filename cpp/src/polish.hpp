#pragma once
/// From a point SLSQP left near an optimum to one that satisfies the first-order conditions to rounding.

#include "prepared.hpp"

namespace ninedof {

/// Newton's method on the first-order conditions of the active set at `y`: ties and binding constraints as equations, second
/// derivatives by differences of exact gradients. Returns the last point reached, inside the bounds; the caller judges it.
Eigen::VectorXd polish(const Prepared& p, const Eigen::VectorXd& y);

}  // namespace ninedof
