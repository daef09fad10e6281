#pragma once
/// One look at a design in solver coordinates: all rows of a prepared problem, with their derivatives.

#include "optimize/minimax/prepared.hpp"

namespace ninedof {

/// A design and the derivatives of its rows with respect to the free coordinates.
struct Look {
  DesignState view;
  std::vector<PoseSpectrum> spectra;  ///< of the poses looked at
  Eigen::VectorXd f, m;
  Rows f_gradient, m_gradient;
  Eigen::VectorXd levels;             ///< each the largest of its rows
  double log_objective = 0.0;
  /// Set before looking: where it is positive, poses off the axis have soft singular values, see fill_soft_index.
  double smoothing = 0.0;
};

/// What derivatives are asked for: of margins by index, and of all singular values of a pose looked at.
struct Wanted {
  std::vector<int> margins;
  std::vector<bool> poses;
};

/// Evaluates the design at `y` into `out`; all derivatives, or those wanted. The others are left as they were.
void look(const Prepared& p, const Eigen::VectorXd& y, Look& out, const Wanted* wanted = nullptr);

/// Largest violation of the margins and of zs < zp; 0 if none. Bounds always hold.
double violation(const Prepared& p, const Look& l, const Eigen::VectorXd& y);

/// How far zs is beyond zp, as a violation; 0 where it is below.
double order_violation(const Prepared& p, const Look& l, const Eigen::VectorXd& y);

/// 2-norm condition number of the nine-legged robot at the neutral configuration, and at each pose looked at.
double neutral_condition(const Prepared& p, const Look& l);
std::vector<double> conditions(const Prepared& p, const Look& l);

}  // namespace ninedof
