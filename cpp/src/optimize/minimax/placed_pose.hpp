#pragma once
/// One design at one pose, with O placed where the worst of the index and of all limits is least.

#include "math/linear/minimax_step.hpp"
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
  /// `slopes`: of the pose by its coordinates in a region, where derivatives by these are wanted.
  void set_pose(const Pose& pose, const std::optional<PoseSlopes>& slopes = {});
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
    Rows by_at;  ///< by the coordinates of the pose, if it was set with slopes
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

  /// A row of `rows_`; or, where that is -1, the index along directions in the spans of the three singular vectors
  /// of the largest and of the smallest singular values: where these meet, they have slopes along all directions.
  struct Piece {
    Eigen::Index row;
    Vec3 top = Vec3::Zero(), bottom = Vec3::Zero();
  };

  void list_rows(const Eigen::VectorXd& variables);
  double evaluate(const Vec3& shift);
  double value(const Row& row) const;
  double shown_margin(const Row& row, double margin) const;
  Vec3 gradient(const Row& row) const;
  Vec3 free_of(const Eigen::RowVectorXd& g) const;
  /// The rows that are at least so large.
  void select(double least);
  /// The selected rows of the index become pieces along their own singular vectors.
  void turn_index_rows();
  void differentiate();
  double value(const Piece& piece) const;
  Vec3 gradient(const Piece& piece) const;
  Eigen::RowVectorXd along(const Piece& piece) const;
  /// The largest piece at a step, to first order in the matrices of the singular values.
  Piece steepest(const Vec3& step) const;
  /// The step, with pieces joining until none is above its level.
  MinimaxStep least_step(const Mat3& curvature);
  Mat6 vectors() const;
  /// Turns pieces with the spans of the singular vectors, from where these were `from`.
  void carry(std::vector<Piece>& pieces, const Mat6& from) const;
  void add_outer(const Row& row, double weight, Eigen::Index k, Outer& out);
  Outer empty(Eigen::Index rows) const;
  Eigen::Index own() const { return static_cast<Eigen::Index>(p_.coordinates.size()) - 3; }

  const PlacementGoal& goal_;
  PreparedProblem p_;
  std::vector<PoseSpec> specs_;
  std::array<int, 3> shift_variable_{};
  std::unique_ptr<SolverRows> between_plates_;
  DesignEvaluation design_;
  RowSelection none_, selection_;
  std::vector<Row> rows_;
  int first_of_range_ = 0;
  std::vector<Row> of_design_;
  Eigen::VectorXd values_;          // of all rows, the worse the larger
  std::vector<Piece> near_;         // near the largest, with their gradients
  std::vector<Eigen::RowVectorXd> tops_, bottoms_;  // derivatives of the matrices of singular values, see cluster_block
  bool has_directions_ = false;
  Gradient gradients_;
};

}  // namespace ninedof
