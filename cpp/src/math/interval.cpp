#include "ninedof/math/interval.hpp"

#include <cfenv>
#include <stdexcept>
#include <string>

#include "math/elementary.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {

namespace {

using detail::above, detail::below;

/// The numbers that are within 2 u of the modulus of x, and within half of the least double (u = 2^-53): two neighbours
/// of x are at least that far (docs/theory/elementary.md).
double twice_below(double x) {
  return below(below(x));
}
double twice_above(double x) {
  return above(above(x));
}

using Wave = double (*)(const elementary::SineCosine&);

/// The range of a sine or cosine: its values at the ends, and the extreme values at quarter turns within; `top` and
/// `bottom` are those of 1 and -1, modulo 4.
Interval wave(const Interval& x, Wave value, int top, int bottom) {
  if (!(magnitude(x) < elementary::most_radians)) return {-1.0, 1.0};
  const auto from = elementary::quarter_turns(x.lo), to = elementary::quarter_turns(x.hi);
  const long first = static_cast<long>(from.quarters) + (from.high > 0.0 ? 1 : 0),
             last = static_cast<long>(to.quarters) - (to.high < 0.0 ? 1 : 0);
  const auto has = [&](long wanted) { return first + ((wanted - first) & 3) <= last; };
  const double a = value(elementary::sine_cosine(from)), b = value(elementary::sine_cosine(to));
  const double lo = has(bottom) ? -1.0 : twice_below(std::min(a, b)), hi = has(top) ? 1.0 : twice_above(std::max(a, b));
  return {std::max(lo, -1.0), std::min(hi, 1.0)};
}

}  // namespace

Interval Interval::between(double low, double high) {
  if (!(low <= high)) throw InvalidArgument("interval", format_interval(low, high), "a lower end at most the upper");
  return {low, high};
}

const char* arithmetic_fault() {
  // Volatile: the compiler would compute these itself.
  volatile double tiny = std::numeric_limits<double>::min(), half = 0.5, one = 1.0, less = 0x1p-53;
  if (std::fegetround() != FE_TONEAREST) return "numbers are not rounded to nearest";
  if (!(tiny * half > 0.0) || !(detail::least_double + 0.0 * tiny > 0.0)) return "subnormal numbers are taken for zero";
  volatile double up = one + less, down = -one - less;
  if (up != one || down != -one) return "numbers are not rounded to nearest";
  return nullptr;
}

void require_sound_arithmetic() {
  if (const char* fault = arithmetic_fault())
    throw std::runtime_error(std::string("the arithmetic of this process is unfit for proofs: ") + fault);
}

Interval exp(const Interval& x) {
  return {std::max(twice_below(elementary::exp(x.lo)), 0.0), twice_above(elementary::exp(x.hi))};
}

Interval log(const Interval& x) {
  if (!(x.hi > 0.0)) return Interval::whole();
  return {x.lo > 0.0 ? twice_below(elementary::log(x.lo)) : -detail::no_bound, twice_above(elementary::log(x.hi))};
}

Interval sin(const Interval& x) {
  return wave(x, [](const elementary::SineCosine& at) { return at.sine; }, 1, 3);
}

Interval cos(const Interval& x) {
  return wave(x, [](const elementary::SineCosine& at) { return at.cosine; }, 0, 2);
}

Interval atan(const Interval& x) {
  constexpr double wider = 0x1.cp-51;  // 7 u: 5 of the arc tangent, 1 of the difference
  const double lo = elementary::atan(x.lo), hi = elementary::atan(x.hi);
  return {lo - (wider * std::abs(lo) + detail::least_double), hi + (wider * std::abs(hi) + detail::least_double)};
}

Interval acos(const Interval& x) {
  constexpr double wider = 0x1.4p-50;  // 10 u: 5 of the arc tangent, 2.5 of its argument, 1 of the product
  const auto angle = [](double c) {
    c = std::clamp(c, -1.0, 1.0);
    return 2.0 * elementary::atan(std::sqrt((1.0 - c) / (1.0 + c)));
  };
  return {angle(x.hi) * (1.0 - wider), angle(x.lo) * (1.0 + wider)};
}

}  // namespace ninedof
