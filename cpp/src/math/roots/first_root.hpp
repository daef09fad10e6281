#pragma once
/// The first zero of a smooth function on [0, most], nothing stepped over.

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "math/roots/enclosure.hpp"

namespace ninedof {

struct FirstRoot {
  double at;      ///< infinite: none on [0, most]
  bool resolved;  ///< false: none before `at`, and the search ended there
};

namespace detail {

/// Root of value - fall x - curvature x^2 / 2 for value >= 0, curvature >= 0: how far a function stays positive that starts
/// at `value`, falls at the rate `fall` at most and bends down by `curvature` at most. No cancellation.
inline double safe_step(double value, double fall, double curvature) {
  const double root = std::sqrt(fall * fall + 2.0 * curvature * value);
  if (fall > 0.0) return 2.0 * value / (fall + root);
  return curvature > 0.0 ? (root - fall) / curvature : infinity;
}

}  // namespace detail

/// `f(t, h)` gives the Enclosure<double> of f at t with its bounds over [t, t + h]. `window` is the first h tried.
///
/// From t the function keeps its sign for as long as |f| - fall x - bend x^2 / 2 is positive, whence the step; close to a simple
/// zero that is Newton's, always short of it. A zero is where |f| is down to twice its error, so that one merely
/// touched is found, and one missed by less than rounding is taken for found.
template <class Function>
FirstRoot first_root(const Function& f, double most, double window) {
  constexpr int max_steps = 100000;
  constexpr double short_of = 1.0 - 1e-12;  // rounding of the step and its bounds
  double t = 0.0, sign = 0.0;
  for (int step = 0; step < max_steps; ++step) {
    const double rest = most - t, h = std::min(window, rest);
    const Enclosure<double> here = f(t, h);
    if (!std::isfinite(here.at[0])) return {t, false};
    if (step == 0) sign = here.at[0] < 0.0 ? -1.0 : 1.0;
    const double value = sign * here.at[0], slope = sign * here.at[1], bend = 2.0 * sign * here.at[2];
    // Taylor's remainder, x^3 max |f'''| / 6, is below x^2 / 2 times twice h of that; or f'' keeps to its own bound.
    const double most_bend = std::min(2.0 * here.bound[2], 2.0 * here.bound[3] * h + 2.0 * here.error[2] - bend);
    if (!std::isfinite(most_bend)) {
      window = 0.125 * h;
      continue;
    }
    const double curvature = std::max(0.0, most_bend);
    if (value <= 2.0 * here.error[0])
      return {t == 0.0 ? 0.0 : std::min(most, t + detail::safe_step(std::max(value, 0.0), -slope, curvature)), true};
    if (rest <= 0.0) return {infinity, true};
    const double reach = short_of * detail::safe_step(value - here.error[0], here.error[1] - slope, curvature);
    if (reach >= h) {
      t = h == rest ? most : t + h;
      window = 2.0 * h;
    } else {
      if (t + reach == t) return {t, true};  // nothing left that a double could tell from t
      t += reach;
      window = 2.0 * reach;
    }
  }
  return {t, false};
}

}  // namespace ninedof
