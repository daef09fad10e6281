/// design.hpp, the closed form on the axis: singular values against the general path, gradients against differences,
/// and invalid designs.

#include "ninedof/families/design_family.hpp"

#include <doctest/doctest.h>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/math/rotation.hpp"
#include "support/designs.hpp"

using namespace ninedof;
using namespace designs;

namespace {

AxisPoint axis_at(const std::string& family, const Eigen::VectorXd& x, double lc, const AxisShift& shift = {}) {
  AxisPoint out;
  design_family(family).axis(span(x), lc, shift, Machine::nine_legged, out);
  return out;
}

AxisShift random_shift(Random& random, const std::string& family, const Eigen::VectorXd& x) {
  const double zp = x[design_family(family).index("zp")], most = 0.15;
  return {zp * random.uniform(-most, most), zp * random.uniform(-most, most), random.uniform(-most, most),
          random.uniform(-most, most), random.uniform(-0.6, 0.6)};
}

/// The shifted configuration, by hand.
Configuration shifted(const std::string& family, const Eigen::VectorXd& x, const AxisShift& by) {
  const DesignFamily& f = design_family(family);
  Configuration c = f.configuration(span(x));
  const double zp = x[f.index("zp")];
  c.position.z() += by.p + zp * by.p_in_zp;
  c.internal_point.z() += by.s + zp * by.s_in_zp;
  c.rotation = rotation_about_z(by.turn) * c.rotation;
  return c;
}

/// Logarithms of the singular values of M at that configuration, by the general path, descending.
Vec6 log_sigma(const std::string& family, const Eigen::VectorXd& x, double lc, const AxisShift& by = {}) {
  const Vec6 of_jacobian = singular_values(design_family(family).geometry(span(x)), shifted(family, x, by), lc);
  return -of_jacobian.reverse().array().log();
}

Vec6 all_six(const AxisPoint& p) {
  Vec6 six;
  six << p.value, p.value[AxisPoint::transverse_max], p.value[AxisPoint::transverse_min];
  std::sort(six.begin(), six.end(), std::greater<>());
  return six;
}

}  // namespace

TEST_SUITE("design_family") {
  TEST_CASE("on the axis: the six singular values of the family's robot, at any point of the axis") {
    Random random(111);
    for (const std::string& name : axis_families)
      for (int n = 0; n < 500; ++n) {
        CAPTURE(name);
        const Eigen::VectorXd x = random_design(name, random);
        const double lc = random.log_uniform(0.1, 10.0);
        const AxisShift shift = n % 2 == 0 ? AxisShift{} : random_shift(random, name, x);
        const Vec6 expected = log_sigma(name, x, lc, shift);
        const double kappa = std::exp(expected[0] - expected[5]);
        CHECK((all_six(axis_at(name, x, lc, shift)) - expected).cwiseAbs().maxCoeff() <= 64.0 * eps * kappa);
      }
  }

  TEST_CASE("gradients against differences: random, tiny sides, coupled triangles, millimetres, displaced") {
    Random random(112);
    int compared = 0;
    for (const std::string& name : axis_families)
      for (int n = 0; n < 100; ++n) {
        Eigen::VectorXd x = random_design(name, random);
        const Eigen::Index own = x.size();
        AxisShift shift;
        double lc = random.uniform(0.6, 2.0), size = 1.0;
        if (n % 5 == 1 && name == "hexagonal") x[0] = x[3] = 0.0;
        if (n % 5 == 2 && name == "hexagonal") x[0] = x[3] = 1e-7;
        if (n % 5 == 3) shift = random_shift(random, name, x);
        if (n % 5 == 4) {
          lc *= size = 1e3;
          for (Eigen::Index k = 0; k < own; ++k)
            if (design_family(name).variables()[static_cast<std::size_t>(k)].kind != VariableKind::angle) x[k] *= size;
        }
        Eigen::VectorXd all(own + 1);
        all << x, lc;
        const AxisPoint p = axis_at(name, x, lc, shift);
        REQUIRE(p.gradient.cols() == own + 1);
        for (Eigen::Index k = 0; k <= own; ++k) {
          const bool angle =
              k < own && design_family(name).variables()[static_cast<std::size_t>(k)].kind == VariableKind::angle;
          const double scale = angle ? 1.0 : size;
          const auto values = [&](const Eigen::VectorXd& at) -> Eigen::VectorXd {
            return axis_at(name, at.head(own), at[own], shift).value;
          };
          const Eigen::VectorXd expected = difference(values, all, k, 1e-4 * scale);
          for (int row = 0; row < AxisPoint::rows; ++row) {
            // Next to the kink at zero, and where a pair meets, differences are too coarse.
            const bool axial = row < AxisPoint::transverse_max;
            const double within = axial ? p.value[0] - p.value[1] : p.value[2] - p.value[3];
            if (p.value[row] < std::log(0.05) || within < 0.1) continue;
            CAPTURE(name);
            CAPTURE(n);
            CAPTURE(k);
            CAPTURE(row);
            CHECK(std::abs(p.gradient(row, k) - expected[row]) * scale <= 1e-7);
            ++compared;
          }
        }
      }
    CHECK(compared > 5000);
  }

  TEST_CASE("vanishing singular values are 1e-300 with zero gradient") {
    const Eigen::VectorXd x{{1, 2, 2, 1, 3, 0, 0}};  // O in the base: no leg resists it along z
    const AxisPoint p = axis_at("hexagonal", x, 1.0);
    CHECK(p.value[AxisPoint::axial_min] == std::log(1e-300));
    CHECK(p.gradient.row(AxisPoint::axial_min).isZero(0.0));
    CHECK_FALSE(p.gradient.row(AxisPoint::axial_max).isZero(0.0));
    CHECK(p.value.allFinite());
    CHECK(p.gradient.allFinite());
  }

  TEST_CASE("designs with NaN or infinity have no finite condition number") {
    for (const std::string& name : axis_families)
      for (const Machine machine : {Machine::nine_legged, Machine::six_legged}) {
        Random random(113);
        const Eigen::VectorXd good = random_design(name, random);
        for (Eigen::Index k = 0; k < good.size(); ++k)
          for (const double bad : {not_a_number, infinity}) {
            // O is no part of the six-legged platform.
            if (machine == Machine::six_legged && k == design_family(name).index("zs")) continue;
            Eigen::VectorXd x = good;
            x[k] = bad;
            CAPTURE(name);
            CAPTURE(k);
            CAPTURE(bad);
            AxisPoint p;
            design_family(name).axis(span(x), 1.0, {}, machine, p);
            const double kappa = std::exp(std::max(p.value[0], p.value[2]) - std::min(p.value[1], p.value[3]));
            CHECK_FALSE((kappa < 1e12));
          }
      }
  }

  TEST_CASE("throws: invalid characteristic length, too few or too many variables, a family without axis") {
    Random random(114);
    for (const std::string& name : axis_families) {
      const Eigen::VectorXd x = random_design(name, random);
      for (const double bad : {0.0, -1.0, not_a_number, infinity})
        CHECK(refuses("characteristic_length", [&] { axis_at(name, x, bad); }));
      CHECK(refuses("x", [&] { axis_at(name, x.head(x.size() - 1), 1.0); }));
      CHECK(refuses("x", [&] { axis_at(name, Eigen::VectorXd::Ones(x.size() + 1), 1.0); }));
      CHECK(refuses("x", [&] { axis_at(name, Eigen::VectorXd{}, 1.0); }));
    }
    CHECK(refuses("family", [&] { axis_at("general", random_design("general", random), 1.0); }));
  }
}
