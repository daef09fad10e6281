#include "limits/box_system.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace ninedof {
namespace {

constexpr double upward = 1.0 + 0x1p-40;  // more than the roundings of a few hundred positive terms

Eigen::Index index(std::size_t k) {
  return static_cast<Eigen::Index>(k);
}

/// The sum of nine forms with these factors, which is faster than form by form.
template <class T, class Forms>
T sum(const Vec9& factors, const Forms& forms_of) {
  T out;
  double moduli = 0.0;
  for (std::size_t k = 0; k < 9; ++k) {
    const T& f = forms_of(k);
    const double factor = factors[index(k)];
    double size = std::abs(f.c);
    out.c += factor * f.c;
    for (std::size_t n = 0; n < T::size; ++n) {
      out.a[n] += factor * f.a[n];
      size += std::abs(f.a[n]);
    }
    out.r += std::abs(factor) * f.r;
    moduli += std::abs(factor) * size;
  }
  out.r = (out.r + forms::grain * moduli) * (1.0 + forms::grain) + forms::tiny;
  return out;
}

template <class T>
double most_of(const T& f) {
  return std::max(upper(f), -lower(f));
}

}  // namespace

template <class T>
BoxSystem<T>::BoxSystem(const Nine<Nine<T>>& h) : h_(h) {
  Mat9 middle;
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j) middle(index(i), index(j)) = h_[i][j].c;
  inverse_ = middle.inverse();
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j) {
      const T seen = sum<T>(inverse_.row(index(i)), [&](std::size_t k) -> auto& { return h_[k][j]; });
      error_(index(i), index(j)) = most_of(T(i == j ? 1.0 : 0.0) - seen);
    }
  // Near the eigenvector of the greatest eigenvalue: the norm that it weighs is the least.
  weight_.setOnes();
  for (int n = 0; n < 4; ++n) {
    weight_ = error_.lazyProduct(weight_).eval();
    weight_.array() += 0.01 * weight_.maxCoeff() + forms::tiny;
    weight_ /= weight_.maxCoeff();
  }
  moved_ = upward * error_.lazyProduct(weight_);
  shrinks_ = moved_.allFinite() ? upward * moved_.cwiseQuotient(weight_).maxCoeff() : 1.0;
}

template <class T>
T BoxSystem<T>::component(int k, const Nine<T>& b) const {
  if (!(shrinks_ < 1.0)) return T::unknown();
  Vec9 middle;
  for (std::size_t i = 0; i < 9; ++i) middle[index(i)] = b[i].c;
  const Vec9 x = inverse_.transpose().lazyProduct(middle), y = inverse_.col(k);
  Nine<T> left_of_b, left_of_unit;
  for (std::size_t i = 0; i < 9; ++i) {
    left_of_b[i] = b[i] - sum<T>(x, [&](std::size_t j) -> auto& { return h_[j][i]; });
    left_of_unit[i] = T(index(i) == k ? 1.0 : 0.0) - sum<T>(y, [&](std::size_t j) -> auto& { return h_[i][j]; });
  }
  T out = T(x[k]) + sum<T>(y, [&](std::size_t i) -> auto& { return left_of_b[i]; });
  // z = h^-1 (e_k - A^T y) is first + E z, so that |z| <= |first| + |E| z, and in the norm of weight_ at most `most`.
  Vec9 first, most_of_b;
  for (std::size_t i = 0; i < 9; ++i) {
    first[index(i)] = most_of(sum<T>(inverse_.row(index(i)), [&](std::size_t j) -> auto& { return left_of_unit[j]; }));
    most_of_b[index(i)] = most_of(left_of_b[i]);
  }
  const double most = first.cwiseQuotient(weight_).maxCoeff() / (1.0 - shrinks_);
  out.r += upward * upward * most_of_b.dot(first + most * moved_) + forms::tiny;
  return out;
}

template <class T>
Nine<Nine<T>> BoxSystem<T>::inverse() const {
  Nine<Nine<T>> out, seen;
  if (!(shrinks_ < 1.0)) {
    for (Nine<T>& row : out) row.fill(T::unknown());
    return out;
  }
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j)
      seen[i][j] =
          T(i == j ? 2.0 : 0.0) - sum<T>(inverse_.row(index(i)), [&](std::size_t k) -> auto& { return h_[k][j]; });
  for (std::size_t j = 0; j < 9; ++j) {
    // |h^-1| is at most |inverse_| + |E| |h^-1|, as in `component`.
    const Vec9 column = inverse_.col(index(j)).cwiseAbs();
    const double most = column.cwiseQuotient(weight_).maxCoeff() / (1.0 - shrinks_);
    const Vec9 rest = error_.lazyProduct(Vec9(error_.lazyProduct(Vec9(column + most * moved_))));
    for (std::size_t i = 0; i < 9; ++i) {
      out[i][j] = sum<T>(inverse_.col(index(j)), [&](std::size_t k) -> auto& { return seen[i][k]; });
      out[i][j].r += upward * upward * rest[index(i)] + forms::tiny;
    }
  }
  return out;
}

template class BoxSystem<PoseForm>;
template class BoxSystem<DesignForm>;

}  // namespace ninedof
