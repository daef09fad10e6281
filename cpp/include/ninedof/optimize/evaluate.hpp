#pragma once
/// One design of a problem: objective, condition numbers and margins, with exact gradients.

#include <string>
#include <vector>

#include "ninedof/problem/problem.hpp"

namespace ninedof {

/// Gradients are with respect to the full set of variables.
struct Evaluation {
  double log_objective;
  Eigen::VectorXd gradient;  ///< of log_objective; where singular values tie, that of one of them
  double condition_number;   ///< at the neutral configuration
  std::vector<double> conditions;  ///< at each evaluated pose
  double characteristic_length;
  struct Margin {
    std::string name;
    double value;  ///< 1 - limited / high or limited / low - 1; of a determinant limited - low
    Eigen::VectorXd gradient;
    double limited;  ///< what is limited, in the unit of the limit; its own digits where the margin has lost them
    std::string
        part;  ///< the leg, the pair of legs or the determinant that reaches it; "" where the limit has no parts
  };
  std::vector<Margin> margins;  ///< the smallest of each constraint
};

/// Evaluates one design; `variables` is a full set, bounds are not enforced.
Evaluation evaluate(const Problem& problem, const Eigen::VectorXd& variables);

}  // namespace ninedof
