#pragma once
/// A problem made ready to be solved, and one look at a design in solver coordinates.

#include "coordinates.hpp"

namespace ninedof {

/// Coordinates and margins worked out once, shared by all starts.
struct Prepared {
  /// `cap`: largest size looked at where a variable has no serious upper bound.
  Prepared(const Problem& problem, double cap);

  Problem problem;
  const DesignFamily* family;
  std::vector<Margin> margins;
  Coordinates coordinates;
};

/// A design and the gradients of its quantities with respect to the free coordinates.
struct Look {
  Eigen::VectorXd x;
  DesignPoint point;
  Eigen::Matrix<double, quantity_count, Eigen::Dynamic> gradient;

  double log_max() const { return std::max(point.value[log_axial_max], point.value[log_transverse_max]); }
  double log_min() const { return std::min(point.value[log_axial_min], point.value[log_transverse_min]); }
};

/// Evaluates the design at `y` into `out`.
void look(const Prepared& p, const Eigen::VectorXd& y, Look& out);

/// Largest violation of the margins and of zs < zp; 0 if none. Bounds always hold.
double violation(const Prepared& p, const Look& l, const Eigen::VectorXd& y);

}  // namespace ninedof
