/// design.hpp and hexagonal_family.hpp: quantities against the general path (Geometry, legs, singular values of M), gradients
/// against differences, and what must not come out of designs that are none.

#include "ninedof/design.hpp"

#include <doctest/doctest.h>

#include "ninedof/conditioning.hpp"
#include "ninedof/hexagonal_family.hpp"
#include "ninedof/legs.hpp"
#include "support.hpp"

using namespace ninedof;
using namespace support;

namespace {

using Variables = std::array<double, 7>;
using Quantities = Eigen::Matrix<double, quantity_count, 1>;

const DesignFamily& hexagonal() {
  return design_family("hexagonal");
}

DesignPoint evaluate(const Variables& x, double lc = 1.0) {
  DesignPoint out;
  hexagonal().evaluate(x, lc, out);
  return out;
}

Variables random_variables(Random& random) {
  return {random.uniform(0.0, 2.0), random.uniform(2.0, 6.0), random.uniform(1.0, 3.0), random.uniform(0.0, 1.0),
          random.uniform(3.0, 6.0), random.uniform(0.5, 2.5), random.uniform(-0.5, 0.5)};
}

double radius(const Triple& a, const Triple& b) {
  double most = 0.0;
  for (const Triple* t : {&a, &b})
    for (const Vec3& joint : *t) most = std::max(most, joint.head<2>().norm());
  return most;
}

}  // namespace

