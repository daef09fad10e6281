/// constraints.hpp: margins against ratios taken by hand from the robot's joints and legs, gradients against differences.

#include "ninedof/constraints.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "ninedof/legs.hpp"
#include "support.hpp"

using namespace ninedof;
using namespace support;

namespace {

using Variables = std::array<double, 7>;

const DesignFamily& hexagonal() {
  return design_family("hexagonal");
}

DesignPoint evaluate(const Variables& x) {
  DesignPoint out;
  hexagonal().evaluate(x, 1.0, out);
  return out;
}

Variables random_variables(Random& random) {
  return {random.uniform(0.0, 2.0), random.uniform(1.0, 6.0), random.uniform(1.0, 3.0), random.uniform(0.0, 1.0),
          random.uniform(1.0, 6.0), random.uniform(0.2, 4.0), random.uniform(-0.5, 0.5)};
}

/// The three ratios from the robot itself.
struct Ratios {
  double radius, leg, zs;
};
Ratios ratios(const Variables& x) {
  const Geometry g = hexagonal().geometry(x);
  const Vec9 lengths = leg_lengths(g, hexagonal().configuration(x));
  return {g.base_external()[0].norm() / g.platform_external()[0].norm(), lengths.maxCoeff() / lengths.minCoeff(),
          x[5] / x[4]};
}

/// The worst of the margins that one limit asks for.
double worst(const Limit& limit, const DesignPoint& p) {
  double least = infinity;
  for (const Margin& m : margins({limit})) least = std::min(least, m.value(p));
  return least;
}

}  // namespace

TEST_SUITE("constraints") {
  TEST_CASE("a margin is the logarithm of what is left of a ratio, on either side") {
    Random random(131);
    for (int n = 0; n < 300; ++n) {
      const Variables x = random_variables(random);
      const DesignPoint p = evaluate(x);
      const Ratios r = ratios(x);
      const double bound = random.log_uniform(0.2, 5.0);
      const std::array<std::pair<std::string, double>, 3> named{
          {{"radius_ratio", r.radius}, {"leg_ratio", r.leg}, {"zs_fraction", r.zs}}};
      for (const auto& [name, ratio] : named) {
        CAPTURE(name);
        CHECK(std::abs(worst({.name = name, .high = bound}, p) - std::log(bound / ratio)) <= 64.0 * eps);
        CHECK(std::abs(worst({.name = name, .low = bound}, p) - std::log(ratio / bound)) <= 64.0 * eps);
        const double both = worst({.name = name, .low = 0.5 * bound, .high = bound}, p);
        CHECK(std::abs(both - std::min(std::log(bound / ratio), std::log(2.0 * ratio / bound))) <= 64.0 * eps);
      }
    }
  }

  TEST_CASE("gradients against differences, away from where the governing form changes") {
    Random random(132);
    const std::vector<Limit> limits{{"radius_ratio", 0.5, 2.0}, {"leg_ratio", 1.2, 3.0}, {"zs_fraction", 0.1, 0.9}};
    for (int n = 0; n < 100; ++n) {
      const Variables x = random_variables(random);
      for (const Margin& m : margins(limits)) {
        const DesignPoint p = evaluate(x);
        const Eigen::VectorXd gradient = m.gradient(p);
        REQUIRE(gradient.size() == 7);
        for (std::size_t k = 0; k < 7; ++k) {
          constexpr double h = 1e-4;
          bool kink = false;
          const auto at = [&](double steps) {
            Variables y = x;
            y[k] += steps * h;
            const DesignPoint there = evaluate(y);
            kink |= &m.governing(there) != &m.governing(p);
            return m.value(there);
          };
          const double expected = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
          if (!kink) CHECK(std::abs(gradient[static_cast<Eigen::Index>(k)] - expected) <= 1e-8);
        }
      }
    }
  }

  TEST_CASE("how many margins a limit makes: none for an open side, one form each, six for a least leg ratio") {
    CHECK(margins({}).empty());
    for (const std::string& name : constraint_names()) {
      CHECK(margins({{.name = name}}).empty());
      CHECK(margins({{.name = name, .low = -1.0}}).empty());
      for (const Margin& m : margins({{name, 0.5, 2.0}})) CHECK(m.name == name);
    }
    CHECK(margins({{"radius_ratio", 0.5, 2.0}}).size() == 2);
    CHECK(margins({{.name = "leg_ratio", .high = 3.0}}).size() == 6);
    const std::vector<Margin> some = margins({{.name = "leg_ratio", .low = 1.5}});
    REQUIRE(some.size() == 1);
    CHECK(some.front().forms.size() == 6);
  }

  TEST_CASE("limits that are none are refused by name") {
    for (const std::string& name : constraint_names()) {
      CAPTURE(name);
      const auto refused = [&](double low, double high) {
        return refuses(name, [&] { margins({{name, low, high}}); });
      };
      CHECK(refused(no_number, 1.0));
      CHECK(refused(0.0, no_number));
      CHECK(refused(2.0, 1.0));
      CHECK(refused(0.0, 0.0));
      CHECK(refused(-2.0, -1.0));
      CHECK(refused(0.0, -infinity));
      CHECK(refused(infinity, infinity));
    }
    CHECK(refuses("constraints", [] { margins({{.name = "radius", .high = 2.0}}); }));
    for (const std::string& name : constraint_names())
      CHECK(message_of([] { margins({{.name = "?", .high = 2.0}}); }).find(name) != std::string::npos);
  }
}
