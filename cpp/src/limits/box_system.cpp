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

/// The sum of nine products: those of the same two coordinates are added before their moduli are.
template <class T>
T product(const Nine<T>& x, const Nine<T>& y) {
  T out;
  std::array<std::array<double, T::size>, T::size> bends{};
  double moduli = 0.0, rest = 0.0;
  for (std::size_t i = 0; i < 9; ++i) {
    const double x_most = std::abs(x[i].c) + spread(x[i]), y_most = std::abs(y[i].c) + spread(y[i]);
    out.c += x[i].c * y[i].c;
    for (std::size_t k = 0; k < T::size; ++k) {
      out.a[k] += x[i].c * y[i].a[k] + y[i].c * x[i].a[k];
      for (std::size_t l = 0; l < T::size; ++l) bends[k][l] += x[i].a[k] * y[i].a[l];
    }
    rest += x_most * y[i].r + y_most * x[i].r + x[i].r * y[i].r;
    moduli += x_most * y_most;
  }
  for (std::size_t k = 0; k < T::size; ++k) {
    out.c += 0.5 * bends[k][k];  // of t_k^2, which is 1/2 within 1/2
    rest += 0.5 * std::abs(bends[k][k]);
    for (std::size_t l = 0; l < k; ++l) rest += std::abs(bends[k][l] + bends[l][k]);
  }
  out.r = upward * (rest + 2.0 * forms::grain * moduli) + forms::tiny;
  return out;
}

/// A matrix of a number of each form.
template <class T, class Number>
Mat9 matrix_of(const Nine<Nine<T>>& f, const Number& number) {
  Mat9 out;
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j) out(index(i), index(j)) = number(f[i][j]);
  return out;
}

template <class T>
double most_of(const T& f) {
  return upward * (std::abs(f.c) + radius(f));
}

}  // namespace

template <class T>
BoxSystem<T>::BoxSystem(const Nine<Nine<T>>& h) : h_(h) {
  inverse_ = matrix_of(h_, [](const T& f) { return f.c; }).inverse();
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j) {
      const T seen = sum<T>(inverse_.row(index(i)), [&](std::size_t k) -> auto& { return h_[k][j]; });
      e_[i][j] = T(i == j ? 1.0 : 0.0) - seen;
      error_(index(i), index(j)) = most_of(e_[i][j]);
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
  // z = h^-1 (e_k - A^T y) is first + E z, so that |z| is in the norm of weight_ at most `most`.
  Nine<T> first;
  Vec9 most_of_first, most_of_b;
  for (std::size_t i = 0; i < 9; ++i) {
    first[i] = sum<T>(inverse_.row(index(i)), [&](std::size_t j) -> auto& { return left_of_unit[j]; });
    most_of_first[index(i)] = most_of(first[i]);
    most_of_b[index(i)] = most_of(left_of_b[i]);
  }
  const double most = most_of_first.cwiseQuotient(weight_).maxCoeff() / (1.0 - shrinks_);
  T out = T(x[k]) + sum<T>(y, [&](std::size_t i) -> auto& { return left_of_b[i]; }) + product(first, left_of_b);
  out.r += upward * upward * most * most_of_b.dot(moved_) + forms::tiny;
  return out;
}

template <class T>
Mat9 BoxSystem<T>::slopes(std::size_t coordinate) const {
  return matrix_of(e_, [&](const T& f) { return f.a[coordinate]; });
}

template <class T>
std::array<double, T::size> BoxSystem<T>::moves() const {
  std::array<double, T::size> out{};
  if (!moved_.allFinite()) return out;
  for (std::size_t k = 0; k < T::size; ++k)
    out[k] = slopes(k).cwiseAbs().lazyProduct(weight_).cwiseQuotient(weight_).maxCoeff();
  return out;
}

template <class T>
Nine<Nine<T>> BoxSystem<T>::inverse() const {
  Nine<Nine<T>> out;
  if (!(shrinks_ < 1.0)) {
    for (Nine<T>& row : out) row.fill(T::unknown());
    return out;
  }
  // E = L + R, where L is linear: E E C = L L C + L R C + R E C.
  const Mat9 size = inverse_.cwiseAbs(), rest = matrix_of(e_, [](const T& f) { return std::abs(f.c) + f.r; });
  const Mat9 moved = error_.lazyProduct(size), open = rest.lazyProduct(size);
  Mat9 linear = Mat9::Zero(), middle = inverse_, second = Mat9::Zero();
  std::array<Mat9, T::size> slope, of_c;
  for (std::size_t k = 0; k < T::size; ++k) {
    slope[k] = slopes(k);
    of_c[k] = slope[k].lazyProduct(inverse_);
    linear += slope[k].cwiseAbs();
    const Mat9 half = 0.5 * slope[k].lazyProduct(of_c[k]);  // of t_k^2, which is 1/2 within 1/2
    middle += half;
    second += half.cwiseAbs();
    for (std::size_t l = 0; l < k; ++l)
      second += (slope[k].lazyProduct(of_c[l]) + slope[l].lazyProduct(of_c[k])).cwiseAbs();
  }
  // |h^-1| is at most |C| + |E| |h^-1|, as in `component`.
  const Mat9 all =
      size + moved_ * size.cwiseQuotient(weight_.replicate<1, 9>()).colwise().maxCoeff() / (1.0 - shrinks_);
  const Mat9 bound = second + open + linear.lazyProduct(open) + rest.lazyProduct(moved) +
                     error_.lazyProduct(error_.lazyProduct(error_.lazyProduct(all).eval()).eval()) +
                     2.0 * forms::grain * (size + moved + error_.lazyProduct(moved));
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j) {
      T& f = out[i][j];
      f.c = middle(index(i), index(j));
      for (std::size_t k = 0; k < T::size; ++k) f.a[k] = of_c[k](index(i), index(j));
      f.r = upward * upward * bound(index(i), index(j)) + forms::tiny;
    }
  return out;
}

template class BoxSystem<PoseForm>;
template class BoxSystem<DesignForm>;

}  // namespace ninedof
