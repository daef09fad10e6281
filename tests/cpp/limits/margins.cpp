/// Margins: that which people read, the solver's and that of cells have one sign, and the solver's has its slope, its
/// inverse and its share of the limit.

#include "limits/margins.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

TEST_SUITE("margins") {
  TEST_CASE("margins of one limit agree") {
    Random random(4);
    using enum LimitKind;
    using enum SolverMargin;
    for (int n = 0; n < 200; ++n) {
      const double limit = random.log_uniform(1e-3, 1e3), value = limit * random.log_uniform(0.3, 3.0);
      for (const Side side : {Side::high, Side::low}) {
        const bool kept = side == Side::high ? value <= limit : value >= limit;
        for (const LimitKind kind : {ratio, length, angle, sign, number, rate, power}) {
          CHECK((margin(kind, side, limit, value) >= 0.0) == kept);
          CHECK((cell_margin(kind, side, limit, value) >= 0.0) == kept);
        }
        const double share = (side == Side::high ? limit - value : value - limit) / limit;
        CHECK(margin(length, side, limit, value) == share);
        for (const SolverMargin form : {logarithm, linear, plain, mixed}) {
          if ((form == plain && side == Side::high) || (form == mixed && side == Side::low)) continue;  // in no row
          const double m = solver_margin(form, side, limit, value), h = 1e-6 * value;
          CHECK((m >= 0.0) == kept);
          CHECK(value_at_margin(form, side, limit, m) == doctest::Approx(value).epsilon(1e-13));
          const double slope =
              (solver_margin(form, side, limit, value + h) - solver_margin(form, side, limit, value - h)) / (2.0 * h);
          CHECK(solver_slope(form, side, limit, value) == doctest::Approx(slope).epsilon(1e-6));
          const ShownMargin shown = share_of_limit(form, side, m);
          if (form != plain) CHECK(shown.value == doctest::Approx(share).epsilon(1e-10).scale(1.0));
          const double more = share_of_limit(form, side, m + 1e-6).value,
                       less = share_of_limit(form, side, m - 1e-6).value;
          CHECK(shown.slope == doctest::Approx((more - less) / 2e-6).epsilon(1e-6));
        }
      }
    }
  }

  TEST_CASE("an open side leaves all, a number that is unknown leaves nothing known") {
    CHECK(margin(LimitKind::length, Side::low, 0.0, 2.0) == infinity);
    CHECK(margin(LimitKind::length, Side::high, infinity, 2.0) == infinity);
    CHECK(margin(LimitKind::ratio, Side::high, 2.0, infinity) == -infinity);
    CHECK(std::isnan(margin(LimitKind::ratio, Side::high, 2.0, not_a_number)));
    CHECK(margin(LimitKind::sign, Side::low, 0.0, -0.5) == -0.5);
    CHECK(cell_margin(LimitKind::ratio, Side::high, 2.0, infinity) == -1.0);
  }
}
