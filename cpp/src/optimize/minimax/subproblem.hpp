#pragma once
/// What one call of SLSQP is about: objective and constraints as smooth rows, the ones that can matter.
///
/// SLSQP's own arithmetic grows with the number of rows times the square of the number of variables; a study over many poses
/// has thousands of rows, of which a few dozen ever come near zero. Those near zero are taken; where the answer violates
/// another, it joins them and the run goes on.

#include <functional>

#include "optimize/minimax/look.hpp"
#include "optimize/minimax/slsqp.hpp"

namespace ninedof {

/// Violation up to which a design on the way counts as allowed: well inside what Candidate::feasible grants, so that the
/// little it gains in the index is rounding.
constexpr double clearly_allowed = 1e-9;

/// Called with the logarithm of the objective and the violation of each design a run looks at.
using Observer = std::function<void(double, double)>;

/// The gradient of the objective, with one of the rows that rule each level.
Eigen::VectorXd ruling_gradient(const Prepared& p, const Look& l, const Eigen::VectorXd& slopes);

class Subproblem {
 public:
  Subproblem(const Prepared& p, Formulation formulation, std::stop_token stop, Observer observer)
      : p_(p), formulation_(formulation), stop_(std::move(stop)), observer_(std::move(observer)) {}

  /// The point SLSQP ends at, from `from`, in solver coordinates. `smoothing`: see Look; `tolerance`:
  /// relative, on objective and coordinates.
  Eigen::VectorXd solve(const Eigen::VectorXd& from, double smoothing, double tolerance, int max_evaluations);

  /// The allowed design of least objective that the last call looked at, or where it began. NLopt returns its own choice among
  /// the points it saw, by a measure that counts the levels.
  const Eigen::VectorXd& seen() const { return seen_; }

  long evaluations() const { return evaluations_; }

 private:
  void choose(const Look& l);
  bool add_violated(const Look& l);
  void note_wanted();
  void fill(const Look& l, const Eigen::VectorXd& at, Nlp::Values& out) const;
  Eigen::VectorXd run(const Eigen::VectorXd& from, double tolerance, int max_evaluations);
  bool minimax() const { return formulation_ == Formulation::minimax; }

  const Prepared& p_;
  Formulation formulation_;
  std::stop_token stop_;
  Observer observer_;
  Look l_;
  std::vector<int> uses_;  ///< rows taken, and the margins in `wanted_`
  Wanted wanted_;
  Eigen::VectorXd seen_;
  double seen_objective_ = 0.0;
  long evaluations_ = 0;
};

/// Minimises t >= 0 with every margin >= -t, zs < zp included: the point of least violation near a start.
Eigen::VectorXd least_violation_point(const Prepared& p, const Eigen::VectorXd& start, int max_evaluations,
                                      const std::stop_token& stop, long& evaluations);

}  // namespace ninedof
