#pragma once
/// All rows of a prepared problem at one design, with their derivatives.

#include "optimize/minimax/prepared_problem.hpp"

namespace ninedof {

/// A design and the derivatives of its rows with respect to the free coordinates.
struct DesignEvaluation {
  DesignState state;
  std::vector<PoseSpectrum> spectra;  ///< see PreparedProblem::evaluated_spectra
  Eigen::VectorXd objective_rows, margins;
  Rows row_gradient, margin_gradient;
  Eigen::VectorXd levels;  ///< each the largest of its rows
  double log_objective = 0.0;
  /// Input: where positive, poses off the axis have smoothed singular values, see fill_soft_index.
  double smoothing = 0.0;
};

/// The rows that SLSQP is given, and whose derivatives are computed.
struct RowSelection {
  std::vector<int> row_levels, margins;  ///< indices into those of PreparedProblem, ascending
  std::vector<bool> spectra;  ///< whether a selected row needs the singular values
  bool alone = false;  ///< whether nothing else is evaluated: other rows, levels and the objective are stale
};

/// These rows; without any, values alone.
RowSelection selection_of(const PreparedProblem& p, std::vector<int> row_levels = {}, std::vector<int> margins = {});

/// Evaluates the design at `y` into `out`; all derivatives, or those of a selection. The others are left as they were.
void evaluate_design(const PreparedProblem& p, const Eigen::VectorXd& y, DesignEvaluation& out,
                     const RowSelection* selection = nullptr);

/// The same for a design whose state is set.
void evaluate_rows(const PreparedProblem& p, DesignEvaluation& out, const RowSelection* selection = nullptr);

/// What evaluate_design leaves out where the selection is evaluated alone.
void evaluate_others(const PreparedProblem& p, DesignEvaluation& out, const RowSelection& selection);

/// The derivatives of a selection, of a design that was evaluated without them.
void differentiate_rows(const PreparedProblem& p, DesignEvaluation& out, const RowSelection& selection);

/// One margin of a design whose state is set, and its derivatives in `gradient`. Nothing else is computed but the
/// singular values, where it is one of them.
double evaluate_margin(const PreparedProblem& p, DesignEvaluation& out, int k, Row gradient);

/// The same of the logarithm of the index at an evaluated pose.
double evaluate_index(const PreparedProblem& p, DesignEvaluation& out, int pose, Row gradient);

/// The pose that a margin looks at besides home, an index of DesignState::poses.
int pose_of_margin(const PreparedProblem& p, const DesignState& state, int k);
/// The same, or the two poses that it compares.
std::vector<int> poses_of_margin(const PreparedProblem& p, const DesignState& state, int k);

/// Largest violation of the margins and of zs < zp; 0 if none. Bounds always hold.
double violation(const PreparedProblem& p, const DesignEvaluation& design, const Eigen::VectorXd& y);

/// How far zs is above zp, as a violation; 0 where it is below.
double order_violation(const PreparedProblem& p, const DesignEvaluation& design, const Eigen::VectorXd& y);

/// 2-norm condition number of the nine-legged robot at the neutral configuration, and at each evaluated pose.
double neutral_condition(const PreparedProblem& p, const DesignEvaluation& design);
std::vector<double> conditions(const PreparedProblem& p, const DesignEvaluation& design);

}  // namespace ninedof
