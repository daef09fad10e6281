#pragma once
/// Functions of one number over a box, as forms along their chords. Where a box is wide they err by a small part of
/// what series at the middle leave. Beside them the same names for doubles: a formula is written once.

#include <algorithm>
#include <cmath>

#include "math/elementary.hpp"
#include "math/form.hpp"

namespace ninedof::proof {

/// f(x) for f convex (concave) on the range of x, whose slope is m at tangent(m). An error of that place counts by its
/// square; f itself is right within some units in the last place, of which the slack has sixty.
template <bool convex, class Function, class Tangent>
DesignForm along_chord(const DesignForm& x, const Function& f, const Tangent& tangent) {
  const double lo = lower(x), hi = upper(x), f_lo = f(lo), f_hi = f(hi);
  const double m = hi > lo ? (f_hi - f_lo) / (hi - lo) : 0.0;
  const double t = hi > lo ? std::clamp(tangent(m), lo, hi) : lo;
  if (!std::isfinite(t)) return DesignForm::unknown();
  const double at_ends[] = {f_lo - m * lo, f_hi - m * hi}, between = f(t) - m * t;
  const double slack = 0x1p-47 * (std::abs(f_lo) + std::abs(f_hi) + std::abs(m) * (std::abs(lo) + std::abs(hi)));
  const double ends = convex ? std::max(at_ends[0], at_ends[1]) : std::min(at_ends[0], at_ends[1]);
  return m * x + DesignForm::of(Interval(std::min(ends, between) - slack, std::max(ends, between) + slack));
}

inline DesignForm root_of(const DesignForm& x) {
  if (!(lower(x) > 0.0)) return sqrt(x);
  return along_chord<false>(x, [](double v) { return std::sqrt(v); }, [](double m) { return 0.25 / (m * m); });
}
inline double root_of(double x) {
  return std::sqrt(x);
}
inline DesignForm reciprocal(const DesignForm& x) {
  if (!(lower(x) > 0.0)) return DesignForm::unknown();
  return along_chord<true>(x, [](double v) { return 1.0 / v; }, [](double m) { return 1.0 / std::sqrt(-m); });
}
inline double reciprocal(double x) {
  return 1.0 / x;
}
inline DesignForm reciprocal_square(const DesignForm& x) {
  if (!(lower(x) > 0.0)) return DesignForm::unknown();
  return along_chord<true>(
      x, [](double v) { return 1.0 / (v * v); },
      [](double m) { return elementary::exp(elementary::log(-2.0 / m) / 3.0); });
}
inline double reciprocal_square(double x) {
  return 1.0 / (x * x);
}
/// Of angles from 0 to 90 degrees.
inline double cosine_of(double x) {
  return elementary::sine_cosine(x).cosine;
}
inline double sine_of(double x) {
  return elementary::sine_cosine(x).sine;
}
inline DesignForm cosine_of(const DesignForm& x) {
  return along_chord<false>(
      x, [](double v) { return cosine_of(v); },
      [](double m) { return elementary::atan(-m / std::sqrt((1.0 - m) * (1.0 + m))); });
}
inline DesignForm sine_of(const DesignForm& x) {
  return along_chord<false>(
      x, [](double v) { return sine_of(v); },
      [](double m) { return elementary::atan(std::sqrt((1.0 - m) * (1.0 + m)) / m); });
}

/// The larger one: x + max(0, y - x), and max(0, d) - a d lies from 0 to its value at an end for every a from 0 to 1.
inline DesignForm larger(const DesignForm& x, const DesignForm& y) {
  const DesignForm d = y - x;
  const double lo = lower(d), hi = upper(d);
  if (lo >= 0.0) return y;
  if (hi <= 0.0) return x;
  if (!is_known(d)) return DesignForm::unknown();
  const double a = hi / (hi - lo);
  return x + a * d + DesignForm::of(Interval(0.0, std::max((1.0 - a) * hi, -a * lo) * (1.0 + forms::grain)));
}
inline double larger(double x, double y) {
  return std::max(x, y);
}

}  // namespace ninedof::proof
