/// curves.hpp: the checker's sine, cosine, arc tangent and logarithm hold those of long double, and are narrow.

#include "proof/checker/curves.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace ninedof::checker;

namespace {

/// What long double may be off by, where it is longer than double.
constexpr long double doubt = 0x1p-62L;

bool holds(const Range& x, long double exact) {
  const long double off = doubt * std::abs(exact);
  return x.a <= exact + off && exact - off <= x.b;
}
double width(const Range& x) {
  return x.b - x.a;
}

}  // namespace

TEST_SUITE("curves") {
  TEST_CASE("sine and cosine") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int n = 0; n < 100'000; ++n) {
      const double near = std::nextafter(0.5 * std::numbers::pi * (n % 41 - 20), any(random) < 0.0 ? -inf : inf);
      const double x = n % 3 == 0 ? near : n % 3 == 1 ? 4.0 * any(random) : std::exp(40.0 * any(random) - 28.0);
      const OnCircle at = sine_cosine(x);
      CHECK(holds(at.sine, std::sin(static_cast<long double>(x))));
      CHECK(holds(at.cosine, std::cos(static_cast<long double>(x))));
      CHECK(width(at.sine) < 1e-14 * (std::abs(x) < 0.1 ? std::abs(x) : std::abs(x) + 1.0) + 1e-320);
      CHECK(width(at.cosine) < 1e-14 * (std::abs(x) + 1.0));
    }
    for (const double x : {1e6, 1e300, inf, std::nan("")}) CHECK(sine_cosine(x).sine == Range(-1.0, 1.0));
    CHECK(holds(sine_cosine(-0.0).sine, 0.0L));
  }

  TEST_CASE("angles of a quadrant") {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    for (int n = 0; n < 50'000; ++n) {
      const double x = n % 5 == 0 ? 0.0 : any(random) * std::exp(8.0 * any(random) - 4.0), y = any(random) + 1e-9;
      const Range angle = angle_of(x, y);
      CHECK(holds(angle, std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
      CHECK(width(angle) < 2e-14 * angle.b);
    }
  }

  TEST_CASE("logarithms") {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int n = 0; n < 100'000; ++n) {
      const double x = n % 2 == 0 ? 1.0 + std::exp(20.0 * any(random) - 19.0) * any(random)
                                  : std::ldexp(any(random) + 2.0, static_cast<int>(1060.0 * any(random)) - 30);
      if (!(x > 0.0) || std::isinf(x)) continue;
      const long double exact = std::log(static_cast<long double>(x));
      const Range found = logarithm(x);
      CHECK(holds(found, exact));
      CHECK(width(found) <= 8e-15 * std::abs(static_cast<double>(exact)) + 1e-320);
    }
    CHECK(holds(logarithm(std::numeric_limits<double>::denorm_min()), -1074.0L * std::log(2.0L)));
    CHECK(holds(logarithm(std::numeric_limits<double>::max()), std::log(2.0L) * 1024.0L));
    CHECK(logarithm(Range(0.0, inf)) == Range(-inf, inf));
    CHECK(logarithm(Range(-1.0, -1.0)) == Range(-inf, inf));
  }
}
