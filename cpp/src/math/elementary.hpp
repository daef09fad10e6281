#pragma once
/// Elementary functions from + - * / and square roots of doubles alone: the same bits on every machine, with a proved
/// error (docs/theory/elementary.md). u = 2^-53.

#include <bit>
#include <cstdint>

#include "ninedof/math/interval.hpp"

namespace ninedof::elementary {

/// Within 2 u of its modulus, and where it is below the normal numbers within one unit more.
double exp(double x);
/// Of x > 0: within 2 u of its modulus.
double log(double x);
/// Within 5 u of its modulus.
double atan(double x);

/// x = quarters pi/2 + high + low, |high + low| < 0.786. Zero only for x = 0: the sign of the rest is known.
struct QuarterTurns {
  double quarters, high, low;
};
/// Beyond, quarter turns are not told apart with certainty.
inline constexpr double most_radians = 0x1p30;
QuarterTurns quarter_turns(double x);

/// Within 2 u of their moduli; NaN from most_radians on.
struct SineCosine {
  double sine, cosine;
};
SineCosine sine_cosine(const QuarterTurns& x);
SineCosine sine_cosine(double x);

/// x y = high + low to 4 of the least doubles, unless an operand is beyond 2^996: then low is NaN. (Dekker.)
struct Product {
  double high, low;
};
inline Product product(double x, double y) {
  constexpr double middle = 0x1p27 + 1.0;
  const double p = x * y, a = middle * x, b = middle * y;
  const double x_high = a - (a - x), y_high = b - (b - y), x_low = x - x_high, y_low = y - y_high;
  return {p, x_low * y_low - (((p - x_high * y_high) - x_low * y_high) - x_high * y_low)};
}

/// 2^n, -1022 <= n <= 1023.
inline double power_of_two(int n) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52U);
}
/// x 2^n, |n| <= 2044: exact, unless it is below the normal numbers.
inline double scaled(double x, int n) {
  return x * power_of_two(n / 2) * power_of_two(n - n / 2);
}

}  // namespace ninedof::elementary
