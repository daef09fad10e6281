#pragma once
/// The first zero of a smooth function on [0, most], with a proof that none was missed before it.

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "math/roots/enclosure.hpp"

namespace ninedof {

struct FirstRoot {
  double at;      ///< infinite if there is none on [0, most]
  bool resolved;  ///< false if the search ended at `at` without a zero before it
};

namespace detail {

/// Root of value - fall x - curvature x^2 / 2 for value, curvature >= 0, without cancellation: how far a function stays
/// positive that starts at `value` with a slope of at least -fall and a second derivative of at least -curvature.
inline double safe_step(double value, double fall, double curvature) {
  const double root = std::sqrt(fall * fall + 2.0 * curvature * value);
  if (fall > 0.0) return 2.0 * value / (fall + root);
  return curvature > 0.0 ? (root - fall) / curvature : infinity;
}

}  // namespace detail

/// `f(t, h)` returns the Enclosure<double> of f at t with its bounds over [t, t + h]. `window` is the first h tried.
///
/// From t the function keeps its sign while |f| - fall x - bend x^2 / 2 is positive: this gives the step. Close to a
/// simple zero it is Newton's step from one side. A zero is reported where |f| is at most twice its error. So a double
/// zero is found, and so is a minimum that misses zero by less than rounding.
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
    // Taylor's remainder, x^3 max |f'''| / 6, is at most x^2 / 2 times 2 h max |f'''| / 6. The bound of f'' holds too.
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
      if (t + reach == t) return {t, true};  // the zero is at t to rounding
      t += reach;
      window = 2.0 * reach;
    }
  }
  return {t, false};
}

}  // namespace ninedof
