#pragma once
/// Householder reflections of small matrices, twice as fast as Eigen's: the length of every loop is a constant.

#include <cmath>

#include "ninedof/math/types.hpp"

namespace ninedof {

/// The reflection 1 - beta v v^T that maps rows k and below of a column to (image, 0, 0, ...) and keeps the rows above.
template <int Rows>
struct Reflection {
  static_assert(Rows % 4 == 0, "pad with rows of zeros");
  Eigen::Index k = 0;
  Eigen::Matrix<double, Rows, 1> v;  ///< zero above row k
  double beta = 0.0;
  double image = 0.0;

  Reflection() = default;

  /// The column must have an entry other than zero in row `row` or below.
  Reflection(const Eigen::Matrix<double, Rows, 1>& column, Eigen::Index row) : k(row), v(column) {
    v.head(k).setZero();
    const double norm = std::copysign(v.norm(), v[k]);  // with this sign nothing cancels in the next line
    v[k] += norm;
    beta = 1.0 / (norm * v[k]);
    image = -norm;
  }
};

namespace detail {

/// Reflects columns of Rows numbers, Stride numbers apart; v starts with `zeros` zeros.
template <int Rows, int Stride>
void reflect(const double* v, double beta, Eigen::Index zeros, double* a, Eigen::Index columns) {
  if constexpr (Rows > 4)
    if (zeros >= 4) return reflect<Rows - 4, Stride>(v + 4, beta, zeros - 4, a + 4, columns);
  using Column = Eigen::Matrix<double, Rows, 1>;
  const Eigen::Map<const Column> direction(v);
  for (Eigen::Index j = 0; j < columns; ++j) {
    Eigen::Map<Column> column(a + j * Stride);
    column -= (beta * direction.dot(column)) * direction;
  }
}

}  // namespace detail

/// Reflects the columns of m from `first` on.
template <int Rows, int Columns>
void reflect(const Reflection<Rows>& r, Eigen::Matrix<double, Rows, Columns>& m, Eigen::Index first) {
  detail::reflect<Rows, Rows>(r.v.data(), r.beta, r.k, m.data() + first * Rows, Columns - first);
}

}  // namespace ninedof
