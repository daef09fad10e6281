#include "math/linear/least_squares.hpp"

#include <Eigen/QR>
#include <cmath>
#include <utility>

#include "math/linear/negligible.hpp"

namespace ninedof {
namespace {

/// b := Q^T b with the first `count` reflections of a QR factorization. The same steps as householderQ() of Eigen,
/// which also instantiates a blocked form for 48 columns or more, at seconds of compile time each.
template <class Factors, class Coefficients, class B>
void apply_transposed_q(const Factors& qr, const Coefficients& h, Eigen::Index count, B& b) {
  Eigen::Matrix<double, 1, B::ColsAtCompileTime> workspace(b.cols());
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index rows = b.rows() - k;
    b.bottomRightCorner(rows, b.cols())
        .applyHouseholderOnTheLeft(qr.template block<Eigen::Dynamic, 1>(k + 1, k, rows - 1, 1), h[k], workspace.data());
  }
}

template <class Qr, class B>
auto solve_pivoted(const Qr& qr, B b) {
  const Eigen::Index pivots = qr.nonzeroPivots();
  Eigen::Matrix<double, Qr::ColsAtCompileTime, 1> out(qr.cols());
  out.setZero();
  if (pivots == 0) return out;
  apply_transposed_q(qr.matrixQR(), qr.hCoeffs(), pivots, b);
  qr.matrixQR().topLeftCorner(pivots, pivots).template triangularView<Eigen::Upper>().solveInPlace(b.topRows(pivots));
  for (Eigen::Index i = 0; i < pivots; ++i) out[qr.colsPermutation().indices()[i]] = b[i];
  return out;
}

/// a P = Q [T 0] Z: steps of Eigen's complete orthogonal decomposition, without its blocked products.
template <class A, class B>
auto solve_least_norm(const A& a, B b) {
  const Eigen::CompleteOrthogonalDecomposition<A> d(a);
  const Eigen::Index rank = d.rank(), cols = d.cols();
  Eigen::Matrix<double, A::ColsAtCompileTime, 1> y(cols);
  y.setZero();
  if (rank == 0) return y;
  apply_transposed_q(d.matrixQTZ(), d.hCoeffs(), rank, b);
  y.topRows(rank) =
      d.matrixT().topLeftCorner(rank, rank).template triangularView<Eigen::Upper>().solve(b.topRows(rank));
  double workspace = 0.0;
  for (Eigen::Index k = 0; k < rank && rank < cols; ++k) {
    std::swap(y[k], y[rank - 1]);
    y.middleRows(rank - 1, cols - rank + 1)
        .applyHouseholderOnTheLeft(d.matrixQTZ().row(k).tail(cols - rank).adjoint(), d.zCoeffs()[k], &workspace);
    std::swap(y[k], y[rank - 1]);
  }
  y = d.colsPermutation() * y;
  return y;
}

template <int Kept>
Eigen::Matrix<double, 9, Kept> eliminated(const Mat93& free, const Eigen::Matrix<double, 9, Kept>& kept) {
  Eigen::ColPivHouseholderQR<Mat93> qr(free);
  qr.setThreshold(negligible);
  Eigen::Matrix<double, 9, Kept> x = kept;
  apply_transposed_q(qr.matrixQR(), qr.hCoeffs(), 3, x);
  x.topRows(qr.rank()).setZero();
  return x;
}

}  // namespace

Eigen::Matrix<double, 9, 6> eliminate(const Mat93& free, const Eigen::Matrix<double, 9, 6>& kept) {
  return eliminated(free, kept);
}
Mat93 eliminate(const Mat93& free, const Mat93& kept) {
  return eliminated(free, kept);
}

Mat6 triangular_factor(const Eigen::Matrix<double, 9, 6>& x) {
  Eigen::Matrix<double, 9, 6> out = x;
  auto a = out.block(0, 0, 9, 6);
  Vec6 workspace;
  for (Eigen::Index k = 0; k < 6; ++k) {
    double tau = 0.0, beta = 0.0;
    a.col(k).tail(9 - k).makeHouseholderInPlace(tau, beta);
    a(k, k) = beta;
    a.bottomRightCorner(9 - k, 5 - k).applyHouseholderOnTheLeft(a.col(k).tail(8 - k), tau, workspace.data());
  }
  return out.topRows<6>().triangularView<Eigen::Upper>();
}

std::optional<Vec9> solve_regular(const Mat9& a, const Vec9& b, double least_pivot) {
  const Eigen::ColPivHouseholderQR<Mat9> qr(a);
  if (std::abs(qr.matrixQR()(8, 8)) > least_pivot * qr.maxPivot()) return solve_pivoted(qr, b);
  return {};
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return solve_pivoted(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(a), b);
}

Eigen::VectorXd least_norm(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return solve_least_norm(a, b);
}
Eigen::VectorXd least_norm_transposed(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  // Row-major, as Eigen stores a transposed matrix: another storage order sums in another order.
  return solve_least_norm(Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>(a.transpose()), b);
}
Vec3 least_norm(const Eigen::Matrix<double, 6, 3>& a, const Vec6& b) {
  return solve_least_norm(a, b);
}

}  // namespace ninedof
