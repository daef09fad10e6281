#pragma once
/// One call of SLSQP: objective and constraints as smooth rows, reduced to those that can be active.
///
/// SLSQP's own arithmetic grows with the number of rows times the square of the number of variables. A study over many
/// poses has thousands of rows, of which a few dozen ever come near zero. Only those are selected; rows that the answer
/// violates are added, and the run continues.

#include <functional>

#include "math/slsqp.hpp"
#include "ninedof/optimize/trace.hpp"
#include "optimize/minimax/design_evaluation.hpp"

namespace ninedof {

/// Largest violation of an iterate that counts as feasible: well below Candidate::feasible, so that what it gains is
/// rounding.
constexpr double clearly_feasible = 1e-9;

/// Called with the logarithm of the objective and the violation of each design a run evaluates.
using Observer = std::function<void(double, double)>;

/// The gradient of the objective; of the rows that tie for a level, one counts.
Eigen::VectorXd objective_gradient(const PreparedProblem& p, const DesignEvaluation& design,
                                   const Eigen::VectorXd& slopes);

class Subproblem {
 public:
  Subproblem(const PreparedProblem& p, Formulation formulation, std::stop_token stop, Observer observer)
      : p_(p), formulation_(formulation), stop_(std::move(stop)), observer_(std::move(observer)) {}

  /// The end point of SLSQP from `from`, in solver coordinates. `smoothing` is that of the objective; `tolerance` is
  /// relative, on objective and coordinates; `piece` is one of PreparedProblem::pieces.
  Eigen::VectorXd solve(const Eigen::VectorXd& from, int piece, double smoothing, double tolerance,
                        int max_evaluations);

  /// The feasible design of least objective that the last call evaluated, or its start. NLopt returns another one of
  /// the evaluated points, by a measure that counts the levels.
  const Eigen::VectorXd& best_seen() const { return best_seen_; }

  long evaluations() const { return evaluations_; }

 private:
  void select_rows();
  bool add_violated();
  void fill(const Eigen::VectorXd& at, Nlp::Values& out) const;
  Eigen::VectorXd run(const Eigen::VectorXd& from, double tolerance, int max_evaluations);
  bool minimax() const { return formulation_ == Formulation::minimax; }

  const PreparedProblem& p_;
  Formulation formulation_;
  std::stop_token stop_;
  Observer observer_;
  DesignEvaluation design_;
  RowSelection selection_;
  Eigen::VectorXd best_seen_;
  double best_seen_objective_ = 0.0;
  long evaluations_ = 0;
};

}  // namespace ninedof
