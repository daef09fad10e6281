#pragma once
/// Forward-mode automatic differentiation: a value and its N partial derivatives.
///
/// A formula written over a number type T gives values with T = double and exact gradients with T = Dual<N>.

#include <array>
#include <cmath>

namespace ninedof {

template <int N>
struct Dual {
  double value = 0.0;
  std::array<double, N> gradient{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: constants mix freely with duals in formulas

  /// The independent variable number `index`.
  static Dual variable(double value, int index) {
    Dual x(value);
    x.gradient[static_cast<std::size_t>(index)] = 1.0;
    return x;
  }
};

namespace detail {

/// value with gradient a * da
template <int N>
Dual<N> chain(double value, double a, const Dual<N>& x) {
  Dual<N> out;
  out.value = value;
  for (std::size_t k = 0; k < N; ++k) out.gradient[k] = a * x.gradient[k];
  return out;
}

/// value with gradient a * dx + b * dy
template <int N>
Dual<N> chain(double value, double a, const Dual<N>& x, double b, const Dual<N>& y) {
  Dual<N> out;
  out.value = value;
  for (std::size_t k = 0; k < N; ++k) out.gradient[k] = a * x.gradient[k] + b * y.gradient[k];
  return out;
}

}  // namespace detail

template <int N>
Dual<N> operator+(const Dual<N>& a, const Dual<N>& b) {
  return detail::chain(a.value + b.value, 1.0, a, 1.0, b);
}
template <int N>
Dual<N> operator-(const Dual<N>& a, const Dual<N>& b) {
  return detail::chain(a.value - b.value, 1.0, a, -1.0, b);
}
template <int N>
Dual<N> operator*(const Dual<N>& a, const Dual<N>& b) {
  return detail::chain(a.value * b.value, b.value, a, a.value, b);
}
template <int N>
Dual<N> operator/(const Dual<N>& a, const Dual<N>& b) {
  const double inverse = 1.0 / b.value;
  const double quotient = a.value * inverse;
  return detail::chain(quotient, inverse, a, -quotient * inverse, b);
}
template <int N>
Dual<N> operator-(const Dual<N>& a) {
  return detail::chain(-a.value, -1.0, a);
}

template <int N>
Dual<N> operator+(const Dual<N>& a, double b) {
  return detail::chain(a.value + b, 1.0, a);
}
template <int N>
Dual<N> operator+(double a, const Dual<N>& b) {
  return b + a;
}
template <int N>
Dual<N> operator-(const Dual<N>& a, double b) {
  return detail::chain(a.value - b, 1.0, a);
}
template <int N>
Dual<N> operator-(double a, const Dual<N>& b) {
  return detail::chain(a - b.value, -1.0, b);
}
template <int N>
Dual<N> operator*(const Dual<N>& a, double b) {
  return detail::chain(a.value * b, b, a);
}
template <int N>
Dual<N> operator*(double a, const Dual<N>& b) {
  return b * a;
}
template <int N>
Dual<N> operator/(double a, const Dual<N>& b) {
  const double quotient = a / b.value;
  return detail::chain(quotient, -quotient / b.value, b);
}

/// At zero, where the slope is infinite, the derivative is given as 0: such points are kinks or singular designs.
template <int N>
Dual<N> sqrt(const Dual<N>& x) {
  const double root = std::sqrt(x.value);
  return detail::chain(root, root > 0.0 ? 0.5 / root : 0.0, x);
}
template <int N>
Dual<N> log(const Dual<N>& x) {
  return detail::chain(std::log(x.value), 1.0 / x.value, x);
}
template <int N>
Dual<N> sin(const Dual<N>& x) {
  return detail::chain(std::sin(x.value), std::cos(x.value), x);
}
template <int N>
Dual<N> cos(const Dual<N>& x) {
  return detail::chain(std::cos(x.value), -std::sin(x.value), x);
}
template <int N>
Dual<N> abs(const Dual<N>& x) {
  return x.value < 0.0 ? -x : x;
}

/// The plain value of a number of either type.
inline double value_of(double x) {
  return x;
}
template <int N>
double value_of(const Dual<N>& x) {
  return x.value;
}

}  // namespace ninedof
