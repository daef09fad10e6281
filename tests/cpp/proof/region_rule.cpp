/// region_rule.hpp: the polynomial at a point of a box lies within what its forms allow. Oracle: long double, term by
/// term, at random points.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ninedof/math/error.hpp"
#include "proof/region/rule.hpp"

using namespace ninedof::over_region;
using ninedof::CurvedForm;
using ninedof::PointRule;
using ninedof::PoseForm;

namespace {

using Numbers = std::array<long double, PoseForm::size>;

/// A rule of a random number of terms up to a degree, in no order and with terms missing.
PointRule random_rule(std::mt19937_64& random, int degree) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  PointRule out;
  for (double& x : out.scale) x = std::exp2(std::round(8.0 * any(random)));
  const int terms = 1 + static_cast<int>(random() % 40);
  for (int n = 0; n < terms; ++n) {
    std::array<int, PoseForm::size> powers{};
    for (int k = 0; k < degree; ++k)
      if (any(random) > -0.3) ++powers[random() % PoseForm::size];
    if (std::ranges::find(out.powers, powers) != out.powers.end()) continue;
    out.powers.push_back(powers);
    out.coefficients.push_back(ninedof::Vec3(any(random), 1e3 * any(random), 1e-3 * any(random)));
  }
  return out;
}

std::array<long double, 3> exact(const PointRule& rule, const Numbers& at) {
  std::array<long double, 3> out{};
  for (std::size_t n = 0; n < rule.powers.size(); ++n) {
    long double product = 1.0L;
    for (std::size_t k = 0; k < PoseForm::size; ++k)
      product *= std::pow(at[k] / rule.scale[static_cast<Eigen::Index>(k)], rule.powers[n][k]);
    for (std::size_t i = 0; i < 3; ++i) out[i] += product * rule.coefficients[n][static_cast<Eigen::Index>(i)];
  }
  return out;
}

}  // namespace

TEST_SUITE("region_rule") {
  TEST_CASE_TEMPLATE("the rule at points of a box is within the error of its forms", T, PoseForm, CurvedForm) {
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int trial = 0; trial < 4'000; ++trial) {
      const PointRule rule = random_rule(random, trial % 7);
      const RuleForms forms(rule);
      const double size = trial % 5 == 0 ? 0.0 : std::exp(10.0 * any(random) - 10.0);
      std::array<T, T::size> at;
      Numbers value;
      std::array<double, PoseForm::size> t;
      const bool path = trial % 4 == 1;  // the first three coordinates go along one direction
      for (std::size_t k = 0; k < PoseForm::size; ++k) {
        const double scale = rule.scale[static_cast<Eigen::Index>(k)];
        const double low = scale * any(random), high = low + scale * size * std::abs(any(random));
        t[k] = trial % 3 == 0 ? std::copysign(1.0, any(random)) : any(random);
        at[k] = T::coordinate(low, high, k);
        value[k] = 0.5L * (static_cast<long double>(low) + high) + 0.5L * (static_cast<long double>(high) - low) * t[k];
        if (path && (k == 1 || k == 2)) {
          const double slope = any(random);
          at[k] = low + slope * at[0];
          value[k] = low + slope * value[0];
        }
      }
      const ninedof::Xyz<T> found = forms.shift(at);
      const std::array<long double, 3> wanted = exact(rule, value);
      for (std::size_t i = 0; i < 3; ++i) {
        const T& form = i == 0 ? found.x : i == 1 ? found.y : found.z;
        long double linear = form.c;
        for (std::size_t k = 0; k < PoseForm::size; ++k) linear += static_cast<long double>(form.a[k]) * t[k];
        for (std::size_t k = 0, n = 0; k < T::size && T::curved; ++k)
          for (std::size_t l = 0; l <= k; ++l, ++n) linear += static_cast<long double>(form.q[n]) * t[k] * t[l];
        CHECK(std::abs(wanted[i] - linear) <= form.r);
        CHECK(lower(form) <= wanted[i]);
        CHECK(wanted[i] <= upper(form));
      }
    }
  }

  TEST_CASE("errors fall with the square of the box, and terms that cancel leave none") {
    PointRule rule;
    // (x + y - 1)^3 = 0 in the middle, with all its derivatives but one
    const std::array<std::array<double, 3>, 10> cubic{{{3, 0, 1},
                                                       {2, 1, 3},
                                                       {1, 2, 3},
                                                       {0, 3, 1},
                                                       {2, 0, -3},
                                                       {1, 1, -6},
                                                       {0, 2, -3},
                                                       {1, 0, 3},
                                                       {0, 1, 3},
                                                       {0, 0, -1}}};
    for (const auto& [a, b, c] : cubic) {
      rule.powers.push_back({static_cast<int>(a), static_cast<int>(b), 0, 0, 0, 0});
      rule.coefficients.push_back(ninedof::Vec3(c, 0.0, 0.0));
    }
    const RuleForms forms(rule);
    const auto error = [&](double half) {
      std::array<PoseForm, PoseForm::size> at;
      for (std::size_t k = 0; k < 2; ++k) at[k] = PoseForm::coordinate(0.5 - half, 0.5 + half, k);
      return forms.shift(at).x.r;
    };
    CHECK(error(0.1) == doctest::Approx(8e-3));  // (2 half)^3
    CHECK(error(0.01) == doctest::Approx(8e-6));
  }

  TEST_CASE("what is no rule is named") {
    PointRule rule;
    CHECK_THROWS_WITH_AS(rule.validate(), doctest::Contains("rule.coefficients"), ninedof::InvalidArgument);
    rule.powers = {{3, 4, 0, 0, 0, 0}};
    rule.coefficients = {ninedof::Vec3::Ones()};
    CHECK_THROWS_WITH_AS(rule.validate(), doctest::Contains("rule.powers"), ninedof::InvalidArgument);
    rule.powers = {{1, 0, 0, 0, 0, 0}, {1, 0, 0, 0, 0, 0}};
    rule.coefficients = {ninedof::Vec3::Ones(), ninedof::Vec3::Ones()};
    CHECK_THROWS_WITH_AS(rule.validate(), doctest::Contains("rule.powers: got a term twice"), ninedof::InvalidArgument);
    rule.powers.pop_back();
    rule.coefficients.pop_back();
    CHECK_NOTHROW(rule.validate());
    rule.scale[2] = 0.0;
    CHECK_THROWS_WITH_AS(rule.validate(), doctest::Contains("rule.scale"), ninedof::InvalidArgument);
    rule.scale[2] = 1.0;
    rule.coefficients[0][1] = std::nan("");
    CHECK_THROWS_WITH_AS(rule.validate(), doctest::Contains("rule.coefficients"), ninedof::InvalidArgument);
  }
}
