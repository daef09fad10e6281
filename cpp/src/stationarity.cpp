#include "stationarity.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <vector>

namespace ninedof {

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::Index n = a.cols();
  const double tolerance = 1e-14 * a.cwiseAbs().maxCoeff() * std::max(1.0, b.cwiseAbs().maxCoeff()) * static_cast<double>(a.rows());
  Eigen::VectorXd w = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> passive;
  const auto solve = [&] {
    Eigen::MatrixXd sub(a.rows(), static_cast<Eigen::Index>(passive.size()));
    for (std::size_t k = 0; k < passive.size(); ++k) sub.col(static_cast<Eigen::Index>(k)) = a.col(passive[k]);
    return Eigen::VectorXd(sub.colPivHouseholderQr().solve(b));
  };
  for (Eigen::Index outer = 0; outer < 3 * n + 10; ++outer) {
    Eigen::VectorXd dual = a.transpose() * (b - a * w);
    for (const Eigen::Index k : passive) dual[k] = 0.0;
    Eigen::Index enter = 0;
    if (n == 0 || dual.maxCoeff(&enter) <= tolerance) break;
    passive.push_back(enter);
    for (;;) {
      const Eigen::VectorXd trial = solve();
      double step = 1.0;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double now = w[passive[k]], next = trial[static_cast<Eigen::Index>(k)];
        if (next <= 0.0 && now > next) step = std::min(step, now / (now - next));
      }
      for (std::size_t k = 0; k < passive.size(); ++k) {
        double& weight = w[passive[k]];
        weight += step * (trial[static_cast<Eigen::Index>(k)] - weight);
      }
      if (step >= 1.0) break;
      std::erase_if(passive, [&](Eigen::Index k) {
        const bool out = w[k] <= 1e-15;
        if (out) w[k] = 0.0;
        return out;
      });
      if (passive.empty()) break;
    }
  }
  return w;
}

double stationarity_residual(const ActiveGradients& g) {
  const Eigen::Index n = g.maxima.rows(), n1 = g.maxima.cols(), n2 = g.minima.cols(), n3 = g.constraints.cols();
  Eigen::MatrixXd gradients(n, n1 + n2 + n3);
  gradients << g.maxima, -g.minima, -g.constraints;
  // The two sums as heavily weighted rows; the weights are then normalised to meet them exactly.
  const double weight = 1e3 * std::max(1.0, gradients.size() > 0 ? gradients.cwiseAbs().maxCoeff() : 0.0);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + 2, gradients.cols());
  a.topRows(n) = gradients;
  a.row(n).head(n1).setConstant(weight);
  a.row(n + 1).segment(n1, n2).setConstant(weight);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + 2);
  b.tail(2).setConstant(weight);
  Eigen::VectorXd w = nonnegative_least_squares(a, b);
  w.head(n1) /= w.head(n1).sum();
  w.segment(n1, n2) /= w.segment(n1, n2).sum();
  return (gradients * w).norm();
}

}  // namespace ninedof