TEST_SUITE("design") {
  TEST_CASE("quantities are those of the robot the family builds") {
    Random random(111);
    for (int n = 0; n < 1000; ++n) {
      const Variables x = random_variables(random);
      const double lc = random.log_uniform(0.1, 10.0);
      const Geometry g = hexagonal().geometry(x);
      const Configuration c = hexagonal().configuration(x);
      const DesignPoint p = evaluate(x, lc);
      const Vec6 sigma = singular_values(g, c, lc);
      const double kappa = condition_number(g, c, lc), tolerance = 64.0 * eps * kappa;
      CHECK(std::abs(p.log_condition_number() - std::log(kappa)) <= tolerance);
      CHECK(std::abs(p.value[p.extremes().max] + std::log(sigma[5])) <= tolerance);
      CHECK(std::abs(p.value[p.extremes().min] + std::log(sigma[0])) <= tolerance);
      const Vec9 lengths = leg_lengths(g, c);
      CHECK(std::abs(p.value[log_l] - std::log(lengths[1])) <= 32.0 * eps);
      CHECK(std::abs(p.value[log_q] - std::log(lengths[4])) <= 32.0 * eps);
      CHECK(std::abs(p.value[log_r] - std::log(lengths[7])) <= 32.0 * eps);
      CHECK(std::abs(p.value[log_base_radius] - std::log(radius(g.base_external(), g.base_internal()))) <= 32.0 * eps);
      CHECK(std::abs(p.value[log_platform_radius] - std::log(radius(g.platform_external(), g.platform_internal()))) <=
            32.0 * eps);
      CHECK(p.value[log_zp] == std::log(x[4]));
      CHECK(p.value[log_zs] == std::log(x[5]));
    }
  }

  TEST_CASE("gradients against differences: random, tiny sides, the neutral coupled design, millimetres") {
    Random random(112);
    for (int n = 0; n < 200; ++n) {
      Variables x = random_variables(random);
      double lc = 1.0;
      if (n % 4 == 1) x[0] = x[3] = 0.0;
      if (n % 4 == 2) x[0] = x[3] = 1e-7;
      if (n % 4 == 3) {
        lc = 1e3;
        for (std::size_t k = 0; k < 6; ++k) x[k] *= lc;
      }
      const DesignPoint p = evaluate(x, lc);
      for (std::size_t k = 0; k < 7; ++k) {
        const double h = k == 6 ? 1e-4 : 1e-4 * lc;
        const auto at = [&](double steps) -> Quantities {
          Variables y = x;
          y[k] += steps * h;
          return evaluate(y, lc).value;
        };
        const Quantities expected = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
        for (int q = 0; q < quantity_count; ++q) {
          CAPTURE(n);
          CAPTURE(k);
          CAPTURE(q);
          const double scale = k == 6 ? 1.0 : lc;
          if (p.value[q] < std::log(0.05)) continue;  // next to the kink at zero, differences are too coarse
          CHECK(std::abs(p.gradient(q, static_cast<Eigen::Index>(k)) - expected[q]) * scale <= 1e-8);
        }
      }
      const auto [max, min] = p.extremes();
      CHECK(p.log_condition_number_gradient() == (p.gradient.row(max) - p.gradient.row(min)).transpose());
    }
  }

  TEST_CASE("extremes: of two equal singular values the axial one") {
    DesignPoint p;
    p.value.setZero();
    CHECK(p.extremes().max == log_axial_max);
    CHECK(p.extremes().min == log_axial_min);
    p.value[log_transverse_max] = 0.5;
    p.value[log_transverse_min] = -0.25;
    CHECK(p.extremes().max == log_transverse_max);
    CHECK(p.extremes().min == log_transverse_min);
    CHECK(p.log_condition_number() == 0.75);
  }

  TEST_CASE("what vanishes is given as 1e-300 with no slope") {
    const DesignPoint p = evaluate({0, 0, 2, 1, 3, 0, 0});
    CHECK(p.value[log_base_radius] == doctest::Approx(std::log(1e-300)));
    CHECK(p.value[log_zs] == doctest::Approx(std::log(1e-300)));
    CHECK(p.gradient.row(log_base_radius).isZero(0.0));
    CHECK(p.value.allFinite());
    CHECK(p.gradient.allFinite());
  }

  TEST_CASE("a design of NaN or infinity has no plausible condition number") {
    for (std::size_t k = 0; k < 7; ++k)
      for (const double bad : {no_number, infinity}) {
        Variables x{0.0, 6.0, 3.0, 0.0, 5.0, 3.0, 0.0};
        x[k] = bad;
        CAPTURE(k);
        CAPTURE(bad);
        const double kappa = std::exp(evaluate(x).log_condition_number());
        CHECK_FALSE((kappa < 1e12));
      }
  }

  TEST_CASE("evaluate refuses a characteristic length that is none, and too few or too many variables") {
    DesignPoint out;
    for (const double bad : {0.0, -1.0, no_number, infinity})
      CHECK(refuses("characteristic_length", [&] { evaluate({0.0, 6.0, 3.0, 0.0, 5.0, 3.0, 0.0}, bad); }));
    for (const std::size_t count : {0, 6, 8}) {
      const std::vector<double> x(count, 1.0);
      CHECK(refuses("x", [&] { hexagonal().evaluate(x, 1.0, out); }));
    }
  }

  TEST_CASE("families by name") {
    CHECK(design_family_names() == std::vector<std::string>{"hexagonal"});
    CHECK(hexagonal().name() == "hexagonal");
    CHECK(refuses("family", [] { design_family("hexagon"); }));
    CHECK(message_of([] { design_family(""); }).find("\"hexagonal\"") != std::string::npos);
    const std::vector<std::string> names{"a1", "a2", "b1", "b2", "zp", "zs", "theta_z"};
    const auto& variables = hexagonal().variables();
    REQUIRE(variables.size() == names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      CHECK(variables[k].name == names[k]);
      CHECK(variables[k].is_angle == (names[k] == "theta_z"));
      CHECK(variables[k].low <= variables[k].high);
    }
    CHECK(refuses("a1", [] { hexagonal().geometry(Variables{-1, 1, 1, 1, 2, 1, 0}); }));
    CHECK(refuses("b1, b2", [] { hexagonal().geometry(Variables{1, 1, 0, 0, 2, 1, 0}); }));
  }
}
