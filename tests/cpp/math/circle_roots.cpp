/// Roots on the projective line against polynomials built from known roots.

#include "math/roots/circle_roots.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <complex>
#include <vector>

#include "support/support.hpp"

using namespace support;
using ninedof::circle_roots;
using ninedof::CircleRoots;
using ninedof::Octic;

namespace {

/// Product of factors (a x + b), real roots at -b / a, infinity where a = 0; missing degrees filled with x^2 + c^2, c
/// off zero.
Octic product(const std::vector<std::array<double, 2>>& factors, Random& random) {
  std::vector<double> p{1.0};
  const auto times = [&](const std::vector<double>& f) {
    std::vector<double> out(p.size() + f.size() - 1, 0.0);
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t j = 0; j < f.size(); ++j) out[i + j] += p[i] * f[j];
    p = out;
  };
  for (const auto& [a, b] : factors) times({b, a});
  while (p.size() < 9) {
    const double shift = random.uniform(-1.0, 1.0), height = random.uniform(0.3, 2.0);
    times({shift * shift + height * height, -2.0 * shift, 1.0});
  }
  Octic out;
  std::copy(p.begin(), p.end(), out.begin());
  return out;
}

/// Angle on the projective line, in (-pi/2, pi/2].
double angle(double x, double y) {
  double a = std::atan2(x, y);
  if (a > pi / 2) a -= pi;
  if (a <= -pi / 2) a += pi;
  return a;
}

double apart(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, pi - d);
}

}  // namespace

TEST_SUITE("circle_roots") {
  TEST_CASE("all real roots are found, and no others") {
    Random random(1);
    int certain = 0;
    for (int n = 0; n < 3000; ++n) {
      const int count = 2 * static_cast<int>(random.uniform(0.0, 4.99));
      std::vector<double> angles;
      while (static_cast<int>(angles.size()) < count) {
        const double a = random.uniform(-pi / 2, pi / 2);
        if (std::ranges::all_of(angles, [&](double b) { return apart(a, b) > 1e-3; })) angles.push_back(a);
      }
      std::vector<std::array<double, 2>> factors;
      for (const double a : angles) factors.push_back({std::cos(a), -std::sin(a)});  // root tan a
      const CircleRoots found = circle_roots(product(factors, random), 0.0);
      if (!found.certain) continue;
      ++certain;
      REQUIRE(found.count == count);
      for (const double a : angles) {
        double nearest = 1.0;
        for (int k = 0; k < found.count; ++k) {
          const auto& r = found.root[static_cast<std::size_t>(k)];
          CHECK(std::max(std::abs(r.x), std::abs(r.y)) == doctest::Approx(1.0));
          nearest = std::min(nearest, apart(a, angle(r.x, r.y)));
        }
        CHECK(nearest < 1e-5);
      }
    }
    CHECK(certain > 2900);
  }

  TEST_CASE("zero, infinity and one are ordinary roots") {
    Random random(2);
    for (const std::vector<std::array<double, 2>>& factors :
         {std::vector<std::array<double, 2>>{{1.0, 0.0}, {0.0, 1.0}},
          std::vector<std::array<double, 2>>{{1.0, -1.0}, {1.0, 1.0}},
          std::vector<std::array<double, 2>>{{1.0, 0.0}, {0.0, 1.0}, {1.0, -1.0}, {1.0, 1.0}},
          std::vector<std::array<double, 2>>{{1.0, 0.0}, {1.0, -1e-3}}}) {
      const CircleRoots found = circle_roots(product(factors, random), 0.0);
      CHECK(found.certain);
      CHECK(found.count == static_cast<int>(factors.size()));
    }
  }

  TEST_CASE("double roots are reported as uncertain") {
    Random random(3);
    for (int n = 0; n < 200; ++n) {
      const double a = random.uniform(-1.5, 1.5);
      const std::array<double, 2> f{std::cos(a), -std::sin(a)};
      CHECK_FALSE(circle_roots(product({f, f}, random), 0.0).certain);
      const std::array<double, 2> near{std::cos(a + 1e-9), -std::sin(a + 1e-9)};
      CHECK_FALSE(circle_roots(product({f, near}, random), 0.0).certain);
    }
  }

  TEST_CASE("coefficients that are zero or not finite give no roots") {
    CHECK_FALSE(circle_roots(Octic{}, 0.0).certain);
    Octic noise{};
    noise.fill(1e-15);
    CHECK_FALSE(circle_roots(noise, 1e-14).certain);
    Octic broken{};
    broken[3] = not_a_number;
    CHECK_FALSE(circle_roots(broken, 0.0).certain);
    broken[3] = infinity;
    CHECK_FALSE(circle_roots(broken, 0.0).certain);
  }
}
