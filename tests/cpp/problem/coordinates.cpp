/// full_variables.hpp and coordinates.hpp of the library's sources: the full set of variables and the solver's
/// coordinates.

#include "problem/coordinates.hpp"

#include <doctest/doctest.h>

#include "support/studies.hpp"

using namespace ninedof;
using namespace studies;

namespace {

constexpr double size_limit = 1e4;

Problem of_family(const std::string& family) {
  Problem p;
  p.family = family;
  for (const auto& v : design_family(family).variables()) p.variables.push_back({v.low, v.high});
  return p;
}

Pose with_free_point(const Vec3& position, const Vec3& rotation = Vec3::Zero()) {
  return {.position = position, .rotation = rotation, .best_internal = true};
}

/// Every kind of variable at once: lengths, angles, heights of either sign, a free length, s chosen on and off the
/// axis.
Problem everything() {
  Problem p = of_family("symmetric_nonplanar");
  p.variables[2] = {-1.0, 2.0};
  p.variables[4] = {0.3, 0.3};
  p.variables[10] = {0.0, 0.5};
  p.characteristic_length = {.choice = StudyLength::Choice::free, .bounds = {0.5, 4.0}};
  p.objective.poses = {with_free_point({0.0, 0.0, 0.1}), Pose{}, with_free_point({0.1, 0.0, 0.0}),
                       with_free_point(Vec3::Zero(), {0.0, 0.1, 0.0})};
  return p;
}

}  // namespace

