#include "math/elementary.hpp"

#include <array>

#include "math/numbers.hpp"

namespace ninedof::elementary {
namespace {

/// c_0 + c_1 u + c_2 u^2 + ...
template <std::size_t N>
double polynomial(const std::array<double, N>& c, double u) {
  double sum = c[N - 1];
  for (std::size_t n = N - 1; n-- > 0;) sum = sum * u + c[n];
  return sum;
}

/// top sign^n / (first + n step)!; factorials up to 17! are doubles.
template <std::size_t N>
constexpr std::array<double, N> inverse_factorials(double top, double sign, int first, int step) {
  std::array<double, N> out{};
  double factorial = 1.0;
  int reached = 0;
  for (std::size_t n = 0; n < N; ++n, top *= sign) {
    for (; reached < first + static_cast<int>(n) * step; ++reached) factorial *= reached + 1.0;
    out[n] = top / factorial;
  }
  return out;
}

/// top sign^n / (3 + 2 n).
template <std::size_t N>
constexpr std::array<double, N> inverse_odds(double top, double sign) {
  std::array<double, N> out{};
  for (std::size_t n = 0; n < N; ++n, top *= sign) out[n] = top / (3.0 + 2.0 * static_cast<double>(n));
  return out;
}

constexpr auto of_exp = inverse_factorials<12>(1.0, 1.0, 2, 1);
constexpr auto of_sine = inverse_factorials<8>(-1.0, -1.0, 3, 2);
constexpr auto of_cosine = inverse_factorials<7>(1.0, -1.0, 4, 2);
constexpr auto of_log = inverse_odds<10>(2.0, 1.0);
constexpr auto of_atan = inverse_odds<13>(-1.0, -1.0);

// log 2, whose first part has 42 bits: its multiples up to 2^11 are doubles. pi/2 in three parts.
constexpr double log2_high = 0x1.62e42fefa38p-1, log2_low = 0x1.ef35793c76730p-45;
constexpr double quarter_first = 0x1.921fb54442d18p+0, quarter_second = 0x1.1a62633145c07p-54,
                 quarter_third = -0x1.f1976b7ed8fbcp-110;
/// atan(n / 4).
constexpr double atan_high[] = {0.0, 0x1.f5b75f92c80ddp-3, 0x1.dac670561bb4fp-2, 0x1.4978fa3269ee1p-1,
                                0x1.921fb54442d18p-1};
constexpr double atan_low[] = {0.0, 0x1.8ab6e3cf7afbdp-57, 0x1.a2b7f222f65e2p-56, 0x1.2419a87f2a458p-56,
                               0x1.1a62633145c07p-55};

/// To the nearest integer, |x| < 2^51.
double rounded(double x) {
  constexpr double shift = 0x1.8p52;
  return (x + shift) - shift;
}

/// a + b = high + low exactly, for |a| >= |b| or a = 0 (`fast`), or any (Knuth).
Product fast_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}
Product sum(double a, double b) {
  const double out = a + b, part = out - a;
  return {out, (a - (out - part)) + (b - part)};
}

}  // namespace

double exp(double x) {
  if (!(x > -746.0)) return x == x ? 0.0 : x;
  if (x > 710.0) return infinity;
  const double k = rounded(x * 0x1.71547652b82fep+0);
  const double high = x - k * log2_high, low = k * log2_low, r = high - low, rest = (high - r) - low;
  return scaled(1.0 + (r + (rest + r * r * polynomial(of_exp, r))), static_cast<int>(k));
}

double log(double x) {
  if (x == infinity) return x;
  constexpr std::uint64_t fraction = (std::uint64_t{1} << 52U) - 1U, of_one = std::uint64_t{1023} << 52U;
  const bool subnormal = x < std::numeric_limits<double>::min();
  const auto bits = std::bit_cast<std::uint64_t>(subnormal ? x * 0x1p54 : x);
  double k = static_cast<double>(bits >> 52U) - (subnormal ? 1077.0 : 1023.0);
  double m = std::bit_cast<double>((bits & fraction) | of_one);
  if (m > 0x1.6a09e667f3bccp+0) m *= 0.5, k += 1.0;
  // log(1 + f) = f - f^2/2 + s (f^2/2 + R), s = f / (2 + f), R = 2 s^2 (1/3 + s^2/5 + ...).
  const double f = m - 1.0, s = f / (2.0 + f), z = s * s, half = 0.5 * f * f;
  const Product less = fast_sum(f, -half), all = fast_sum(k * log2_high, less.high);
  return all.high + (all.low + (less.low + (s * (half + z * polynomial(of_log, z)) + k * log2_low)));
}

double atan(double x) {
  if (x < 0.0) return -atan(-x);
  if (x > 1.0) return quarter_first - (atan(1.0 / x) - quarter_second);
  const int n = static_cast<int>(4.0 * x);
  const double c = 0.25 * n, z = (x - c) / (1.0 + x * c), u = z * z;
  return atan_high[n] + (atan_low[n] + (z + z * (u * polynomial(of_atan, u))));
}

QuarterTurns quarter_turns(double x) {
  const double k = rounded(x * 0x1.45f306dc9c883p-1);
  if (k == 0.0) return {k, x, 0.0};
  const Product first = product(k, quarter_first), second = product(k, quarter_second);
  const Product a = sum(x - first.high, -first.low), b = sum(a.high, -second.high);
  const Product rest = fast_sum(b.high, (a.low + b.low) - (second.low + k * quarter_third));
  return {k, rest.high, rest.low};
}

SineCosine sine_cosine(double x) {
  if (!(std::abs(x) < most_radians)) return {not_a_number, not_a_number};
  return sine_cosine(quarter_turns(x));
}

SineCosine sine_cosine(const QuarterTurns& x) {
  const double r = x.high, low = x.low;
  const double u = r * r, half = 0.5 * u, near = 1.0 - half;
  const double s = r + (r * (u * polynomial(of_sine, u)) + low * near);
  const double c = near + (((1.0 - near) - half) + (u * (u * polynomial(of_cosine, u)) - r * low));
  switch (static_cast<int>(x.quarters) & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

}  // namespace ninedof::elementary
