#pragma once
/// The rows that the optimizer has of one limit: smooth margins of each side and item, and their derivatives.

#include <memory>
#include <span>

#include "limits/table.hpp"
#include "math/numbers.hpp"
#include "problem/design_state.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof {

/// A row of a constraint, or (constraint = -1 - k) a pair of singular values of spectrum k under a limit on the
/// condition number.
struct MarginRow {
  int constraint, row;
};

class SolverRows {
 public:
  SolverRows(const Limit& limit, SolverMargin form) : limit_(limit), label_(limit.label()), form_(form) {}
  virtual ~SolverRows() = default;

  const Limit& limit() const { return limit_; }
  const std::string& label() const { return label_; }
  int rows() const { return (has_high() ? items(Side::high) : 0) + (has_low() ? items(Side::low) : 0); }
  double margin(const DesignState& v, int row) const;
  /// The margins of some of its rows, ascending, with less work where one look gives several.
  virtual void margins(const DesignState& v, std::span<const MarginRow> rows, double* out) const {
    for (const MarginRow& row : rows) *out++ = margin(v, row.row);
  }
  void add_gradient(const DesignState& v, int row, Row out) const;
  Side side_of(int row) const { return item_of(row).first; }
  /// The pose that a row looks at besides home, an index of DesignState::poses.
  int pose_of(const DesignState& v, int row) const { return pose(v, item_of(row).second); }
  /// The leg, the pair of legs or the determinant that a row is about; "" where it has none.
  std::string part_of(int row) const { return part(item_of(row).second); }
  /// All poses that a row looks at where the value of the constraint is that of a few.
  virtual std::vector<int> poses_of(const DesignState& v, int row) const { return {pose_of(v, row)}; }
  /// Of a row with this margin: 1 - value / high or value / low - 1; of a determinant, which has no scale, value - low.
  ShownMargin shown(int row, double margin) const { return share_of_limit(form_, side_of(row), margin); }
  /// The limited value of a design whose margin on that side is given.
  double value_at(Side side, double margin) const { return value_at_margin(form_, side, bound(side), margin); }

  /// Whether it is about the lengths over all poses together.
  virtual bool compares_poses() const { return false; }

  /// Whether margins that agree at a few unrelated designs are the same function; false for piecewise functions.
  virtual bool analytic() const { return true; }

  /// Violation of the limit over violation of the row: 2 where an auxiliary variable shares it between two rows.
  virtual double violation_factor(int) const { return 1.0; }

  /// Derivative of a row's margin by the logarithm of its limit, at the limit: 1, or 0 for a row without a limit.
  virtual double price_factor(int row) const;

  /// Auxiliary variables that make margins smooth, see spread.cpp: their number, and the index of the first one among
  /// full variables and free coordinates.
  virtual int auxiliary_count() const { return 0; }
  void set_auxiliary(int variable, int coordinate) {
    auxiliary_variable_ = variable;
    auxiliary_coordinate_ = coordinate;
  }
  int auxiliary_variable() const { return auxiliary_variable_; }
  /// The best value of one for a design.
  virtual double auxiliary_value(const DesignState&, int) const { return 0.0; }

 protected:
  /// Number of margins of a side.
  virtual int items(Side side) const = 0;
  /// The pose of an item; of those that look at all poses or at none, the first.
  virtual int pose(const DesignState& v, int) const { return first_pose(v); }
  virtual std::string part(int) const { return ""; }
  /// The limited value. The second adds `scale` times its derivatives.
  virtual double value(const DesignState&, Side, int) const { return 0.0; }
  virtual void add_value_gradient(const DesignState&, Side, int, double, Row) const {}
  /// The margin of an item: by default a function of its value.
  virtual double item_margin(const DesignState& v, Side side, int item) const {
    return margin_of(side, value(v, side, item));
  }
  virtual void add_item_gradient(const DesignState& v, Side side, int item, Row out) const;

  /// The margin of a value, and its derivative by the value.
  double margin_of(Side side, double now) const { return solver_margin(form_, side, bound(side), now); }
  double margin_slope(Side side, double now) const { return solver_slope(form_, side, bound(side), now); }
  bool has_high() const { return limit_.high < infinity; }
  bool has_low() const { return limit_.low > 0.0; }
  double bound(Side side) const { return side == Side::high ? limit_.high : limit_.low; }
  std::pair<Side, int> item_of(int row) const;
  bool at_neutral() const { return limit_.at == LimitAt::neutral; }
  /// The first pose where the limit holds, an index of DesignState::poses.
  int first_pose(const DesignState& v) const { return at_neutral() ? 0 : v.first_pose; }
  /// The length that limits are fractions of; a radius is that of `body`, see widest_joint. The second adds `scale`
  /// times its derivatives.
  double unit(const DesignState& v, int body = -1) const;
  void add_unit_gradient(const DesignState& v, double scale, Row out, int body = -1) const;
  int auxiliary_coordinate() const { return auxiliary_coordinate_; }

 private:
  Limit limit_;
  std::string label_;
  SolverMargin form_;
  int auxiliary_variable_ = -1, auxiliary_coordinate_ = -1;
};

/// Use of the rows: `solve` needs smooth rows; `evaluate`, of one design, needs the smallest margin only.
enum class Purpose { solve, evaluate };

std::unique_ptr<SolverRows> make_pose_limit(const Limit& limit, const LimitRow& row, int poses,
                                            const std::array<bool, leg_pairs>& exempt);
std::unique_ptr<SolverRows> make_design_limit(const Limit& limit, const LimitRow& row);
std::unique_ptr<SolverRows> make_spread(const Limit& limit, const LimitRow& row, int poses, Purpose purpose);

/// The rows of a limit in a problem of `poses` displaced poses (0: the neutral one alone), where `exempt` pairs
/// of legs may meet. Valid limits only.
std::unique_ptr<SolverRows> make_solver_rows(const Limit& limit, int poses, Purpose purpose,
                                             const std::array<bool, leg_pairs>& exempt);

/// Least distance of O from the planes of base and platform, in zp, where O is placed.
inline constexpr double plate_gap = 1e-6;

/// 0 < zs < zp (eq. 9b), which no study has to ask for, at the neutral configuration and `poses`.
std::unique_ptr<SolverRows> make_between_plates(std::vector<int> poses);

}  // namespace ninedof
