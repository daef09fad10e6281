#pragma once
/// One design at one pose, with O placed where the worst of the index and of all limits is least.

#include "ninedof/optimize/region_placement.hpp"
#include "optimize/minimax/design_evaluation.hpp"

namespace ninedof {

class PlacedPose {
 public:
  /// `problem` has no poses, `variables` is a full set of it.
  PlacedPose(const Problem& problem, const Eigen::VectorXd& variables, const PlacementGoal& goal);

  double zp() const { return design_.state.blueprint.zp; }
  /// Of the legs where rows were evaluated last.
  const Vec9& lengths() const { return design_.state.pose(1).legs.length; }
  void set_pose(const Pose& pose);
  /// Another design; the rows stay the same ones.
  void set_design(const Eigen::VectorXd& variables);

  /// Minimizes the largest row over the shift of s, from a start; ends early where it is at most `enough`. Returns it.
  double place(Vec3& shift, double enough);

  using Gradient = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  /// All rows at a shift and their derivatives with respect to it.
  PlacedRows rows(const Vec3& shift);

  /// The rows at a shift: the excess and what it consists of.
  PlacedEnd end(const Placed& placed);

  /// Rows and their derivatives with respect to the design's variables, the goal's log_index, and what the ranges are
  /// shifted by: one column for each leg of each range.
  struct Outer {
    Eigen::VectorXd value;
    Rows by_variables, by_ranges;
    Eigen::VectorXd by_index;
  };
  /// One row: the least excess, where `place` has ended.
  Outer least(const Vec3& shift);
  /// All rows at a shift.
  Outer all(const Vec3& shift);
  /// The limits of the design alone, as rows.
  Outer of_design();

 private:
  struct Row {
    enum class Kind { index, limit, longest, shortest, plates, box };
    Kind kind;
    int item;   ///< of the index, of the margins; leg; plate; axis
    int range;  ///< of the goal
  };

  void list_rows(const Eigen::VectorXd& variables);
  double evaluate(const Vec3& shift);
  double value(const Row& row) const;
  double shown_margin(const Row& row, double margin) const;
  Vec3 gradient(const Row& row) const;
  void select(double least);
  void differentiate();
  void add_outer(const Row& row, double weight, Eigen::Index k, Outer& out);
  Outer empty(Eigen::Index rows) const;

  const PlacementGoal& goal_;
  PreparedProblem p_;
  std::vector<PoseSpec> specs_;
  std::array<int, 3> shift_variable_{};
  std::unique_ptr<Constraint> between_plates_;
  DesignEvaluation design_;
  RowSelection none_, selection_;
  std::vector<Row> rows_;
  int first_of_range_ = 0;
  std::vector<Row> of_design_;
  Eigen::VectorXd values_;          // of all rows, the worse the larger
  std::vector<Eigen::Index> near_;  // rows near the largest, with their gradients
  Gradient gradients_;
};

}  // namespace ninedof
