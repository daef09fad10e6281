#include "motion/cubic_spline.hpp"

#include <algorithm>

namespace ninedof {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// A tridiagonal system with dominant diagonal, which needs no pivots. Row k: below[k] x[k-1] + diagonal[k] x[k] +
/// above[k] x[k+1] = right[k].
struct Tridiagonal {
  explicit Tridiagonal(Eigen::Index n) : below(n), diagonal(n), above(n), right(Rows::Zero(n, 4)) {}

  Rows solved() {
    const Eigen::Index n = diagonal.size();
    for (Eigen::Index k = 1; k < n; ++k) {
      const double factor = below[k] / diagonal[k - 1];
      diagonal[k] -= factor * above[k - 1];
      right.row(k) -= factor * right.row(k - 1);
    }
    right.row(n - 1) /= diagonal[n - 1];
    for (Eigen::Index k = n - 1; k-- > 0;) right.row(k) = (right.row(k) - above[k] * right.row(k + 1)) / diagonal[k];
    return right;
  }

  Eigen::VectorXd below, diagonal, above;
  Rows right;
};

/// The second derivatives at the knots, for steps h and slopes between the knots. Those at the inner knots follow from
/// those at the ends, which the conditions there give.
std::vector<Vec3> second_derivatives(std::span<const double> h, std::span<const Vec3> slope, bool periodic) {
  const auto n = static_cast<Eigen::Index>(h.size()) - 1;  // inner knots
  const double first = h.front(), last = h.back(), second = h[1], before = h[h.size() - 2];
  Tridiagonal system(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t i = at_index(k);
    system.below[k] = h[i];
    system.diagonal[k] = 2.0 * (h[i] + h[i + 1]);
    system.above[k] = h[i + 1];
    system.right.row(k).head<3>() = 6.0 * (slope[i + 1] - slope[i]);
  }
  if (periodic) {  // the fourth column: what one unit of the second derivative at both ends takes from the others
    system.right(0, 3) += first;
    system.right(n - 1, 3) += last;
  } else {  // bend[0] = bend[1] + first / second (bend[1] - bend[2]), and likewise at the other end
    system.diagonal[0] += first * (1.0 + first / second);
    system.above[0] -= first * first / second;
    system.diagonal[n - 1] += last * (1.0 + last / before);
    system.below[n - 1] -= last * last / before;
  }
  const Rows x = system.solved();
  std::vector<Vec3> bend(h.size() + 1);
  const auto inner = [&](Eigen::Index k) -> Vec3 { return x.row(k).head<3>(); };
  if (periodic) {
    const Vec3 right = 6.0 * (slope.front() - slope.back()) - first * inner(0) - last * inner(n - 1);
    bend.front() = right / (2.0 * (first + last) - first * x(0, 3) - last * x(n - 1, 3));
    for (Eigen::Index k = 0; k < n; ++k) bend[at_index(k + 1)] = inner(k) - x(k, 3) * bend.front();
    bend.back() = bend.front();
  } else {
    for (Eigen::Index k = 0; k < n; ++k) bend[at_index(k + 1)] = inner(k);
    bend.front() = inner(0) + first / second * (inner(0) - inner(1));
    bend.back() = inner(n - 1) + last / before * (inner(n - 1) - inner(n - 2));
  }
  return bend;
}

}  // namespace

std::vector<Vec3> cubic_spline(std::span<const double> x, std::span<const Vec3> y, std::span<const double> at,
                               bool periodic) {
  std::vector<double> h;
  std::vector<Vec3> slope;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    h.push_back(x[k + 1] - x[k]);
    slope.push_back((y[k + 1] - y[k]) / h[k]);
  }
  const std::vector<Vec3> bend = second_derivatives(h, slope, periodic);
  std::vector<Vec3> out;
  for (const double t : at) {
    const auto after = std::upper_bound(x.begin() + 1, x.end() - 1, t);
    const std::size_t k = at_index(after - x.begin()) - 1;
    const double a = x[k + 1] - t, b = t - x[k];
    const Vec3 cubic = (bend[k] * (a * a * a) + bend[k + 1] * (b * b * b)) / (6.0 * h[k]);
    out.push_back(cubic + (y[k] / h[k] - bend[k] * h[k] / 6.0) * a + (y[k + 1] / h[k] - bend[k + 1] * h[k] / 6.0) * b);
  }
  return out;
}

}  // namespace ninedof
