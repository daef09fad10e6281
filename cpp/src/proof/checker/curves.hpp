#pragma once
/// Sine, cosine, arc tangent and logarithm by their series. Of the C library nothing is believed.
///
/// Ranges hold every rounding by themselves. Where a series ends, its rest is a range too: its terms alternate and
/// fall.

#include <bit>
#include <cstdint>

#include "proof/checker/ranges.hpp"

namespace ninedof::checker {

struct OnCircle {
  Range sine{-1.0, 1.0}, cosine{-1.0, 1.0};
};

/// Of x less whole turns, halved n times to y up to 1/16, then doubled: sin 2y = 2 sin y cos y, and v = 1 - cos y
/// becomes 2 v (2 - v) = 2 - 2 (1 - v)^2: the first is exact at 0, the second is narrower far from it.
inline OnCircle sine_cosine(double x) {
  constexpr double turn = 6.28318530717958623200;  // from 0 to one unit in the last place below 2 pi
  if (!(std::abs(x) < 1e6)) return {};
  const double turns = std::floor(x / turn + 0.5);
  Range y = turns == 0.0 ? Range(x) : x - turns * Range(turn, up(turn));
  int doublings = 0;
  for (; size(y) > 0x1p-4; y = {0.5 * y.a, 0.5 * y.b}) ++doublings;
  const Range u = square(y);
  Range sine{0.0, 1.0}, v{0.0, 1.0};  // the rests, divided by their first terms
  for (double n = 12.0; n > 0.0; n -= 2.0) {
    sine = 1.0 - u / (n * (n + 1.0)) * sine;
    v = 1.0 - u / ((n + 1.0) * (n + 2.0)) * v;
  }
  sine = y * sine;
  v = u / 2.0 * v;
  for (; doublings > 0; --doublings) {
    sine = 2.0 * sine * (1.0 - v);
    v = v.b < 0.5 ? 2.0 * v * (2.0 - v) : 2.0 - 2.0 * square(1.0 - v);
  }
  return {meet(sine, {-1.0, 1.0}), meet(1.0 - v, {-1.0, 1.0})};
}

/// The angle from the x axis to (x, y), both not negative and not both zero: halved four times by
/// tan(a / 2) = y / (x + sqrt(x^2 + y^2)), then the series of the arc tangent of at most 1/10.
inline Range angle_of(Range x, Range y) {
  Range t = y / (x + root(square(x) + square(y)));
  for (int halvings = 1; halvings < 4; ++halvings) t = t / (1.0 + root(1.0 + square(t)));
  const Range u = square(t);
  Range sum{0.0, 1.0 / 19.0};
  for (double n = 17.0; n > 0.0; n -= 2.0) sum = Range(1.0) / n - u * sum;
  return 16.0 * (t * sum);
}

/// Of x = 2^k m, 0.7 < m < 1.42: k log 2 + 2 s (1 + s^2 / 3 + ...), s = (m - 1) / (m + 1), |s| < 0.18. With all
/// roundings and what follows s^25 the sum errs by less than 7 units of 2^-53 of its moduli.
inline Range logarithm(double x) {
  if (!(x > 0.0)) return {-inf, inf};
  if (x == inf) return {709.0, inf};
  double k = 0.0, m = x;
  if (m < std::numeric_limits<double>::min()) m *= 0x1p54, k = -54.0;
  constexpr std::uint64_t fraction = (std::uint64_t{1} << 52U) - 1U, of_one = std::bit_cast<std::uint64_t>(1.0);
  const auto bits = std::bit_cast<std::uint64_t>(m);
  k += static_cast<double>(bits >> 52U) - 1023.0;
  m = std::bit_cast<double>((bits & fraction) | of_one);
  if (m > 1.41) m *= 0.5, k += 1.0;
  const double s = (m - 1.0) / (m + 1.0), u = s * s, whole = k * 0.69314718055994530942;
  double sum = 0.0;
  for (double n = 25.0; n > 0.0; n -= 2.0) sum = 1.0 / n + u * sum;
  const double part = 2.0 * s * sum, value = whole + part, error = 0x1p-50 * (std::abs(whole) + std::abs(part));
  return {down(value - error), up(value + error)};
}
inline Range logarithm(Range x) {
  return {logarithm(x.a).a, logarithm(x.b).b};
}

}  // namespace ninedof::checker
