#include "motion/cubic_spline.hpp"

#include <algorithm>

namespace ninedof {
namespace {

/// The second derivatives at the knots, for the steps h and the slopes between them: a tridiagonal system for those at
/// the inner knots, from which those at the ends follow.
Eigen::Matrix3Xd second_derivatives(const Eigen::VectorXd& h, const Eigen::Matrix3Xd& slope, bool periodic) {
  const Eigen::Index n = h.size() - 1;  // inner knots
  const double first = h[0], second = h[1], before = h[n - 1], last = h[n];
  Eigen::VectorXd below = h.head(n), above = h.tail(n), diagonal = 2.0 * (below + above);
  // One column for each knot. Fourth row: what a second derivative of 1 at both ends takes from the others.
  Eigen::Matrix<double, 4, Eigen::Dynamic> x = Eigen::Matrix4Xd::Zero(4, n + 2);
  x.block(0, 1, 3, n) = 6.0 * (slope.rightCols(n) - slope.leftCols(n));
  if (periodic) {
    x(3, 1) += first;
    x(3, n) += last;
  } else {  // x_0 = x_1 + first / second (x_1 - x_2), and likewise at the other end
    diagonal[0] += first * (1.0 + first / second);
    above[0] -= first * first / second;
    diagonal[n - 1] += last * (1.0 + last / before);
    below[n - 1] -= last * last / before;
  }
  for (Eigen::Index k = 1; k < n; ++k) {  // the diagonal is dominant: no pivots
    const double factor = below[k] / diagonal[k - 1];
    diagonal[k] -= factor * above[k - 1];
    x.col(k + 1) -= factor * x.col(k);
  }
  for (Eigen::Index k = n; k > 0; --k) x.col(k) = (x.col(k) - above[k - 1] * x.col(k + 1)) / diagonal[k - 1];
  if (periodic) {
    const Vec3 right = 6.0 * (slope.col(0) - slope.col(n)) - (first * x.col(1) + last * x.col(n)).head<3>();
    const Vec3 end = right / (2.0 * (first + last) - first * x(3, 1) - last * x(3, n));
    x.topRows<3>() -= end * x.row(3);
    x.col(0).head<3>() = x.col(n + 1).head<3>() = end;
  } else {
    x.col(0) = x.col(1) + first / second * (x.col(1) - x.col(2));
    x.col(n + 1) = x.col(n) + last / before * (x.col(n) - x.col(n - 1));
  }
  return x.topRows<3>();
}

}  // namespace

std::vector<Vec3> cubic_spline(std::span<const double> x, std::span<const Vec3> y, std::span<const double> at,
                               bool periodic) {
  const auto n = static_cast<Eigen::Index>(x.size()) - 1;  // pieces
  const Eigen::Map<const Eigen::VectorXd> knots(x.data(), n + 1);
  const Eigen::Map<const Eigen::Matrix3Xd> points(y.front().data(), 3, n + 1);
  const Eigen::VectorXd h = knots.tail(n) - knots.head(n);
  const Eigen::Matrix3Xd slope = (points.rightCols(n) - points.leftCols(n)).array().rowwise() / h.transpose().array();
  const Eigen::Matrix3Xd bend = second_derivatives(h, slope, periodic);
  std::vector<Vec3> out;
  for (const double t : at) {
    const Eigen::Index k = std::upper_bound(x.begin() + 1, x.end() - 1, t) - x.begin() - 1;
    const double a = knots[k + 1] - t, b = t - knots[k];
    out.push_back((bend.col(k) * (a * a * a) + bend.col(k + 1) * (b * b * b)) / (6.0 * h[k]) +
                  (points.col(k) / h[k] - bend.col(k) * h[k] / 6.0) * a +
                  (points.col(k + 1) / h[k] - bend.col(k + 1) * h[k] / 6.0) * b);
  }
  return out;
}

}  // namespace ninedof