TEST_SUITE("coordinates") {
  TEST_CASE("names: the family's variables, the length where it is free, s where the optimizer chooses it") {
    Problem p = everything();
    std::vector<std::string> expected;
    for (const auto& v : design_family(p.family).variables()) expected.push_back(v.name);
    CHECK(of_family(p.family).names() == expected);
    for (const char* name : {"characteristic_length", "pose1.s_z", "pose3.s_x", "pose3.s_y", "pose3.s_z", "pose4.s_x",
                             "pose4.s_y", "pose4.s_z"})
      expected.emplace_back(name);
    CHECK(p.names() == expected);
    CHECK(length_variable(p) == 13);
    CHECK(offset_variables(p, 0) == std::array{-1, -1, 14});  // on the axis symmetry keeps s there
    CHECK(offset_variables(p, 1) == std::array{-1, -1, -1});
    CHECK(offset_variables(p, 2) == std::array{15, 16, 17});
    CHECK(offset_variables(p, 3) == std::array{18, 19, 20});

    p.characteristic_length = {.choice = StudyLength::Choice::kind, .kind = LengthKind::optimal};
    CHECK(p.names() == expected);
    for (const LengthKind kind : {LengthKind::mean_leg, LengthKind::natural, LengthKind::platform_radius}) {
      p.characteristic_length.kind = kind;
      CHECK(length_variable(p) == -1);
      CHECK_FALSE(contains(p.names(), "characteristic_length"));
      CHECK(offset_variables(p, 0) == std::array{-1, -1, 13});
    }
    Problem general = of_family("general");  // has no axis
    general.objective.poses = {with_free_point({0.0, 0.0, 0.1})};
    CHECK(general.names().back() == "pose1.s_z");
    CHECK(general.names().size() == 39 + 3);
  }

  TEST_CASE("bounds of the study and internal bounds") {
    Problem p = everything();
    for (const Variable& v : full_variables(p)) CHECK(v.internal_bounds == v.name.starts_with("pose"));
    CHECK(full_variables(p)[13].bounds.low == 0.5);
    CHECK(full_variables(p)[13].bounds.high == 4.0);
    p.characteristic_length = {.choice = StudyLength::Choice::kind, .kind = LengthKind::optimal};
    CHECK(full_variables(p)[13].internal_bounds);
    const Coordinates c(p, size_limit);
    for (int k = 0; k < c.size(); ++k) {
      CAPTURE(c.info(k).name);
      CHECK(c.internal_low(k) == c.info(k).internal_bounds);
      CHECK(c.internal_high(k) == c.info(k).internal_bounds);
    }
  }

  TEST_CASE("round trip: variables -> coordinates -> variables, in metres and in millimetres") {
    Random random(231);
    for (const double unit : {1.0, 1000.0}) {
      Problem p = of_family("symmetric_nonplanar");
      for (std::size_t k = 0; k < p.variables.size(); ++k)
        if (std::isfinite(p.variables[k].low)) {
          p.variables[k].low *= unit;
          p.variables[k].high *= unit;
        }
      p.characteristic_length.value = unit;
      p.variables[4] = {0.3, 0.3};
      const Coordinates c(p, size_limit * unit);
      CHECK(c.size() == 12);
      CHECK(c.coordinate(4) == -1);
      for (int n = 0; n < 200; ++n) {
        Eigen::VectorXd x(13);
        for (Eigen::Index k = 0; k < 13; ++k) {
          const Bounds& b = p.variables[static_cast<std::size_t>(k)];
          x[k] = std::isfinite(b.low) ? random.uniform(b.low, b.high) : random.uniform(-pi, pi);
        }
        const Eigen::VectorXd y = c.coordinates(x);
        const Eigen::VectorXd back = c.variables(y);
        CHECK(back[4] == 0.3);
        CHECK((back - x).cwiseAbs().maxCoeff() <= 1e-14 * x.cwiseAbs().maxCoeff());
        CHECK((c.coordinates(back) - y).cwiseAbs().maxCoeff() <= 1e-13);
        CHECK((y.array() >= c.low().array()).all());
        CHECK((y.array() <= c.high().array()).all());
      }
    }
  }

  TEST_CASE("bounds are met exactly, from the bound itself, within rounding of it and beyond it") {
    const Problem p = everything();
    const Coordinates c(p, size_limit);
    const std::vector<Variable> all = full_variables(p);
    for (const double off : {0.0, 5e-14, -5e-14, -1.0}) {
      const Eigen::VectorXd low = c.variables(c.low().array() + off), high = c.variables(c.high().array() - off);
      for (int k = 0; k < c.size(); ++k) {
        const Variable& v = all[static_cast<std::size_t>(c.variable(k))];
        CAPTURE(v.name);
        if (!std::isfinite(c.low()[k])) continue;
        if (std::isfinite(v.bounds.low)) CHECK(low[c.variable(k)] == v.bounds.low);
        if (std::isfinite(v.bounds.high)) CHECK(high[c.variable(k)] == v.bounds.high);
      }
    }
    Eigen::VectorXd far = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(all.size()), 1e9);
    CHECK(c.coordinates(far) == c.high().cwiseMin(1e9));
    CHECK(c.coordinates(-far) == c.low().cwiseMax(-1e9));
  }

  TEST_CASE("an angle with bounds a full turn apart, or none, goes round; variables stay within its bounds") {
    Random random(233);
    for (const auto& [low, high, round] : {std::tuple{-pi, pi, true},
                                           {0.3, 0.3 + 2.0 * pi, true},
                                           {-2.0, 5.0, true},
                                           {-infinity, infinity, true},
                                           {1.0, infinity, true},
                                           {-infinity, 1.0, true},
                                           {-pi, 3.0, false},
                                           {0.0, 1.0, false}}) {
      Problem p = of_family("hexagonal");
      p.variables[6] = {low, high};
      const Coordinates c(p, size_limit);
      CHECK(std::isfinite(c.low()[6]) != round);
      CHECK(std::isfinite(c.high()[6]) != round);
      for (int n = 0; n < 100; ++n) {
        Eigen::VectorXd y = c.start(n, 3);
        const double inside = c.variables(y)[6];
        if (low == -infinity && high == infinity) CHECK(std::abs(inside) <= pi);
        else CHECK(inside == y[6]);
        y[6] += 2.0 * pi * std::round(random.uniform(-3.0, 3.0));
        const double x = c.variables(y)[6];
        CHECK((x >= low && x <= high));
        if (round) CHECK(std::abs(std::remainder(x - inside, 2.0 * pi)) <= 1e-14);
      }
    }
  }

  TEST_CASE("sizes without bounds get internal ones: the size limit") {
    Problem p = of_family("symmetric_nonplanar");
    p.variables[7].high = infinity;
    p.variables[9] = {-infinity, 1e8};
    const Coordinates c(p, size_limit);
    const Eigen::VectorXd high = c.variables(c.high()), low = c.variables(c.low());
    CHECK(high[7] == size_limit);
    CHECK(low[7] == 0.05);
    CHECK(high[9] == size_limit);
    CHECK(low[9] == -size_limit);
    CHECK((c.internal_high(7) && !c.internal_low(7) && c.internal_high(9) && c.internal_low(9)));
  }

  TEST_CASE("slopes against differences") {
    const Problem p = everything();
    const Coordinates c(p, size_limit);
    Eigen::VectorXd y = 0.5 * (c.low() + c.high()) + 0.1 * (c.high() - c.low());
    for (double& value : y)
      if (!std::isfinite(value)) value = 0.7;  // an angle that goes round
    const Eigen::VectorXd slopes = c.slopes(c.variables(y));
    for (int k = 0; k < c.size(); ++k) {
      constexpr double h = 1e-4;
      const auto at = [&](double steps) { return c.variables(y + steps * h * Eigen::VectorXd::Unit(c.size(), k)); };
      const Eigen::VectorXd expected = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
      CHECK(slopes[k] == doctest::Approx(expected[c.variable(k)]).epsilon(1e-9));
      CHECK(std::abs(expected.sum() - expected[c.variable(k)]) <= 1e-9);  // and nothing else moves
    }
  }

  TEST_CASE("the order of zs and zp, with either of them fixed") {
    for (const int fixed : {-1, 4, 5}) {
      Problem p = of_family("hexagonal");
      if (fixed >= 0) p.variables[static_cast<std::size_t>(fixed)] = {3.0, 3.0};
      const Coordinates c(p, size_limit);
      for (const auto& [zp, zs] : {std::pair{3.0, 2.9}, {3.1, 3.0}, {3.0, 3.1}, {2.9, 3.0}}) {
        Eigen::VectorXd x{{0, 6, 3, 0, zp, zs, 0}};
        if (fixed >= 0) x[fixed] = 3.0;
        if (x[4] == x[5]) continue;
        CHECK((c.order_margin(c.coordinates(x)) > 0.0) == (x[5] < x[4]));
      }
    }
  }

  TEST_CASE("starts: inside bounds and order; s at its stated position, an optimal length at half the height") {
    Problem p = everything();
    p.characteristic_length = {.choice = StudyLength::Choice::kind, .kind = LengthKind::optimal};
    const Coordinates c(p, size_limit);
    for (int n = 0; n < 100; ++n) {
      const Eigen::VectorXd y = c.start(n, 7), x = c.variables(y);
      CHECK((y.array() >= c.low().array()).all());
      CHECK((y.array() <= c.high().array()).all());
      CHECK(x[8] < x[7]);
      CHECK(x[13] == doctest::Approx(0.5 * x[7]).epsilon(1e-13));
      CHECK(x.tail(7).isZero(0.0));
    }
  }

  TEST_CASE("plain coordinates are the variables") {
    const Problem p = everything();
    const Coordinates c = Coordinates::plain(p);
    Random random(232);
    const auto n = static_cast<Eigen::Index>(p.names().size());
    const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(n, [&] { return random.uniform(-1e6, 1e6); });
    CHECK(c.variables(x) == x);
    CHECK(c.coordinates(x) == x);
    CHECK(c.slopes(x) == Eigen::VectorXd::Ones(n));
    CHECK(c.length_variable() == 13);
    for (int k = 0; k < c.size(); ++k) CHECK(c.coordinate(k) == k);
  }

  TEST_CASE("an incomplete set throws, naming the argument") {
    const Problem p = everything();
    const auto n = static_cast<Eigen::Index>(p.names().size());
    require_full("warm", p, Eigen::VectorXd::Ones(n));
    CHECK(refuses("warm", [&] { require_full("warm", p, Eigen::VectorXd::Ones(n - 1)); }));
    CHECK(refuses("warm", [&] { require_full("warm", p, Eigen::VectorXd::Ones(n + 1)); }));
    CHECK(refuses("warm", [&] { require_full("warm", p, Eigen::VectorXd::Constant(n, not_a_number)); }));
  }
}
