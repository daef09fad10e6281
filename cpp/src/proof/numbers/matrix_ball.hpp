#pragma once
/// All matrices within a distance of one matrix, the distance in the Frobenius norm.

#include <algorithm>
#include <cmath>

#include "ninedof/math/interval.hpp"
#include "ninedof/math/types.hpp"
#include "proof/numbers/exact_dot.hpp"

namespace ninedof {

/// A sum of squares from above, and its root.
class NormAbove {
 public:
  void add(double x) { sum_ = detail::above(sum_ + detail::above(x * x)); }
  double value() const { return detail::above(std::sqrt(sum_)); }

 private:
  double sum_ = 0.0;
};

/// A number at or above the Frobenius norm; infinite where an entry is NaN.
template <class Matrix>
double norm_above(const Matrix& m) {
  NormAbove norm;
  for (Eigen::Index j = 0; j < m.cols(); ++j)
    for (Eigen::Index i = 0; i < m.rows(); ++i) norm.add(m(i, j));
  return norm.value();
}

template <int Rows, int Columns>
class MatrixBall {
 public:
  Eigen::Matrix<double, Rows, Columns> middle = Eigen::Matrix<double, Rows, Columns>::Zero();

  void set(Eigen::Index i, Eigen::Index j, const Interval& x) {
    const double m = ninedof::middle(x);
    middle(i, j) = m;
    distance_.add(detail::above(std::max(x.hi - m, m - x.lo)));
  }
  /// Three entries of a row, from column j on.
  void set(Eigen::Index i, Eigen::Index j, const Xyz<Interval>& x) {
    set(i, j, x.x);
    set(i, j + 1, x.y);
    set(i, j + 2, x.z);
  }
  double radius() const { return distance_.value(); }

 private:
  NormAbove distance_;
};

/// The product of two matrices of doubles.
template <int Rows, int Inner, int Columns>
MatrixBall<Rows, Columns> exact_product(const Eigen::Matrix<double, Rows, Inner>& a,
                                        const Eigen::Matrix<double, Inner, Columns>& b) {
  MatrixBall<Rows, Columns> out;
  for (Eigen::Index i = 0; i < Rows; ++i)
    for (Eigen::Index j = 0; j < Columns; ++j) {
      DotSum sum;
      for (Eigen::Index k = 0; k < Inner; ++k) sum.product(a(i, k), b(k, j));
      out.set(i, j, sum.value());
    }
  return out;
}

/// A number at or above the norm of a b - 1.
template <int Rows, int Inner>
double distance_from_identity(const Eigen::Matrix<double, Rows, Inner>& a,
                              const Eigen::Matrix<double, Inner, Rows>& b) {
  NormAbove norm;
  for (Eigen::Index i = 0; i < Rows; ++i)
    for (Eigen::Index j = 0; j < Rows; ++j) {
      DotSum sum;
      if (i == j) sum.number(-1.0);
      for (Eigen::Index k = 0; k < Inner; ++k) sum.product(a(i, k), b(k, j));
      norm.add(magnitude(sum.value()));
    }
  return norm.value();
}

}  // namespace ninedof
