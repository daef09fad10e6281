/// Declared in ninedof/proof/closed_form_bounds.hpp. The closed form in the six numbers of a hexagonal design.
///
/// As sums of positive terms, with the one difference that can cancel, a1 b2 - a2 b1, to the last bit: a third of the
/// operations of axis_spectrum, and bounds that stay tight near singular designs. Derived in docs/theory/proof.md,
/// lemma 7.

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/elementary.hpp"
#include "ninedof/proof/bounds.hpp"
#include "ninedof/proof/closed_form_bounds.hpp"
#include "proof/numbers/condition_bounds.hpp"

namespace ninedof {
namespace {

// Powers of two round nothing but the smallest and largest numbers.
Interval exact_half(const Interval& x) {
  return {0.5 * x.lo - detail::least_double, 0.5 * x.hi + detail::least_double};
}
Interval exact_double(const Interval& x) {
  return {std::min(2.0 * x.lo, detail::greatest_double), std::max(2.0 * x.hi, -detail::greatest_double)};
}

Interval not_below_zero(const Interval& x) {
  return {std::max(x.lo, 0.0), std::max(x.hi, 0.0)};
}

/// x^2 + x y + y^2: three times the squared radius of a hexagon with the sides x and y.
Interval radius_form(const Interval& x, const Interval& y) {
  return square(x) + x * y + square(y);
}
/// The same for sides of either sign, as a sum of squares.
Interval radius_form_of_differences(const Interval& x, const Interval& y) {
  return exact_half(square(x) + square(y) + square(x + y));
}

/// a b - c d to the last bit: as DotSum, written out for two products.
Interval difference_of_products(double a, double b, double c, double d) {
  const auto [first, first_low] = elementary::product(a, b);
  const auto [second, second_low] = elementary::product(c, d);
  const double rounded = first - second, part = rounded - first;
  const double left = (first - (rounded - part)) - (second + part);
  const Interval of_products = Interval(first_low) - Interval(second_low);
  const Interval lost(-8.0 * detail::least_double, 8.0 * detail::least_double);  // below the normal numbers
  return Interval(rounded) + (Interval(left) + (of_products + lost));
}

/// t + sqrt(t^2 - 4 d^2), twice the square of the larger singular value, from the sum t of both squares and the square
/// d^2 of their product. Near isotropy t - 2 d cancels; there `gap` gives it once more, as a sum of squares.
template <class Gap>
Interval larger_square(const Interval& t, const Interval& d_squared, const Gap& gap) {
  constexpr double cancels = 0.35;
  const Interval d = exact_double(sqrt(d_squared));
  Interval difference = t - d;
  if (difference.lo < cancels * t.hi) {
    const Interval again = gap();
    difference = {std::max(difference.lo, again.lo), std::min(difference.hi, again.hi)};
  }
  return t + sqrt(not_below_zero(difference) * (t + d));
}

/// Each block without its factor, 3 or 3/2.
Interval hexagonal_condition(const double* x) {
  const Interval a1 = x[0], a2 = x[1], b1 = x[2], b2 = x[3], zp = x[4], zs = x[5];
  const Interval rise = zp - zs;
  const Interval base = radius_form(a1, a2), platform = radius_form(b1, b2);
  const Interval offset = radius_form_of_differences(b1 - a1, b2 - a2);             // of u - r
  const Interval lever = radius_form(zs * b1 + rise * a1, zs * b2 + rise * a2);     // of zs u + (zp - zs) r
  const Interval turn = difference_of_products(x[0], x[3], x[1], x[2]);  // u x r
  const Interval moment = exact_half(exact_half(square(turn)));
  const Interval zp2 = square(zp), zs2 = square(zs), rise2 = square(rise), up = 3.0 * zp2;
  const Interval per_l2 = 1.0 / (offset + up), stretch = 1.0 + rise2;

  const Interval heights = 3.0 * (zs2 * rise2), radii = base * platform;
  const Interval base_rise = base * rise2, platform_zs = platform * zs2;
  const Interval w0 = heights / (exact_double(heights) + (base_rise + platform_zs));
  const Interval w1 = radii / (exact_double(radii) + 3.0 * (base_rise + platform_zs));

  const Interval m2 = moment * per_l2, axial = (moment + up) * per_l2 + w0, axial_product = m2 * w0;
  const Interval axial_larger = larger_square(
      axial, axial_product, [&] { return square(sqrt(not_below_zero(m2)) - sqrt(not_below_zero(w0))) + up * per_l2; });

  const Interval g2 = lever * per_l2;  // times the stretch
  const Interval transverse = (platform * zp2 + offset) * per_l2 + w1 * stretch, transverse_product = g2 * w1;
  const Interval transverse_larger = larger_square(transverse, transverse_product, [&] {
    const Interval k = 1.0 + rise * zp;
    const Interval f2 = radius_form_of_differences(k * b1 - a1, k * b2 - a2) * per_l2;
    return square(sqrt(not_below_zero(g2 / stretch)) - sqrt(not_below_zero(w1 * stretch))) + f2 / stretch;
  });
  // (sigma_max / sigma_min)^2 times 4: both of one block, or one of each.
  const Interval each = axial_larger * transverse_larger;
  const Interval ratio = max(ratio_bounds(max(square(axial_larger), exact_half(each)), axial_product),
                             ratio_bounds(max(square(transverse_larger), exact_double(each)), transverse_product));
  return at_least_one(exact_half(sqrt(ratio)));
}

}  // namespace

void hexagonal_condition_number_bounds(const double* designs, long count, double* out) {
  require_sound_arithmetic();
  for (long i = 0; i < count; ++i, designs += 6, out += 2) {
    const Interval found = hexagonal_condition(designs);
    const bool unknown =
        !std::isfinite(found.hi) && std::any_of(designs, designs + 6, [](double x) { return std::isnan(x); });
    out[0] = unknown ? std::numeric_limits<double>::quiet_NaN() : found.lo;
    out[1] = unknown ? std::numeric_limits<double>::quiet_NaN() : found.hi;
  }
}

}  // namespace ninedof
