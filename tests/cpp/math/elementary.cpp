/// elementary.hpp: the errors it promises, against long double; balls of 200 bits judge the same functions in
/// tests/python/proof/test_interval.py. And what it says of products and of multiples of a right angle.

#include "math/elementary.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace ninedof;

namespace {

constexpr long double unit = 0x1p-53L;
/// What long double may be off by, where it is longer than double.
constexpr long double doubt = 0x1p-62L;

bool within(double value, long double exact, long double units) {
  return std::abs(value - exact) <= (units * unit + doubt) * std::abs(exact);
}

}  // namespace

TEST_SUITE("elementary") {
  TEST_CASE("values are within two units of roundoff") {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int n = 0; n < 200'000; ++n) {
      const double angle = any(random) * std::exp(10.0 * any(random)), power = any(random) * (n % 2 == 0 ? 1.0 : 700.0);
      const auto at = elementary::sine_cosine(angle);
      CHECK(within(at.sine, std::sin(static_cast<long double>(angle)), 2.0L));
      CHECK(within(at.cosine, std::cos(static_cast<long double>(angle)), 2.0L));
      CHECK(within(elementary::exp(power), std::exp(static_cast<long double>(power)), 2.0L));
      const double positive = n % 2 == 0 ? 1.0 + 0.9 * any(random) : std::exp(power);
      CHECK(within(elementary::log(positive), std::log(static_cast<long double>(positive)), 2.0L));
      CHECK(within(elementary::atan(angle), std::atan(static_cast<long double>(angle)), 5.0L));
    }
  }

  TEST_CASE("ends of their domains") {
    constexpr double inf = std::numeric_limits<double>::infinity();
    CHECK(elementary::exp(-inf) == 0.0);
    CHECK(elementary::exp(inf) == inf);
    CHECK(elementary::exp(0.0) == 1.0);
    CHECK(elementary::log(inf) == inf);
    CHECK(elementary::log(1.0) == 0.0);
    CHECK(within(elementary::log(std::numeric_limits<double>::denorm_min()), -1074.0L * std::log(2.0L), 2.0L));
    CHECK(within(elementary::atan(inf), std::acos(0.0L), 5.0L));
    CHECK(elementary::sine_cosine(-0.0).sine == 0.0);
    for (const double x : {elementary::most_radians, -1e300, inf}) CHECK(std::isnan(elementary::sine_cosine(x).cosine));
  }

  TEST_CASE("a product and its rest are exact") {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> any(1.0, 2.0);
    for (int n = 0; n < 10'000; ++n) {
      const double x = std::ldexp(any(random), n % 900 - 450), y = std::ldexp(-any(random), n % 70);
      const auto both = elementary::product(x, y);
      CHECK(both.high == x * y);
      CHECK(both.low == std::fma(x, y, -both.high));
    }
    for (const int power : {-1074, -1022, -30, 0, 7, 1023})
      CHECK(elementary::scaled(1.0, power) == std::ldexp(1.0, power));
  }

  TEST_CASE("quarter turns and their rest make up the angle") {
    for (const double x : {0.78, 0.79, 1.5707963267948966, -3.0, 355.0, 1e8, 0x1p30 - 1.0}) {
      const auto at = elementary::quarter_turns(x);
      CHECK(std::abs(at.high) < 0.786);
      CHECK(at.high + at.quarters * 1.5707963267948966 == doctest::Approx(x).epsilon(1e-15));
    }
  }
}
