#pragma once
/// The checker's interval numbers: every result is widened to the neighbouring doubles.

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

static_assert(FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 16, "doubles must not be kept in wider registers");

namespace ninedof::checker {

constexpr double inf = std::numeric_limits<double>::infinity();

inline double down(double x) {
  return std::isnan(x) ? -inf : std::nextafter(x, -inf);
}
inline double up(double x) {
  return std::isnan(x) ? inf : std::nextafter(x, inf);
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
  const double p[] = {x.a * y.a, x.a * y.b, x.b * y.a, x.b * y.b};
  if (std::isnan(p[0] + p[1] + p[2] + p[3])) return {-inf, inf};
  return {down(*std::min_element(p, p + 4)), up(*std::max_element(p, p + 4))};
}
inline Range operator/(Range x, Range y) {
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

constexpr int coordinates = 7;

/// A quantity with its slopes along the logarithms of the coordinates.
struct Signed {
  Range value;
  Range slope[coordinates];
};
/// A positive quantity with the slopes of its logarithm: products add them, and nothing is lost.
struct Positive {
  Range value;
  Range log_slope[coordinates];
};

inline Signed plain(const Positive& x) {
  Signed out{x.value, {}};
  for (int k = 0; k < coordinates; ++k) out.slope[k] = x.value * x.log_slope[k];
  return out;
}
inline Signed operator+(const Signed& x, const Signed& y) {
  Signed out{x.value + y.value, {}};
  for (int k = 0; k < coordinates; ++k) out.slope[k] = x.slope[k] + y.slope[k];
  return out;
}
inline Signed plus(double c, Signed x) {
  x.value = c + x.value;
  return x;
}
inline Signed operator*(const Signed& x, const Positive& y) {
  Signed out{x.value * y.value, {}};
  for (int k = 0; k < coordinates; ++k) out.slope[k] = y.value * (x.slope[k] + x.value * y.log_slope[k]);
  return out;
}
inline Signed operator-(const Signed& x) {
  Signed out{-x.value, {}};
  for (int k = 0; k < coordinates; ++k) out.slope[k] = -x.slope[k];
  return out;
}
inline Signed squared(const Signed& x) {
  Signed out{square(x.value), {}};
  for (int k = 0; k < coordinates; ++k) out.slope[k] = 2.0 * x.value * x.slope[k];
  return out;
}

inline Positive operator*(const Positive& x, const Positive& y) {
  Positive out{x.value * y.value, {}};
  for (int k = 0; k < coordinates; ++k) out.log_slope[k] = x.log_slope[k] + y.log_slope[k];
  return out;
}
inline Positive operator*(double c, Positive x) {
  x.value = c * x.value;
  return x;
}
inline Positive inverse(const Positive& x) {
  Positive out{1.0 / x.value, {}};
  for (int k = 0; k < coordinates; ++k) out.log_slope[k] = -x.log_slope[k];
  return out;
}
inline Positive squared(const Positive& x) {
  Positive out{square(x.value), {}};
  for (int k = 0; k < coordinates; ++k) out.log_slope[k] = 2.0 * x.log_slope[k];
  return out;
}
/// The share of each summand weighs its slopes.
inline Positive operator+(const Positive& x, const Positive& y) {
  const Range share_x = 1.0 / (1.0 + y.value / x.value), share_y = 1.0 / (1.0 + x.value / y.value);
  Positive out{x.value + y.value, {}};
  for (int k = 0; k < coordinates; ++k) out.log_slope[k] = share_x * x.log_slope[k] + share_y * y.log_slope[k];
  return out;
}
inline Positive plus(double c, const Positive& x) {
  return Positive{c, {}} + x;
}
/// The same where the first summand may vanish, and its logarithm has no slope.
inline Positive operator+(const Signed& x, const Positive& y) {
  Positive out{x.value + y.value, {}};
  const Range share_y = 1.0 / (1.0 + x.value / y.value);
  for (int k = 0; k < coordinates; ++k) out.log_slope[k] = x.slope[k] / out.value + share_y * y.log_slope[k];
  return out;
}

}  // namespace ninedof::checker
