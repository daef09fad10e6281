/// ranges.hpp: the checker's steps to the neighbouring doubles are those of the C library; results hold exact ones.

#include "proof/checker/ranges.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace ninedof::checker;

TEST_SUITE("ranges") {
  TEST_CASE("steps to the neighbouring doubles") {
    const auto agrees = [](double x) {
      CHECK(std::bit_cast<std::uint64_t>(up(x)) == std::bit_cast<std::uint64_t>(std::nextafter(x, inf)));
      CHECK(down(x) == std::nextafter(x, -inf));
    };
    using Limits = std::numeric_limits<double>;
    for (const double x : {0.0, 1.0, Limits::denorm_min(), Limits::min(), Limits::max(), inf, 2.0, 0x1p52})
      for (const double sign : {1.0, -1.0}) agrees(sign * x);
    std::mt19937_64 random(7);
    for (int n = 0; n < 100'000; ++n)
      if (const double x = std::bit_cast<double>(random()); !std::isnan(x)) agrees(x);
    CHECK(up(std::nan("")) == inf);
    CHECK(down(std::nan("")) == -inf);
  }

  TEST_CASE("products and quotients") {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> any(-1.0, 1.0), part(0.0, 1.0);
    const auto inside = [&](const Range& x) { return std::clamp(x.a + part(random) * (x.b - x.a), x.a, x.b); };
    for (int n = 0; n < 100'000; ++n) {
      const double low = any(random), other = any(random);
      const Range x{low, low + part(random)}, y{other, other + part(random)};
      const long double a = inside(x), b = inside(y);
      const Range product = x * y, quotient = x / y;
      CHECK((product.a <= a * b && a * b <= product.b));
      CHECK((quotient.a <= a / b && a / b <= quotient.b));
    }
    CHECK((Range(0.0, inf) * Range(0.0, 1.0)).b == inf);
    CHECK(Range(1.0) / Range(-1.0, 1.0) == Range(-inf, inf));
  }
}
