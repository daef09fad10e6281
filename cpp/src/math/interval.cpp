#include "ninedof/math/interval.hpp"

#include <cfenv>
#include <numbers>
#include <stdexcept>
#include <string>

#include "ninedof/math/error.hpp"

namespace ninedof {

namespace {

using detail::above, detail::below;

/// x is a value of the C library, at most two units in the last place from the exact one.
double library_below(double x) {
  return below(below(x));
}
double library_above(double x) {
  return above(above(x));
}

/// The integers k with k pi/2 in x lie in first .. last; none if first > last.
struct QuarterTurns {
  double first, last;
};

/// Counted too generously where rounding leaves a doubt: an extreme value that is not attained only widens.
QuarterTurns quarter_turns(const Interval& x) {
  // pi/2 to 2^-54; dividing by an interval about it gives every k in question.
  const Interval half_pi = {below(std::numbers::pi / 2.0), above(std::numbers::pi / 2.0)};
  const Interval turns = x / half_pi;
  return {std::ceil(turns.lo), std::floor(turns.hi)};
}

/// Whether an integer from first to last is `wanted` modulo 4.
bool has(const QuarterTurns& turns, double wanted) {
  const double k = turns.first + std::fmod(std::fmod(wanted - turns.first, 4.0) + 4.0, 4.0);
  return k <= turns.last;
}

/// The range of a sine or cosine: its values at the ends, and the extreme values where their angles lie within.
Interval wave(const Interval& x, double at_lo, double at_hi, double top, double bottom) {
  constexpr double reduced_exactly = 0x1p30;  // beyond, quarter turns are not told apart with certainty
  if (!(magnitude(x) < reduced_exactly)) return {-1.0, 1.0};
  const QuarterTurns turns = quarter_turns(x);
  const double lo = has(turns, bottom) ? -1.0 : library_below(std::min(at_lo, at_hi));
  const double hi = has(turns, top) ? 1.0 : library_above(std::max(at_lo, at_hi));
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
  return {std::max(library_below(std::exp(x.lo)), 0.0), library_above(std::exp(x.hi))};
}

Interval log(const Interval& x) {
  if (!(x.hi > 0.0)) return Interval::whole();
  return {x.lo > 0.0 ? library_below(std::log(x.lo)) : -detail::no_bound, library_above(std::log(x.hi))};
}

Interval sin(const Interval& x) {
  return wave(x, std::sin(x.lo), std::sin(x.hi), 1.0, 3.0);
}

Interval cos(const Interval& x) {
  return wave(x, std::cos(x.lo), std::cos(x.hi), 0.0, 2.0);
}

}  // namespace ninedof
