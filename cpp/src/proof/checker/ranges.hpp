#pragma once
/// The checker's interval numbers: every result is widened to the neighbouring doubles.

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>

static_assert(FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 16, "doubles must not be kept in wider registers");

namespace ninedof::checker {

constexpr double inf = std::numeric_limits<double>::infinity();

/// The next double above, as std::nextafter without its call: the bits of a double are in its order, from 0 outwards.
/// Of inf and of no number it is inf.
inline double up(double x) {
  auto bits = std::bit_cast<std::int64_t>(x + 0.0);  // -0 becomes 0
  bits += (bits >> 63) | 1;
  return x < inf ? std::bit_cast<double>(bits) : inf;
}
inline double down(double x) {
  return -up(-x);
}

struct Range {
  double a = 0.0, b = 0.0;
  constexpr Range() = default;
  constexpr Range(double x) : a(x), b(x) {}  // NOLINT: numbers are ranges
  constexpr Range(double low, double high) : a(low), b(high) {}
  bool sound() const { return a <= b; }
  bool operator==(const Range&) const = default;
};

inline Range operator+(Range x, Range y) {
  return {down(x.a + y.a), up(x.b + y.b)};
}
inline Range operator-(Range x, Range y) {
  return {down(x.a - y.b), up(x.b - y.a)};
}
inline Range operator-(Range x) {
  return {-x.b, -x.a};
}
inline Range operator*(Range x, Range y) {
  if (x.a >= 0.0 && y.a >= 0.0) return {down(x.a * y.a), up(x.b * y.b)};
  const double p[] = {x.a * y.a, x.a * y.b, x.b * y.a, x.b * y.b};
  if (std::isnan(p[0] + p[1] + p[2] + p[3])) return {-inf, inf};
  return {down(*std::min_element(p, p + 4)), up(*std::max_element(p, p + 4))};
}
inline Range operator/(Range x, Range y) {
  if (x.a >= 0.0 && y.a > 0.0) return {down(x.a / y.b), up(x.b / y.a)};
  if (!(y.a > 0.0 || y.b < 0.0)) return {-inf, inf};
  const double p[] = {x.a / y.a, x.a / y.b, x.b / y.a, x.b / y.b};
  if (std::isnan(p[0] + p[1] + p[2] + p[3])) return {-inf, inf};
  return {down(*std::min_element(p, p + 4)), up(*std::max_element(p, p + 4))};
}
inline Range square(Range x) {
  const double low = x.a > 0.0 ? x.a : x.b < 0.0 ? -x.b : 0.0, high = std::max(-x.a, x.b);
  return {std::max(down(low * low), 0.0), up(high * high)};
}
inline Range root(Range x) {
  return {x.a > 0.0 ? std::max(down(std::sqrt(x.a)), 0.0) : 0.0, up(std::sqrt(std::max(x.b, 0.0)))};
}
inline Range meet(Range x, Range y) {
  return {std::max(x.a, y.a), std::min(x.b, y.b)};
}
inline Range cover(Range x, Range y) {
  return {std::min(x.a, y.a), std::max(x.b, y.b)};
}
inline double size(Range x) {
  return std::max(std::abs(x.a), std::abs(x.b));
}

/// A quantity with its slopes along the logarithms of n coordinates; of none for its values alone.
template <std::size_t n>
struct Signed {
  Range value;
  std::array<Range, n> slope;
};
/// A positive quantity with the slopes of its logarithm: products add them, and nothing is lost.
template <std::size_t n>
struct Positive {
  Range value;
  std::array<Range, n> log_slope;
};

template <std::size_t n>
Signed<n> plain(const Positive<n>& x) {
  Signed<n> out{x.value, {}};
  for (std::size_t k = 0; k < n; ++k) out.slope[k] = x.value * x.log_slope[k];
  return out;
}
template <std::size_t n>
Signed<n> operator+(const Signed<n>& x, const Signed<n>& y) {
  Signed<n> out{x.value + y.value, {}};
  for (std::size_t k = 0; k < n; ++k) out.slope[k] = x.slope[k] + y.slope[k];
  return out;
}
template <std::size_t n>
Signed<n> plus(double c, Signed<n> x) {
  x.value = c + x.value;
  return x;
}
template <std::size_t n>
Signed<n> operator*(const Signed<n>& x, const Positive<n>& y) {
  Signed<n> out{x.value * y.value, {}};
  for (std::size_t k = 0; k < n; ++k) out.slope[k] = y.value * (x.slope[k] + x.value * y.log_slope[k]);
  return out;
}
template <std::size_t n>
Signed<n> operator*(const Signed<n>& x, const Signed<n>& y) {
  Signed<n> out{x.value * y.value, {}};
  for (std::size_t k = 0; k < n; ++k) out.slope[k] = x.slope[k] * y.value + x.value * y.slope[k];
  return out;
}
template <std::size_t n>
Signed<n> operator-(const Signed<n>& x) {
  Signed<n> out{-x.value, {}};
  for (std::size_t k = 0; k < n; ++k) out.slope[k] = -x.slope[k];
  return out;
}
template <std::size_t n>
Signed<n> squared(const Signed<n>& x) {
  Signed<n> out{square(x.value), {}};
  for (std::size_t k = 0; k < n; ++k) out.slope[k] = 2.0 * x.value * x.slope[k];
  return out;
}

template <std::size_t n>
Positive<n> operator*(const Positive<n>& x, const Positive<n>& y) {
  Positive<n> out{x.value * y.value, {}};
  for (std::size_t k = 0; k < n; ++k) out.log_slope[k] = x.log_slope[k] + y.log_slope[k];
  return out;
}
template <std::size_t n>
Positive<n> operator*(double c, Positive<n> x) {
  x.value = c * x.value;
  return x;
}
template <std::size_t n>
Positive<n> inverse(const Positive<n>& x) {
  Positive<n> out{1.0 / x.value, {}};
  for (std::size_t k = 0; k < n; ++k) out.log_slope[k] = -x.log_slope[k];
  return out;
}
template <std::size_t n>
Positive<n> squared(const Positive<n>& x) {
  Positive<n> out{square(x.value), {}};
  for (std::size_t k = 0; k < n; ++k) out.log_slope[k] = 2.0 * x.log_slope[k];
  return out;
}
template <std::size_t n>
Positive<n> root(const Positive<n>& x) {
  Positive<n> out{root(x.value), {}};
  for (std::size_t k = 0; k < n; ++k) out.log_slope[k] = x.log_slope[k] / 2.0;
  return out;
}
/// The share of each summand weighs its slopes.
template <std::size_t n>
Positive<n> operator+(const Positive<n>& x, const Positive<n>& y) {
  const Range share_x = 1.0 / (1.0 + y.value / x.value), share_y = 1.0 / (1.0 + x.value / y.value);
  Positive<n> out{x.value + y.value, {}};
  for (std::size_t k = 0; k < n; ++k) out.log_slope[k] = share_x * x.log_slope[k] + share_y * y.log_slope[k];
  return out;
}
template <std::size_t n>
Positive<n> plus(double c, const Positive<n>& x) {
  return Positive<n>{c, {}} + x;
}
/// The same where the first summand may vanish, and its logarithm has no slope.
template <std::size_t n>
Positive<n> operator+(const Signed<n>& x, const Positive<n>& y) {
  Positive<n> out{x.value + y.value, {}};
  const Range share_y = 1.0 / (1.0 + x.value / y.value);
  for (std::size_t k = 0; k < n; ++k) out.log_slope[k] = x.slope[k] / out.value + share_y * y.log_slope[k];
  return out;
}

}  // namespace ninedof::checker
