#pragma once
/// A problem as the solver sees it.
///
/// Levels t, one for each number in the objective; objective rows f(y), each at most a level; margins m(y) >= 0.
/// The objective is a smooth, increasing function of the levels: at a solution each is the largest of its rows.

#include <algorithm>
#include <memory>
#include <vector>

#include "problem/constraints/solver_rows.hpp"
#include "problem/pose_index.hpp"

namespace ninedof {

/// Replaces a margin that is NaN or below it: logarithms of ratios of doubles end there.
constexpr double worst_margin = -700.0;

/// An objective row and a level it is bounded by.
struct RowLevel {
  int row, level;
};

/// Coordinates, rows and poses, computed once and shared by all starts.
struct PreparedProblem {
  /// For the solver. `size_limit`: largest size of a variable without an effective upper bound.
  PreparedProblem(const Problem& problem, double size_limit);
  /// For the evaluation of single designs: all variables unscaled, all margins kept.
  explicit PreparedProblem(const Problem& problem);
  /// The same for one design: no variable is free, and set_state takes no coordinates.
  PreparedProblem(const Problem& problem, const Eigen::VectorXd& variables);

  Problem problem;
  const DesignFamily* family;
  Coordinates coordinates;
  std::vector<PoseSpec> pose_specs;
  int objective_poses;       ///< 0: the neutral one is evaluated
  std::vector<bool> closed;  ///< of each evaluated spectrum: whether the closed form is used
  std::vector<std::unique_ptr<SolverRows>> constraints;
  std::vector<MarginRow> margins;
  std::vector<RowLevel> row_levels;
  /// Platform joints whose distance may be the characteristic length, see length_joint.hpp; empty unless it has a kink.
  std::vector<int> length_joints;
  int rows = 0, levels = 1;
  /// Of the poses that count in a mean: the first levels. Empty where the objective is the worst or one pose.
  Eigen::VectorXd mean_weights;
  int auxiliary_count = 0;

  int evaluated_poses() const { return std::max(objective_poses, 1); }
  /// Those of the evaluated poses, then that of the neutral one where its condition number has a limit of its own.
  int evaluated_spectra() const { return static_cast<int>(closed.size()); }
  double condition_limit(int spectrum) const {
    const Objective& o = problem.objective;
    return spectrum < evaluated_poses() ? o.condition_limit : o.neutral_condition_limit;
  }
  const std::string& margin_name(int k) const;
  double margin_price(int k) const;
  ShownMargin shown_margin(int k, double margin) const;
  double limited_value(int k, double margin) const;
  std::string margin_part(int k) const;
  double violation_factor(int k) const;
  /// Lets a pose of the objective follow the design; false, and it does not, where the closed form is used. Rows that
  /// are equal where all poses stay count once, though one that follows may make them differ.
  bool follow(int pose, const std::shared_ptr<const FollowingPose>& how);
  /// The state of the design at `y`, in solver coordinates.
  void set_state(const Eigen::VectorXd& y, DesignState& state) const;
  /// The pieces of the characteristic length that a design at `y` belongs to, as DesignState::length_joint, the
  /// farthest joint first; -1 alone where it has no kink.
  std::vector<int> pieces(const Eigen::VectorXd& y) const;
  /// `y` with the best values of the constraints' auxiliary variables.
  Eigen::VectorXd with_auxiliary(const Eigen::VectorXd& y) const;
  /// A full set of variables without the auxiliary ones.
  Eigen::VectorXd without_auxiliary(const Eigen::VectorXd& x) const { return x.head(x.size() - auxiliary_count); }
  /// Whether the index has kinks where singular values meet: off the axis, and not in the Frobenius norm.
  bool has_kinks() const;
  /// First row of an evaluated pose, and the pose of a row.
  int first_row(int pose) const { return first_row_[at_index(pose)]; }
  int pose_of(int row) const;
  /// The pose of the objective that a pose of DesignState::poses is or lies on the way to; -1 at home.
  int objective_pose(int state_pose) const;

  /// The logarithm of the objective and its derivatives with respect to the levels.
  double objective(const Eigen::VectorXd& levels, Eigen::VectorXd* slopes = nullptr) const;

 private:
  PreparedProblem(const Problem& problem, Coordinates solved, Purpose purpose);
  std::vector<DesignState> unrelated_designs(const Coordinates& within) const;
  void drop_repeated_margins();

  std::vector<int> first_row_;
};

}  // namespace ninedof
