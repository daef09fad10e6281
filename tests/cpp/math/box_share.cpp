/// box_share.hpp: shares of a box beyond planes, and hulls that hold what is beyond them. Oracle: the share integrated
/// over two coordinates in long double, exactly along the third; directions that would show a point outside a hull.

#include "math/box_share.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace ninedof;
using namespace ninedof::forms;

namespace {

constexpr int steps = 300;

long double integrated(const Slope3& a, double level) {
  long double sum = 0.0L;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const long double x = (2 * i + 1.0L) / steps - 1.0L, y = (2 * j + 1.0L) / steps - 1.0L;
      const long double rest = level - a[0] * x - a[1] * y, slope = std::abs(a[2]);
      sum += slope > 0.0L ? std::clamp((rest / slope + 1.0L) / 2.0L, 0.0L, 1.0L) : rest > 0.0L ? 1.0L : 0.0L;
    }
  return sum / (steps * steps);
}

double product(const Slope3& a, const Slope3& t) {
  return a[0] * t[0] + a[1] * t[1] + a[2] * t[2];
}

}  // namespace

TEST_SUITE("box_share") {
  TEST_CASE("shares of planes along the sides are exact") {
    for (const double scale : {1.0, 1e-150, 1e150})
      for (std::size_t k = 0; k < 3; ++k) {
        Slope3 a{};
        a[k] = -3.0 * scale;
        const Interval half = share_below(a, 0.0), quarter = share_below(a, -1.5 * scale);
        CHECK(contains(half, 0.5));
        CHECK(contains(quarter, 0.25));
        CHECK(width(quarter) < 1e-14);
      }
    CHECK(share_below({0.0, 0.0, 0.0}, 1.0).lo == 1.0);
    CHECK(share_below({0.0, 0.0, 0.0}, -1.0).hi == 0.0);
    CHECK(share_below({1.0, 1.0, 1.0}, INFINITY).lo == 1.0);
    CHECK(share_below({1.0, 1.0, 1.0}, -INFINITY).hi == 0.0);
    CHECK(share_below({1.0, NAN, 1.0}, 0.0).lo == 0.0);
    // A corner: the simplex of legs 1/2, 1/3, 1/4 of the sides.
    const Interval corner = share_below({2.0, 3.0, 4.0}, -7.0);
    CHECK(contains(corner, 1.0 / 6.0 / 8.0 / (2.0 * 3.0 * 4.0) * 8.0));
    CHECK(width(corner) < 1e-15);
  }

  TEST_CASE("shares of random planes hold the integral") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int trial = 0; trial < 300; ++trial) {
      Slope3 a;
      for (double& x : a) x = any(random) * std::pow(10.0, 4.0 * std::min(any(random), 0.0));
      std::swap(a[2], *std::ranges::max_element(a, {}, [](double x) { return std::abs(x); }));
      const double level = 1.2 * any(random) * reach(a);
      const Interval share = share_below(a, level), rest = share_below({-a[0], -a[1], -a[2]}, -level);
      const double value = static_cast<double>(integrated(a, level));
      CHECK(share.lo - 1e-4 < value);
      CHECK(value < share.hi + 1e-4);
      CHECK(share.lo <= 1.0 - rest.lo);
      CHECK(share.hi >= 1.0 - rest.hi);
      CHECK(width(share) < 3e-3);
    }
  }

  TEST_CASE("hulls hold every point beyond a plane") {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int trial = 0; trial < 2'000; ++trial) {
      Slope3 a, t, way;
      for (double& x : a) x = any(random) * std::pow(10.0, 6.0 * std::min(any(random), 0.0));
      for (double& x : t) x = trial % 2 == 0 ? any(random) : std::copysign(1.0, any(random));
      for (double& x : way) x = any(random);
      const double level = product(a, t) - (trial % 3 == 0 ? 0.0 : 0.1 * std::abs(any(random)) * reach(a));
      double most = -INFINITY, least = INFINITY;
      for (const Slope3& point : hull_above(a, level)) {
        most = std::max(most, product(way, point));
        least = std::min(least, product(a, point));
        for (const double x : point) CHECK(std::abs(x) <= 1.0);
      }
      CHECK(most >= product(way, t) - 1e-12);
      CHECK(least >= level - 1e-12 * (reach(a) + std::abs(level)));
    }
    CHECK(hull_above(Slope3{1.0, 1.0, 1.0}, 3.1).empty());
  }
}
