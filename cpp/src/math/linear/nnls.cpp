#include "math/linear/nnls.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "math/linear/least_squares.hpp"

namespace ninedof {

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::Index n = a.cols();
  Eigen::VectorXd w = Eigen::VectorXd::Zero(n);
  if (n == 0) return w;
  const Eigen::VectorXd norms = a.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
  std::vector<Eigen::Index> passive;  // weights that may be positive
  const auto unconstrained = [&] {
    Eigen::MatrixXd sub(a.rows(), static_cast<Eigen::Index>(passive.size()));
    for (std::size_t k = 0; k < passive.size(); ++k) sub.col(static_cast<Eigen::Index>(k)) = a.col(passive[k]);
    return least_squares(sub, b);
  };
  for (Eigen::Index outer = 0; outer < 3 * n + 10; ++outer) {
    // Cosines between the residual and the columns: scale-free, so that the smallest residual is still worked on.
    const Eigen::VectorXd residual = b - a * w;
    Eigen::VectorXd descent = (a.transpose() * residual).cwiseQuotient(norms);
    for (const Eigen::Index k : passive) descent[k] = 0.0;
    Eigen::Index enter = 0;
    if (descent.maxCoeff(&enter) <= 1e-10 * residual.norm()) break;
    passive.push_back(enter);
    while (!passive.empty()) {
      const Eigen::VectorXd trial = unconstrained();
      double step = 1.0;
      Eigen::Index limiting = -1;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double now = w[passive[k]], next = trial[static_cast<Eigen::Index>(k)];
        if (!(next <= 0.0 && now > next && now / (now - next) < step)) continue;
        step = now / (now - next);
        limiting = passive[k];
      }
      for (std::size_t k = 0; k < passive.size(); ++k)
        w[passive[k]] += step * (trial[static_cast<Eigen::Index>(k)] - w[passive[k]]);
      if (limiting < 0) break;
      // The weight that set the step is zero now, whatever rounding has left of it.
      std::erase_if(passive, [&](Eigen::Index k) {
        const bool gone = k == limiting || w[k] <= 1e-15;
        if (gone) w[k] = 0.0;
        return gone;
      });
    }
  }
  return w.cwiseMax(0.0);
}

}  // namespace ninedof
