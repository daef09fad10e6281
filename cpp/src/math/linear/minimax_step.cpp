#include "math/linear/minimax_step.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace ninedof {
namespace {

/// Of the dual matrix: keeps its rank where five gradients of three components meet.
constexpr double regular = 1e-13;
constexpr double enough = 1e-13;  // by which a row may pass the level, relative
constexpr int most_rows = 6, most_changes = 200;

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_rows + 1, most_rows + 1>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_rows + 1, 1>;

}  // namespace

// An active-set method for the dual, min w.K w / 2 - f.w over the simplex, K = G hessian^-1 G^T: the row farthest above
// the level joins, rows whose weight would be negative leave.
MinimaxStep minimax_step(const Eigen::VectorXd& f, const Eigen::Matrix<double, Eigen::Dynamic, 3>& gradient,
                         const Mat3& hessian) {
  const Mat3 inverse = hessian.inverse();
  Eigen::Index first = 0;
  f.maxCoeff(&first);
  std::vector<Eigen::Index> rows{first};
  SmallVector weight = SmallVector::Ones(1);
  MinimaxStep out;
  for (int change = 0; change < most_changes; ++change) {
    // The minimum over the rows as far as the weights stay positive.
    while (true) {
      const auto n = static_cast<Eigen::Index>(rows.size());
      Small kkt = Small::Ones(n + 1, n + 1);
      SmallVector right(n + 1);
      double size = 0.0;
      for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j)
          kkt(i, j) = gradient.row(rows[std::size_t(i)]) * inverse * gradient.row(rows[std::size_t(j)]).transpose();
        right[i] = f[rows[std::size_t(i)]];
        size = std::max(size, kkt(i, i));
      }
      for (Eigen::Index i = 0; i < n; ++i) kkt(i, i) += regular * std::max(size, 1e-300);
      kkt(n, n) = 0.0;
      right[n] = 1.0;
      const SmallVector wish = kkt.partialPivLu().solve(right).head(n);
      double share = 1.0;
      Eigen::Index leaves = -1;
      for (Eigen::Index i = 0; i < n; ++i)
        if (wish[i] < 0.0 && weight[i] / (weight[i] - wish[i]) < share) {
          share = weight[i] / (weight[i] - wish[i]);
          leaves = i;
        }
      weight += share * (wish - weight);
      if (leaves < 0) break;
      rows.erase(rows.begin() + leaves);
      for (Eigen::Index i = leaves; i + 1 < n; ++i) weight[i] = weight[i + 1];
      weight.conservativeResize(n - 1);
    }
    Vec3 slope = Vec3::Zero();
    for (std::size_t i = 0; i < rows.size(); ++i)
      slope += weight[static_cast<Eigen::Index>(i)] * gradient.row(rows[i]).transpose();
    out.step = -inverse * slope;
    const Eigen::VectorXd linear = f + gradient * out.step;
    double level = -1e300;
    for (const Eigen::Index row : rows) level = std::max(level, linear[row]);
    Eigen::Index highest = 0;
    out.level = linear.maxCoeff(&highest);
    const bool known = std::ranges::find(rows, highest) != rows.end();
    if (known || out.level <= level + enough * (1.0 + std::abs(level)) || rows.size() == most_rows) break;
    rows.push_back(highest);
    weight.conservativeResize(weight.size() + 1);
    weight[weight.size() - 1] = 0.0;
  }
  out.weight = Eigen::VectorXd::Zero(f.size());
  for (std::size_t i = 0; i < rows.size(); ++i) out.weight[rows[i]] = weight[static_cast<Eigen::Index>(i)];
  return out;
}

}  // namespace ninedof
