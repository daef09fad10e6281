#pragma once
/// NLopt's SLSQP as one function. Its return code is not reported: callers check the point themselves.

#include <Eigen/Core>
#include <functional>
#include <string>

namespace ninedof {

/// Minimize f(y) subject to c(y) <= 0 and low <= y <= high. Jacobians are row-major, one row a constraint.
struct Nlp {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  struct Values {
    double f = 0.0;
    Eigen::VectorXd f_gradient, c;
    RowMajor c_gradient;
  };

  Eigen::Index variables = 0, constraints = 0;
  Eigen::VectorXd low, high;
  /// Fills sized `Values`; returns false to stop the run.
  std::function<bool(const Eigen::VectorXd& y, Values& out)> evaluate;
};

struct SlsqpSettings {
  double tolerance = 1e-13;  ///< relative, on f and y
  int max_evaluations = 500;
};

/// The last point SLSQP proposed as its answer.
Eigen::VectorXd slsqp(const Nlp& nlp, const Eigen::VectorXd& start, const SlsqpSettings& settings);

/// The version of NLopt, such as "2.7.1".
std::string slsqp_version();

}  // namespace ninedof
