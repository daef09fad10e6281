#include "math/linear/least_squares.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

using Index = Eigen::Index;
using Vector = Eigen::Ref<Eigen::VectorXd>;

/// A factorization of Eigen's without its size, so that what follows is compiled once for each storage order. The same
/// steps as Eigen's, which also instantiates blocked forms for 48 columns or more, at seconds of compile time each.
template <int Order>
struct Factors {
  Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Order>, 0, Eigen::OuterStride<>> packed;
  const double* tau;
  Index rank;
};

template <class Matrix>
auto factors(const Matrix& packed, const double* tau, Index rank) {
  constexpr int order = Matrix::IsRowMajor ? Eigen::RowMajor : Eigen::ColMajor;
  return Factors<order>{
      {packed.data(), packed.rows(), packed.cols(), Eigen::OuterStride<>(packed.outerStride())}, tau, rank};
}

/// (first, rest) := (1 - tau h h^T) (first, rest) with h = (1, essential).
template <class Essential>
void reflect(const Essential& essential, double tau, double& first, Vector rest) {
  if (tau == 0.0) return;
  const double along = essential.dot(rest) + first;
  first -= tau * along;
  rest -= along * (tau * essential);
}

/// The first entries of b := R^-1 Q^T b, as many as the rank.
template <int Order>
void solve_triangular(const Factors<Order>& f, Vector b) {
  for (Index k = 0; k < f.rank; ++k) {
    const Index below = b.size() - k - 1;
    reflect(f.packed.col(k).tail(below), f.tau[k], b[k], b.tail(below));
  }
  f.packed.topLeftCorner(f.rank, f.rank).template triangularView<Eigen::Upper>().solveInPlace(b.head(f.rank));
}

template <class Qr, class B>
auto solve_pivoted(const Qr& qr, B b) {
  const Index rank = qr.nonzeroPivots();
  Eigen::Matrix<double, Qr::ColsAtCompileTime, 1> out(qr.cols());
  out.setZero();
  if (rank == 0) return out;
  solve_triangular(factors(qr.matrixQR(), qr.hCoeffs().data(), rank), b);
  for (Index i = 0; i < rank; ++i) out[qr.colsPermutation().indices()[i]] = b[i];
  return out;
}

/// y := Z^T (y of the first `rank` entries, 0), the last step of a P = Q [T 0] Z.
template <int Order>
void complete(const Factors<Order>& f, const double* tau_z, Vector y) {
  const Index free = y.size() - f.rank;
  for (Index k = 0; k < f.rank && free > 0; ++k) {
    std::swap(y[k], y[f.rank - 1]);
    reflect(f.packed.row(k).tail(free).transpose(), tau_z[k], y[f.rank - 1], y.tail(free));
    std::swap(y[k], y[f.rank - 1]);
  }
}

template <class A, class B>
auto solve_least_norm(const A& a, B b) {
  const Eigen::CompleteOrthogonalDecomposition<A> d(a);
  Eigen::Matrix<double, A::ColsAtCompileTime, 1> y(d.cols()), out(d.cols());
  y.setZero();
  if (d.rank() == 0) return y;
  const auto f = factors(d.matrixQTZ(), d.hCoeffs().data(), d.rank());
  solve_triangular(f, b);
  y.head(d.rank()) = b.head(d.rank());
  complete(f, d.zCoeffs().data(), y);
  for (Index i = 0; i < d.cols(); ++i) out[d.colsPermutation().indices()[i]] = y[i];
  return out;
}

template <int Kept>
Eigen::Matrix<double, 9, Kept> eliminated(const Mat93& free, const Eigen::Matrix<double, 9, Kept>& kept) {
  Eigen::ColPivHouseholderQR<Mat93> qr(free);
  qr.setThreshold(negligible);
  Eigen::Matrix<double, 9, Kept> x = kept;
  Eigen::Matrix<double, 1, Kept> workspace;
  for (Index k = 0; k < 3; ++k)
    x.bottomRows(9 - k).applyHouseholderOnTheLeft(qr.matrixQR().col(k).tail(8 - k), qr.hCoeffs()[k], workspace.data());
  x.topRows(qr.rank()).setZero();
  return x;
}

}  // namespace

Mat96 eliminate(const Mat93& free, const Mat96& kept) {
  return eliminated(free, kept);
}
Mat93 eliminate(const Mat93& free, const Mat93& kept) {
  return eliminated(free, kept);
}

Mat6 triangular_factor(const Mat96& x) {
  Mat96 out = x;
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

Eigen::MatrixXd solve_definite(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.ldlt().solve(b);
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

Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Index n = a.cols();
  Eigen::VectorXd w = Eigen::VectorXd::Zero(n);
  if (n == 0) return w;
  const Eigen::VectorXd norms = a.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
  std::vector<Index> passive;  // weights that may be positive
  const auto unconstrained = [&] {
    Eigen::MatrixXd sub(a.rows(), static_cast<Index>(passive.size()));
    for (std::size_t k = 0; k < passive.size(); ++k) sub.col(static_cast<Index>(k)) = a.col(passive[k]);
    return least_squares(sub, b);
  };
  for (Index outer = 0; outer < 3 * n + 10; ++outer) {
    // Cosines between the residual and the columns: scale-free, so that the smallest residual is still worked on.
    const Eigen::VectorXd residual = b - a * w;
    Eigen::VectorXd descent = (a.transpose() * residual).cwiseQuotient(norms);
    for (const Index k : passive) descent[k] = 0.0;
    Index enter = 0;
    if (descent.maxCoeff(&enter) <= 1e-10 * residual.norm()) break;
    passive.push_back(enter);
    while (!passive.empty()) {
      const Eigen::VectorXd trial = unconstrained();
      double step = 1.0;
      Index limiting = -1;
      for (std::size_t k = 0; k < passive.size(); ++k) {
        const double now = w[passive[k]], next = trial[static_cast<Index>(k)];
        if (!(next <= 0.0 && now > next && now / (now - next) < step)) continue;
        step = now / (now - next);
        limiting = passive[k];
      }
      for (std::size_t k = 0; k < passive.size(); ++k)
        w[passive[k]] += step * (trial[static_cast<Index>(k)] - w[passive[k]]);
      if (limiting < 0) break;
      // The weight that set the step is zero now, whatever rounding has left of it.
      std::erase_if(passive, [&](Index k) {
        const bool gone = k == limiting || w[k] <= 1e-15;
        if (gone) w[k] = 0.0;
        return gone;
      });
    }
  }
  return w.cwiseMax(0.0);
}

}  // namespace ninedof
