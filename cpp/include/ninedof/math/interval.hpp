#pragma once
/// Interval arithmetic: every operation encloses the exact results for all numbers in its operands.
///
/// Each end is computed in the ordinary rounding to nearest and then moved outwards by at least one unit in the last
/// place: r -+ (phi |r| + eta), with phi = u (1 + 2u), u = 2^-53 and eta the smallest positive double, lies at or
/// beyond the neighbour of r (Rump, Zimmermann, Boldo and Melquiond, BIT 2009). The rounding mode is never switched:
/// safe on any thread, the same bits on every processor.
///
/// Assumed: IEEE 754 doubles rounded to nearest, with gradual underflow and without fused operations
/// (-ffp-contract=off). `arithmetic_fault` looks whether that holds in this process. Nothing is assumed of the C
/// library.
///
/// Sources of values and gradients that are templates over the number type take an Interval, or a dual number of
/// intervals, as they take a double.

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

static_assert(FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 16, "doubles must not be kept in wider registers");

namespace ninedof {

/// The numbers from lo to hi; an end may be infinite. Never empty: lo <= hi, and no end is NaN.
struct Interval {
  double lo = 0.0, hi = 0.0;

  constexpr Interval() = default;
  constexpr Interval(double x) : lo(x), hi(x) {}  // NOLINT: numbers mix freely with intervals in formulas
  constexpr Interval(double low, double high) : lo(low), hi(high) {}

  /// For ends that come from outside. Throws InvalidArgument unless low <= high: an inverted interval would prove
  /// anything.
  static Interval between(double low, double high);

  static constexpr Interval whole() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
};

/// What is wrong with the floating-point arithmetic of this process, such as "subnormal numbers are taken for zero";
/// null if nothing is. Code built with -ffast-math changes it for the whole process that loads it.
const char* arithmetic_fault();

/// Throws std::runtime_error naming what is wrong with the arithmetic of this thread, if anything is.
void require_sound_arithmetic();

namespace detail {

inline constexpr double nudge = 0x1p-53 * (1.0 + 0x1p-52);
inline constexpr double least_double = std::numeric_limits<double>::denorm_min();
inline constexpr double greatest_double = std::numeric_limits<double>::max();
inline constexpr double no_bound = std::numeric_limits<double>::infinity();

/// A number at or below every number that rounds to r; -inf for NaN.
inline double below(double r) {
  const double moved = r - (nudge * std::abs(r) + least_double);
  if (moved == moved) [[likely]]
    return moved;
  return r > 0.0 ? greatest_double : -no_bound;
}
/// A number at or above every number that rounds to r; inf for NaN.
inline double above(double r) {
  const double moved = r + (nudge * std::abs(r) + least_double);
  if (moved == moved) [[likely]]
    return moved;
  return r < 0.0 ? -greatest_double : no_bound;
}

/// x y, with 0 inf = 0: an infinite end stands for finite numbers without a bound.
inline double times(double x, double y) {
  const double product = x * y;
  return product == product ? product : 0.0;
}

}  // namespace detail

inline double width(const Interval& x) {
  return x.hi - x.lo;
}
inline bool contains(const Interval& x, double value) {
  return x.lo <= value && value <= x.hi;
}
/// A number inside, near the middle; finite. Halves of the smallest doubles round to zero, which may lie outside.
inline double middle(const Interval& x) {
  const double m = 0.5 * x.lo + 0.5 * x.hi;
  return std::isfinite(m)            ? std::clamp(m, x.lo, x.hi)
         : x.lo == -detail::no_bound ? std::min(x.hi, 0.0)
                                     : std::max(x.lo, 0.0);
}
inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}
/// The largest |value|.
inline double magnitude(const Interval& x) {
  return std::max(std::abs(x.lo), std::abs(x.hi));
}

inline Interval operator+(const Interval& a, const Interval& b) {
  return {detail::below(a.lo + b.lo), detail::above(a.hi + b.hi)};
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return {detail::below(a.lo - b.hi), detail::above(a.hi - b.lo)};
}
inline Interval operator-(const Interval& a) {
  return {-a.hi, -a.lo};
}
inline Interval operator*(const Interval& a, const Interval& b) {
  using detail::times;
  if (a.lo >= 0.0 && b.lo >= 0.0)
    return {std::max(detail::below(times(a.lo, b.lo)), 0.0), detail::above(times(a.hi, b.hi))};
  const double p = times(a.lo, b.lo), q = times(a.lo, b.hi), r = times(a.hi, b.lo), s = times(a.hi, b.hi);
  return {detail::below(std::min(std::min(p, q), std::min(r, s))),
          detail::above(std::max(std::max(p, q), std::max(r, s)))};
}
/// All numbers if b contains zero.
inline Interval operator/(const Interval& a, const Interval& b) {
  if (b.hi < 0.0) return -a / -b;
  if (!(b.lo > 0.0)) return Interval::whole();
  const double lo = detail::below(a.lo / (a.lo < 0.0 ? b.lo : b.hi));
  const double hi = detail::above(a.hi / (a.hi < 0.0 ? b.hi : b.lo));
  return {a.lo >= 0.0 ? std::max(lo, 0.0) : lo, a.hi <= 0.0 ? std::min(hi, 0.0) : hi};
}
inline Interval& operator+=(Interval& a, const Interval& b) {
  return a = a + b;
}
inline Interval& operator-=(Interval& a, const Interval& b) {
  return a = a - b;
}

/// x * x, of which no value is negative.
inline Interval square(const Interval& x) {
  const double far = magnitude(x), near = x.lo > 0.0 ? x.lo : x.hi < 0.0 ? -x.hi : 0.0;
  return {std::max(detail::below(near * near), 0.0), detail::above(far * far)};
}
inline Interval abs(const Interval& x) {
  return x.lo >= 0.0 ? x : x.hi <= 0.0 ? -x : Interval(0.0, magnitude(x));
}
inline Interval min(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
}
inline Interval max(const Interval& a, const Interval& b) {
  return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}
/// The square roots of what is not negative in x; all numbers if nothing is.
inline Interval sqrt(const Interval& x) {
  if (x.hi < 0.0) return Interval::whole();
  return {x.lo > 0.0 ? std::max(detail::below(std::sqrt(x.lo)), 0.0) : 0.0, detail::above(std::sqrt(x.hi))};
}

// By math/elementary.hpp: two units in the last place on either side. In interval.cpp.
Interval exp(const Interval& x);
/// The logarithms of what is positive in x; all numbers if nothing is.
Interval log(const Interval& x);
Interval sin(const Interval& x);
Interval cos(const Interval& x);
/// Five to ten units of the last place.
Interval atan(const Interval& x);
/// Of what is from -1 to 1; ends beyond count as -1 or 1.
Interval acos(const Interval& x);

/// Only to be compared with zero: zero for [0, 0] and nothing else.
inline double value_of(const Interval& x) {
  return magnitude(x);
}

}  // namespace ninedof
