#pragma once
/// A problem made ready to be solved.
///
/// What the solver sees: levels t, one for each number the objective is made of; objective rows f(y), each to stay below a
/// level; margins m(y) >= 0. The objective is a smooth, increasing function of the levels, so that at a solution each is the
/// largest of its rows.

#include <memory>
#include <vector>

#include "design/constraints/constraint.hpp"
#include "design/pose_index.hpp"

namespace ninedof {

/// A margin that is not a number, or infinitely bad, counts as this: logarithms of ratios of doubles end there.
constexpr double hopeless_margin = -700.0;

/// An objective row and the level it stays below.
struct Use {
  int row, level;
};

/// A margin: a row of a constraint, or the limit on the condition number of a pose (constraint -1, row of its pairs).
struct MarginRow {
  int constraint, row;
};

/// Coordinates, rows and places worked out once, shared by all starts.
struct Prepared {
  /// `cap`: largest size looked at where a variable has no serious upper bound.
  Prepared(const Problem& problem, double cap);
  /// To look at single designs: all variables as they are, all margins kept.
  explicit Prepared(const Problem& problem);

  Problem problem;
  const DesignFamily* family;
  Coordinates coordinates;
  std::vector<PoseSpec> places;  ///< the neutral one, those of the objective, those between
  int looked = 0;             ///< poses of the objective
  std::vector<bool> closed;   ///< of each pose looked at: through the closed form
  std::vector<std::unique_ptr<Constraint>> constraints;
  std::vector<MarginRow> margins;
  std::vector<Use> uses;
  int rows = 0, levels = 1;
  int auxiliary_count = 0;

  const std::string& margin_name(int k) const;
  double margin_price(int k) const;
  double violation_factor(int k) const;
  /// `y` with the auxiliary variables of constraints at their best.
  Eigen::VectorXd with_auxiliary(const Eigen::VectorXd& y) const;
  /// A full set of variables without the auxiliary ones.
  Eigen::VectorXd without_auxiliary(const Eigen::VectorXd& x) const { return x.head(x.size() - auxiliary_count); }
  /// Whether singular values that meet have a kink: off the axis, and not in the Frobenius norm.
  bool kinked() const;
  /// Rows of the objective that belong to a pose looked at.
  int first_row(int pose) const { return first_row_[static_cast<std::size_t>(pose)]; }

  int pose_of(int row) const;

  /// The objective, as a logarithm, and its derivatives with respect to the levels.
  double objective(const Eigen::VectorXd& levels, Eigen::VectorXd* slopes = nullptr) const;

 private:
  void place_poses();
  void count_rows(Purpose purpose);
  void teach_constraints(const Coordinates& within);
  void drop_repeated_margins();

  std::vector<int> first_row_;
};

}  // namespace ninedof
