#include "math/linear/svd6.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace ninedof {
namespace {

/// Five rounds of three disjoint column pairs, each once in a sweep: the processor overlaps the rotations of a round.
constexpr std::array<std::array<std::array<int, 2>, 3>, 5> rounds{{
    {{{0, 5}, {1, 4}, {2, 3}}},
    {{{0, 4}, {5, 3}, {1, 2}}},
    {{{0, 3}, {4, 2}, {5, 1}}},
    {{{0, 2}, {3, 1}, {4, 5}}},
    {{{0, 1}, {2, 5}, {3, 4}}},
}};

constexpr int max_sweeps = 30;             // five to eight suffice
constexpr double orthogonal = 1e-31;         // squared cosine below rounding: no rotation
constexpr double nearly_orthogonal = 1e-17;  // squared cosine that the next rotation takes below rounding

/// Columns of the matrix, each times the square root of its weight. With separate weights (Gentleman's fast rotations)
/// the normalization of a rotation, a square root and a division, is not on the chain of dependent operations.
///
/// Rows beyond the sixth are rotated along: the identity there becomes the right singular vectors.
template <int Rows>
struct WeightedColumns {
  Eigen::Matrix<double, Rows, 6> columns;
  Vec6 weights = Vec6::Ones();
  Vec6 squared_norms = Vec6::Zero();

  auto head(int k) const { return columns.col(k).template head<6>(); }

  void refresh_norms() {
    squared_norms = weights.cwiseProduct(columns.template topRows<6>().colwise().squaredNorm().transpose());
  }

  /// Makes columns i and j orthogonal; returns whether they were far from orthogonal.
  bool rotate(int i, int j) {
    const double dot = head(i).dot(head(j));
    const double product = weights[i] * weights[j];
    const double ab2 = product * dot * dot;
    const double aa = squared_norms[i], bb = squared_norms[j];
    if (ab2 <= orthogonal * aa * bb) return false;
    const double difference = bb - aa;
    const double denominator = std::abs(difference) + std::sqrt(difference * difference + 4.0 * ab2);
    const double g = std::copysign(2.0, difference) * dot / denominator;  // tan(angle) / sqrt(weights[i] weights[j])
    const double ti = g * weights[j], tj = g * weights[i];
    const Eigen::Matrix<double, Rows, 1> old = columns.col(i);
    columns.col(i) -= ti * columns.col(j);
    columns.col(j) += tj * old;
    const double cosine2 = 1.0 / (1.0 + ti * tj);
    weights[i] *= cosine2;
    weights[j] *= cosine2;
    const double moved = g * product * dot;
    squared_norms[i] = aa - moved;
    squared_norms[j] = bb + moved;
    return ab2 > nearly_orthogonal * aa * bb;
  }

  void sweep_until_orthogonal() {
    bool far = true;
    for (int sweep = 0; far && sweep < max_sweeps; ++sweep) {
      far = false;
      refresh_norms();
      for (const auto& round : rounds)
        for (const auto& [i, j] : round) far |= rotate(i, j);
    }
    refresh_norms();
  }
};

}  // namespace

Vec6 singular_values_6x6(const Mat6& input) {
  const double scale = input.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (scale == 0.0) return Vec6::Zero();
  if (!std::isfinite(scale)) return Vec6::Constant(scale);
  WeightedColumns<6> w{input / scale};
  w.sweep_until_orthogonal();
  Vec6 sigma = scale * w.squared_norms.cwiseSqrt();
  std::sort(sigma.begin(), sigma.end(), std::greater<>());
  return sigma;
}

RightSvd<6> right_svd_6x6(const Mat6& input) {
  const double scale = input.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (scale == 0.0) return {Vec6::Zero(), Mat6::Identity()};
  if (!std::isfinite(scale)) return {Vec6::Constant(scale), Mat6::Constant(scale - scale)};
  WeightedColumns<12> w;
  w.columns << input / scale, Mat6::Identity();
  w.sweep_until_orthogonal();
  std::array<int, 6> order{0, 1, 2, 3, 4, 5};
  // Not std::stable_sort: it allocates.
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return w.squared_norms[a] > w.squared_norms[b] || (w.squared_norms[a] == w.squared_norms[b] && a < b);
  });
  RightSvd<6> out;
  for (Eigen::Index k = 0; k < 6; ++k) {
    const int from = order[at_index(k)];
    out.sigma[k] = scale * std::sqrt(w.squared_norms[from]);
    out.v.col(k) = w.columns.col(from).tail<6>() * std::sqrt(w.weights[from]);
  }
  return out;
}

}  // namespace ninedof
