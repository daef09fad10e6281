#pragma once
/// The coordinates the solver works in: the free variables only, lengths as y = asinh(x / unit).
///
/// Linear below the unit and logarithmic above it, so that a bound at 0 stays reachable while sizes of 1 and of 10^6 look
/// alike, and a study in millimetres runs as the same one in metres. The unit is that of the problem, or less where the
/// bounds allow only small robots. Angles and fractions stay as they are. The order of zs and zp carries over.

#include <algorithm>
#include <vector>

#include "design/full_variables.hpp"

namespace ninedof {

/// Whether an upper bound of a length is one: a million characteristic lengths are not.
bool serious_bound(const Problem& problem, double high);

class Coordinates {
 public:
  /// `cap`: largest size looked at where a variable has no serious upper bound, in the study's unit.
  Coordinates(const Problem& problem, double cap, int auxiliary_count = 0);

  /// Every variable as it is, without bounds: to look at single designs. Has no starts and no order.
  static Coordinates plain(const Problem& problem);

  int size() const { return static_cast<int>(free_.size()); }
  const Eigen::VectorXd& low() const { return low_; }
  const Eigen::VectorXd& high() const { return high_; }

  /// Full variable behind free coordinate `k`, and the coordinate of a full variable, or -1.
  int variable(int k) const { return free_[static_cast<std::size_t>(k)]; }
  int coordinate(int variable) const;
  /// The full variable that is the characteristic length, or -1.
  int length_variable() const { return length_variable_; }
  const Variable& info(int k) const { return all_[static_cast<std::size_t>(variable(k))]; }
  /// Whether a range of ours, and no bound of the study, limits free coordinate `k` from below, from above.
  bool capped_low(int k) const { return capped_low_[static_cast<std::size_t>(k)]; }
  bool capped_high(int k) const { return capped_high_[static_cast<std::size_t>(k)]; }

  /// All full variables and auxiliary ones, bounds met exactly.
  Eigen::VectorXd variables(const Eigen::VectorXd& y) const;
  /// Free coordinates of a full set of variables, moved inside the bounds. auxiliary variables may be left out and are then 0.
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
  double to_y(int variable, double x) const;
  double to_x(int variable, double y) const;

  std::vector<Variable> all_;
  bool plain_ = false;
  double unit_;
  Eigen::VectorXd fixed_;  // all variables; free ones are overwritten
  Eigen::VectorXd x_low_, x_high_;
  std::vector<int> free_;
  std::vector<bool> capped_low_, capped_high_;
  Eigen::VectorXd low_, high_;
  int zp_variable_, length_variable_;
  int zp_, zs_;            // free coordinate, or -1 where fixed
  double y_zp_, y_zs_;     // of the fixed ones
  Order order_;
};

}  // namespace ninedof
