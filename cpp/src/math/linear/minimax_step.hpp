#pragma once
/// The step of a sequential quadratic method for the least maximum of several functions of three variables.

#include "ninedof/math/types.hpp"

namespace ninedof {

/// The d that minimizes  max_i (f_i + g_i . d) + d . hessian d / 2.
struct MinimaxStep {
  Vec3 step;
  double level;            ///< that maximum, without the quadratic term
  Eigen::VectorXd weight;  ///< one for each function, not negative, of sum 1: hessian d = -sum weight_i g_i
};

/// `f`: at least one value. `gradient`: a row for each. `hessian`: positive definite.
MinimaxStep minimax_step(const Eigen::VectorXd& f, const Eigen::Matrix<double, Eigen::Dynamic, 3>& gradient,
                         const Mat3& hessian);

}  // namespace ninedof
