#include "math/linear/jacobi_svd.hpp"

#include <Eigen/Jacobi>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

using Rotation = Eigen::JacobiRotation<double>;
constexpr double smallest = std::numeric_limits<double>::min();

/// Square matrices of n columns, one after the other.
struct Work {
  Eigen::Index n;
  double* a;  ///< is made diagonal
  double* u;  ///< gets the rotations of the rows; may be null
  double* v;  ///< gets the rotations of the columns
};

/// x, y := c x + s y, c y - s x for the n numbers from x and from y on, `step` apart.
void rotate(double* x, double* y, Eigen::Index n, Eigen::Index step, Rotation r) {
  if (r.c() == 1.0 && r.s() == 0.0) return;
  for (Eigen::Index i = 0; i < n * step; i += step) {
    const double old = x[i];
    x[i] = r.c() * old + r.s() * y[i];
    y[i] = r.c() * y[i] - r.s() * old;
  }
}

/// Makes the entries (p, q) and (q, p) zero.
void rotate_pair(const Work& w, Eigen::Index p, Eigen::Index q) {
  const Eigen::Index n = w.n;
  double pp = w.a[p + p * n], pq = w.a[p + q * n], qp = w.a[q + p * n], qq = w.a[q + q * n];
  // First a rotation that makes the 2x2 block symmetric, then the one that makes it diagonal.
  Rotation symmetric(1.0, 0.0);
  if (std::abs(qp - pq) >= smallest) {
    const double ratio = (pp + qq) / (qp - pq), length = std::sqrt(1.0 + ratio * ratio);
    symmetric = Rotation(ratio / length, 1.0 / length);
  }
  rotate(&pp, &qp, 1, 1, symmetric);
  rotate(&pq, &qq, 1, 1, symmetric);
  Rotation right;
  right.makeJacobi(pp, pq, qq);
  const Rotation left = symmetric * right.transpose();
  rotate(w.a + p, w.a + q, n, n, left);
  if (w.u) rotate(w.u + p * n, w.u + q * n, n, 1, left);
  rotate(w.a + p * n, w.a + q * n, n, 1, right.transpose());
  rotate(w.v + p * n, w.v + q * n, n, 1, right.transpose());
}

void diagonalize(const Work& w) {
  const Eigen::Index n = w.n;
  const auto size = [&w](Eigen::Index i, Eigen::Index j) { return std::abs(w.a[i + j * w.n]); };
  double largest = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) largest = std::max(largest, size(i, i));
  for (bool finished = false; !finished;) {
    finished = true;
    for (Eigen::Index p = 1; p < n; ++p)
      for (Eigen::Index q = 0; q < p; ++q) {
        const double zero = std::max(smallest, 2.0 * eps * largest);
        if (!(size(p, q) > zero || size(q, p) > zero)) continue;
        finished = false;
        rotate_pair(w, p, q);
        largest = std::max({largest, size(p, p), size(q, q)});
      }
  }
}

/// The singular values of `scale` times the matrix in `w`, descending, with the columns of U and V in the same order.
void decompose(const Work& w, double scale, double* sigma) {
  diagonalize(w);
  const Eigen::Index n = w.n;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double value = w.a[i + i * n];
    sigma[i] = std::abs(value) * scale;
    if (w.u && value < 0.0) std::transform(w.u + i * n, w.u + (i + 1) * n, w.u + i * n, std::negate<>());
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index k = std::max_element(sigma + i, sigma + n) - sigma;
    if (sigma[k] == 0.0) break;
    if (k == i) continue;
    std::swap(sigma[i], sigma[k]);
    if (w.u) std::swap_ranges(w.u + i * n, w.u + (i + 1) * n, w.u + k * n);
    std::swap_ranges(w.v + i * n, w.v + (i + 1) * n, w.v + k * n);
  }
}

/// What to divide a matrix by so that nothing overflows; NaN if an entry is not finite.
template <class M>
double scale_of(const M& a) {
  if (!a.allFinite()) return not_a_number;
  const double largest = a.size() == 0 ? 0.0 : a.cwiseAbs().maxCoeff();
  return largest == 0.0 ? 1.0 : largest;
}

template <int N>
Svd<N> decomposed(const Eigen::Matrix<double, N, N>& a) {
  using Square = Eigen::Matrix<double, N, N>;
  Svd<N> out{Eigen::Matrix<double, N, 1>(a.rows()), Square::Identity(a.rows(), a.rows()),
             Square::Identity(a.rows(), a.rows())};
  const double scale = scale_of(a);
  Square work = a / scale;
  if (std::isnan(scale)) {
    out.sigma.setConstant(scale);
    out.u.setConstant(scale);
    out.v.setConstant(scale);
  } else {
    decompose({a.rows(), work.data(), out.u.data(), out.v.data()}, scale, out.sigma.data());
  }
  return out;
}

template <int Rows, int N>
RightSvd<N> right_decomposed(const Eigen::Matrix<double, Rows, N>& a) {
  using Square = Eigen::Matrix<double, N, N>;
  const double scale = scale_of(a);
  if (std::isnan(scale)) return {Eigen::Matrix<double, N, 1>::Constant(scale), Square::Constant(scale)};
  RightSvd<N> out;
  Square work;
  if constexpr (Rows == N) {
    work = a / scale;
    out.v.setIdentity();
  } else {
    const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Rows, N>> qr(a / scale);
    work = qr.matrixQR().template topRows<N>().template triangularView<Eigen::Upper>();
    out.v = qr.colsPermutation();
  }
  decompose({N, work.data(), nullptr, out.v.data()}, scale, out.sigma.data());
  return out;
}

}  // namespace

template <int N>
Eigen::Index Svd<N>::rank(double threshold) const {
  const double least = std::max(threshold * sigma[0], smallest);
  return std::count_if(sigma.begin(), sigma.end(), [least](double s) { return s >= least; });
}
template Eigen::Index Svd<3>::rank(double) const;
template Eigen::Index Svd<9>::rank(double) const;

Svd<3> jacobi_svd(const Mat3& a) {
  return decomposed(a);
}
Svd<6> jacobi_svd(const Mat6& a) {
  return decomposed(a);
}
Svd<9> jacobi_svd(const Mat9& a) {
  return decomposed(a);
}
RightSvd<6> jacobi_right_svd(const Mat6& a) {
  return right_decomposed(a);
}
RightSvd<9> jacobi_right_svd(const Eigen::Matrix<double, 27, 9>& a) {
  return right_decomposed(a);
}
RightSvd<3> jacobi_right_svd(const Mat93& a) {
  return right_decomposed(a);
}

Eigen::MatrixXd nearest_orthogonal(const Eigen::MatrixXd& square) {
  const Svd<Eigen::Dynamic> svd = decomposed(square);
  return svd.u.lazyProduct(svd.v.transpose());  // a product for large matrices takes seconds to compile
}

}  // namespace ninedof
