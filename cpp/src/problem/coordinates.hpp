#pragma once
/// The solver's coordinates: the free variables only, lengths as y = asinh(x / unit).
///
/// This scale is linear below the unit and logarithmic above it. A bound at 0 stays reachable, steps are relative for
/// sizes from 1 to 10^6, and a study in millimetres gives the same run as in metres. The unit is that of the problem,
/// or less where the bounds allow only small robots. Angles and fractions are not scaled. zs < zp is linear in y.
///
/// Bounds of an angle that are a full turn apart, or none, are no bounds of y: it goes round, and x is within them.

#include <vector>

#include "problem/full_variables.hpp"

namespace ninedof {

/// Whether a bound of a length counts as one: a million characteristic lengths or more do not.
bool is_effective_bound(const Problem& problem, double bound);

class Coordinates {
 public:
  /// `size_limit`: largest size of a variable without an effective upper bound, in the study's unit.
  Coordinates(const Problem& problem, double size_limit, int auxiliary_count = 0);

  /// Every variable unscaled and without bounds, to evaluate single designs. Has no starts and no order.
  static Coordinates plain(const Problem& problem);

  /// Every variable fixed there: no coordinates at all, to evaluate one design at many poses.
  static Coordinates fixed(const Problem& problem, const Eigen::VectorXd& variables);

  int size() const { return static_cast<int>(free_.size()); }
  const Eigen::VectorXd& low() const { return low_; }
  const Eigen::VectorXd& high() const { return high_; }

  /// Full variable behind free coordinate `k`, and the coordinate of a full variable, or -1.
  int variable(int k) const { return free_[at_index(k)]; }
  int coordinate(int variable) const;
  /// Index of the characteristic length among the full variables, or -1.
  int length_variable() const { return length_variable_; }
  const Variable& info(int k) const { return all_[at_index(variable(k))]; }
  /// Whether an internal bound, not one of the study, limits free coordinate `k` from below, from above.
  bool internal_low(int k) const { return internal_low_[at_index(k)]; }
  bool internal_high(int k) const { return internal_high_[at_index(k)]; }

  /// All full variables and the auxiliary ones; bounds are met exactly.
  Eigen::VectorXd variables(const Eigen::VectorXd& y) const;
  /// Free coordinates of a full set of variables, moved inside the bounds; auxiliary variables left out are 0.
  Eigen::VectorXd coordinates(const Eigen::VectorXd& x) const;
  /// dx/dy of each free coordinate at x.
  Eigen::VectorXd slopes(const Eigen::VectorXd& x) const;

  /// The order zs < zp as a linear inequality in y: gradient . y + constant >= 0.
  struct Order {
    Eigen::VectorXd gradient;
    double constant;
  };
  const Order& order() const { return order_; }
  double order_margin(const Eigen::VectorXd& y) const { return order_.gradient.dot(y) + order_.constant; }

  /// Start number `index` of the low-discrepancy sequence, inside the bounds and the order.
  Eigen::VectorXd start(int index, std::uint64_t seed) const;

 private:
  Coordinates() = default;
  bool scaled(int variable) const;
  double within_turn(int k, double y) const;
  double to_y(int variable, double x) const;
  double to_x(int variable, double y) const;

  std::vector<Variable> all_;
  bool plain_ = false;
  double unit_;
  Eigen::VectorXd fixed_;  // all variables; free ones are overwritten
  Eigen::VectorXd x_low_, x_high_;
  std::vector<int> free_;
  std::vector<bool> internal_low_, internal_high_, round_;
  Eigen::VectorXd low_, high_;
  int zp_variable_, length_variable_;
  int zp_, zs_;            // free coordinate, or -1 where fixed
  double y_zp_, y_zs_;     // of the fixed ones
  Order order_;
};

}  // namespace ninedof
