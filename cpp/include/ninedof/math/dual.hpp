#pragma once
/// Forward-mode automatic differentiation: a value and its N partial derivatives.
///
/// A formula written over a number type T gives values with T = double and exact gradients with T = Dual<N>. Over
/// intervals, Dual<N, Interval> encloses the gradients of a whole box, and Dual<N, Dual<N, Interval>> the second
/// derivatives.

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>

#include "ninedof/math/interval.hpp"

namespace ninedof {

/// A number that carries its gradient with respect to N variables through a formula.
template <int N, class S = double>
struct Dual {
  /// The gradient is padded with zeros to whole 16-byte vectors, so that loops over it have no scalar remainder.
  static constexpr std::size_t padded = std::is_same_v<S, double> ? (N + 1) / 2 * 2 : N;

  alignas(16) std::array<S, padded> gradient;
  S value;

  Dual() : Dual(S(0.0)) {}
  Dual(const S& constant) : gradient{}, value(constant) {}  // NOLINT: constants mix freely with duals in formulas
  Dual(double constant)                                      // NOLINT
    requires(!std::is_same_v<S, double>)
      : Dual(S(constant)) {}

  /// The chain rule: `v` with gradient a dx. The gradient is written once, not cleared first.
  Dual(const S& v, const S& a, const Dual& x) : value(v) {
    for (std::size_t k = 0; k < padded; ++k) gradient[k] = a * x.gradient[k];
  }
  /// `v` with gradient a dx + b dy
  Dual(const S& v, const S& a, const Dual& x, const S& b, const Dual& y) : value(v) {
    for (std::size_t k = 0; k < padded; ++k) gradient[k] = a * x.gradient[k] + b * y.gradient[k];
  }

  /// The independent variable with this index.
  static Dual variable(const S& value, int index) {
    Dual x(value);
    x.gradient[static_cast<std::size_t>(index)] = S(1.0);
    return x;
  }

  /// The N independent variables at `x`. Written in place: copying a dual number just written would stall the
  /// processor, which cannot forward two narrow stores to one wide load.
  static std::array<Dual, N> variables(std::span<const S, N> x) {
    std::array<Dual, N> out;
    for (std::size_t i = 0; i < N; ++i) {
      out[i].value = x[i];
      for (std::size_t k = 0; k < padded; ++k) out[i].gradient[k] = S(k == i ? 1.0 : 0.0);
    }
    return out;
  }
};

namespace detail {
template <class T>
struct Plain {
  using type = T;
};
template <int N, class S>
struct Plain<Dual<N, S>> : Plain<S> {};
}  // namespace detail

/// The numbers that a dual number is made of: double or Interval. The type itself for others.
template <class T>
using PlainNumber = typename detail::Plain<T>::type;

template <int N, class S>
Dual<N, S> operator+(const Dual<N, S>& a, const Dual<N, S>& b) {
  return {a.value + b.value, S(1.0), a, S(1.0), b};
}
template <int N, class S>
Dual<N, S> operator-(const Dual<N, S>& a, const Dual<N, S>& b) {
  return {a.value - b.value, S(1.0), a, S(-1.0), b};
}
template <int N, class S>
Dual<N, S> operator*(const Dual<N, S>& a, const Dual<N, S>& b) {
  return {a.value * b.value, b.value, a, a.value, b};
}
template <int N, class S>
Dual<N, S> operator/(const Dual<N, S>& a, const Dual<N, S>& b) {
  const S inverse = 1.0 / b.value;
  const S quotient = a.value * inverse;
  return {quotient, inverse, a, -quotient * inverse, b};
}
template <int N, class S>
Dual<N, S> operator-(const Dual<N, S>& a) {
  return {-a.value, S(-1.0), a};
}

// With constants, which may be plain numbers whatever S is.
template <class S>
using Constant = const std::type_identity_t<S>&;

template <int N, class S>
Dual<N, S> operator+(const Dual<N, S>& a, Constant<S> b) {
  return {a.value + b, S(1.0), a};
}
template <int N, class S>
Dual<N, S> operator+(Constant<S> a, const Dual<N, S>& b) {
  return b + a;
}
template <int N, class S>
Dual<N, S> operator-(const Dual<N, S>& a, Constant<S> b) {
  return {a.value - b, S(1.0), a};
}
template <int N, class S>
Dual<N, S> operator-(Constant<S> a, const Dual<N, S>& b) {
  return {a - b.value, S(-1.0), b};
}
template <int N, class S>
Dual<N, S> operator*(const Dual<N, S>& a, Constant<S> b) {
  return {a.value * b, b, a};
}
template <int N, class S>
Dual<N, S> operator*(Constant<S> a, const Dual<N, S>& b) {
  return b * a;
}
template <int N, class S>
Dual<N, S> operator/(const Dual<N, S>& a, Constant<S> b) {
  return {a.value / b, 1.0 / b, a};
}
template <int N, class S>
Dual<N, S> operator/(Constant<S> a, const Dual<N, S>& b) {
  const S quotient = a / b.value;
  return {quotient, -quotient / b.value, b};
}

namespace detail {

/// The slopes of the square root and of |x|. At zero, where they are infinite and undefined, they are set to 0 and 1:
/// such points are kinks or singular designs. Over an interval they enclose every slope.
inline double slope_of_root(double root) {
  return root > 0.0 ? 0.5 / root : 0.0;
}
inline double slope_of_abs(double x) {
  return x < 0.0 ? -1.0 : 1.0;
}
inline Interval slope_of_root(const Interval& root) {
  return 0.5 / root;
}
inline Interval slope_of_abs(const Interval& x) {
  return {x.lo < 0.0 ? -1.0 : 1.0, x.hi > 0.0 ? 1.0 : -1.0};
}
template <int N, class S>
Dual<N, S> slope_of_root(const Dual<N, S>& root) {
  return 0.5 / root;
}
template <int N, class S>
Dual<N, S> slope_of_abs(const Dual<N, S>& x) {
  return slope_of_abs(x.value);
}

}  // namespace detail

template <int N, class S>
Dual<N, S> sqrt(const Dual<N, S>& x) {
  using std::sqrt;
  const S root = sqrt(x.value);
  return {root, detail::slope_of_root(root), x};
}
template <int N, class S>
Dual<N, S> log(const Dual<N, S>& x) {
  using std::log;
  return {log(x.value), 1.0 / x.value, x};
}
template <int N, class S>
Dual<N, S> sin(const Dual<N, S>& x) {
  using std::cos;
  using std::sin;
  return {sin(x.value), cos(x.value), x};
}
template <int N, class S>
Dual<N, S> cos(const Dual<N, S>& x) {
  using std::cos;
  using std::sin;
  return {cos(x.value), -sin(x.value), x};
}
template <int N, class S>
Dual<N, S> abs(const Dual<N, S>& x) {
  using std::abs;
  return {abs(x.value), detail::slope_of_abs(x.value), x};
}

/// x * x, with one product for each partial derivative where operator* takes two.
inline double square(double x) {
  return x * x;
}
template <int N, class S>
Dual<N, S> square(const Dual<N, S>& x) {
  return {square(x.value), 2.0 * x.value, x};
}

/// The plain value of a number of either type.
inline double value_of(double x) {
  return x;
}
template <int N, class S>
double value_of(const Dual<N, S>& x) {
  return value_of(x.value);
}

}  // namespace ninedof
