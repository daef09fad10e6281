#pragma once
/// Forward-mode automatic differentiation: a value and its N partial derivatives.
///
/// A formula written over a number type T gives values with T = double and exact gradients with T = Dual<N>.

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace ninedof {

/// A number that carries its gradient with respect to N variables through a formula.
template <int N>
struct Dual {
  /// The gradient is padded with zeros to whole 16-byte vectors, so that loops over it have no scalar remainder.
  static constexpr std::size_t padded = (N + 1) / 2 * 2;

  alignas(16) std::array<double, padded> gradient;
  double value;

  Dual() : Dual(0.0) {}
  Dual(double constant) : gradient{}, value(constant) {}  // NOLINT: constants mix freely with duals in formulas

  /// The chain rule: `v` with gradient a dx. The gradient is written once, not cleared first.
  Dual(double v, double a, const Dual& x) : value(v) {
    for (std::size_t k = 0; k < padded; ++k) gradient[k] = a * x.gradient[k];
  }
  /// `v` with gradient a dx + b dy
  Dual(double v, double a, const Dual& x, double b, const Dual& y) : value(v) {
    for (std::size_t k = 0; k < padded; ++k) gradient[k] = a * x.gradient[k] + b * y.gradient[k];
  }

  /// The independent variable with this index.
  static Dual variable(double value, int index) {
    Dual x(value);
    x.gradient[static_cast<std::size_t>(index)] = 1.0;
    return x;
  }

  /// The N independent variables at `x`. Written in place: copying a dual number just written would stall the
  /// processor, which cannot forward two narrow stores to one wide load.
  static std::array<Dual, N> variables(std::span<const double, N> x) {
    std::array<Dual, N> out;
    for (std::size_t i = 0; i < N; ++i) {
      out[i].value = x[i];
      for (std::size_t k = 0; k < padded; ++k) out[i].gradient[k] = k == i ? 1.0 : 0.0;
    }
    return out;
  }
};

template <int N>
Dual<N> operator+(const Dual<N>& a, const Dual<N>& b) {
  return {a.value + b.value, 1.0, a, 1.0, b};
}
template <int N>
Dual<N> operator-(const Dual<N>& a, const Dual<N>& b) {
  return {a.value - b.value, 1.0, a, -1.0, b};
}
template <int N>
Dual<N> operator*(const Dual<N>& a, const Dual<N>& b) {
  return {a.value * b.value, b.value, a, a.value, b};
}
template <int N>
Dual<N> operator/(const Dual<N>& a, const Dual<N>& b) {
  const double inverse = 1.0 / b.value;
  const double quotient = a.value * inverse;
  return {quotient, inverse, a, -quotient * inverse, b};
}
template <int N>
Dual<N> operator-(const Dual<N>& a) {
  return {-a.value, -1.0, a};
}

template <int N>
Dual<N> operator+(const Dual<N>& a, double b) {
  return {a.value + b, 1.0, a};
}
template <int N>
Dual<N> operator+(double a, const Dual<N>& b) {
  return b + a;
}
template <int N>
Dual<N> operator-(const Dual<N>& a, double b) {
  return {a.value - b, 1.0, a};
}
template <int N>
Dual<N> operator-(double a, const Dual<N>& b) {
  return {a - b.value, -1.0, b};
}
template <int N>
Dual<N> operator*(const Dual<N>& a, double b) {
  return {a.value * b, b, a};
}
template <int N>
Dual<N> operator*(double a, const Dual<N>& b) {
  return b * a;
}
template <int N>
Dual<N> operator/(const Dual<N>& a, double b) {
  return {a.value / b, 1.0 / b, a};
}
template <int N>
Dual<N> operator/(double a, const Dual<N>& b) {
  const double quotient = a / b.value;
  return {quotient, -quotient / b.value, b};
}

/// At zero, where the slope is infinite, the derivative is set to 0: such points are kinks or singular designs.
template <int N>
Dual<N> sqrt(const Dual<N>& x) {
  const double root = std::sqrt(x.value);
  return {root, root > 0.0 ? 0.5 / root : 0.0, x};
}
template <int N>
Dual<N> log(const Dual<N>& x) {
  return {std::log(x.value), 1.0 / x.value, x};
}
template <int N>
Dual<N> sin(const Dual<N>& x) {
  return {std::sin(x.value), std::cos(x.value), x};
}
template <int N>
Dual<N> cos(const Dual<N>& x) {
  return {std::cos(x.value), -std::sin(x.value), x};
}
template <int N>
Dual<N> abs(const Dual<N>& x) {
  return x.value < 0.0 ? -x : x;
}

/// x * x, with one product for each partial derivative where operator* takes two.
inline double square(double x) {
  return x * x;
}
template <int N>
Dual<N> square(const Dual<N>& x) {
  return {x.value * x.value, 2.0 * x.value, x};
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
