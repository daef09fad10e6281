/// characteristic_length.hpp: the optimal length against a scan of the condition number over lengths, without
/// slopes or bisection; the other lengths by their definitions.

#include "ninedof/conditioning/characteristic_length.hpp"

#include <doctest/doctest.h>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/oracle.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

/// How much lower than at `length` the condition number is on a scan: coarse over eight decades, fine nearby.
double best_gain(const Robot& r, double length) {
  const double here = condition_number(r.geometry, r.configuration, length);
  double least = here;
  const auto look = [&](double factor) {
    least = std::min(least, condition_number(r.geometry, r.configuration, length * factor));
  };
  for (int k = -80; k <= 80; ++k) look(std::pow(10.0, 0.05 * k));
  for (const double step : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    look(1.0 + step);
    look(1.0 - step);
  }
  return here / least - 1.0;
}

}  // namespace

TEST_SUITE("characteristic_length") {
  TEST_CASE("no length on a scan is better than the optimal one: 1000 random robots, half of them symmetric") {
    // Symmetric robots have double singular values, where the slope jumps.
    Random random(121);
    double worst = 0.0;
    for (int n = 0; n < 1000; ++n) {
      const Robot robot = n % 2 == 0 ? random_robot(random) : random_symmetric_robot(random);
      const double length = characteristic_length(robot.geometry, robot.configuration);
      if (!(length > 0.0) || !std::isfinite(length)) worst = infinity;
      const double kappa = condition_number(robot.geometry, robot.configuration, length);
      worst = std::max(worst, best_gain(robot, length) / (64.0 * eps * kappa));
    }
    CHECK(worst <= 1.0);
  }

  TEST_CASE("nor for planar designs at the neutral configuration, with multiple extreme singular values") {
    Random random(122);
    double worst = 0.0;
    for (int n = 0; n < 300; ++n) {
      const double zp = random.uniform(1.0, 6.0);
      const Robot robot{Geometry::hexagonal(n % 3 == 0 ? 0.0 : random.uniform(0.0, 2.0), random.uniform(1.0, 6.0),
                                            random.uniform(0.5, 3.0), n % 5 == 0 ? 0.0 : random.uniform(0.0, 1.0)),
                        neutral(zp, zp * random.uniform(0.1, 0.9))};
      const double length = characteristic_length(robot.geometry, robot.configuration, LengthKind::optimal);
      const double kappa = condition_number(robot.geometry, robot.configuration, length);
      worst = std::max(worst, best_gain(robot, length) / (64.0 * eps * kappa));
    }
    CHECK(worst <= 1.0);
  }

  TEST_CASE("natural: the rotation and translation parts of (J' J'^T)^-1 have equal traces") {
    // M^T M = (J' J'^T)^-1, formed here from the oracle's J'.
    Random random(123);
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_robot(random);
      const double length = characteristic_length(g, c, LengthKind::natural);
      const oracle::Matrix j = oracle::jacobian(g, c, length);
      const oracle::Matrix inverse = oracle::inverse(oracle::product(j, j.transpose()));
      const long double rotation = inverse.topLeftCorner(3, 3).trace(),
                        translation = inverse.bottomRightCorner(3, 3).trace();
      CHECK(relative_error(static_cast<double>(rotation), static_cast<double>(translation)) <= 1e-13);
    }
  }

  TEST_CASE("mean leg and platform radius by their definitions") {
    Random random(124);
    for (int n = 0; n < 200; ++n) {
      const auto [g, c] = random_robot(random);
      const auto mean = static_cast<double>(oracle::leg_lengths(g, c).sum() / 9);
      CHECK(relative_error(characteristic_length(g, c, LengthKind::mean_leg), mean) <= 16.0 * eps);
      double radius = 0.0;
      for (const Triple* t : {&g.platform_external(), &g.platform_internal()})
        for (const Vec3& joint : *t) radius = std::max(radius, std::hypot(joint.x(), joint.y(), joint.z()));
      CHECK(relative_error(characteristic_length(g, c, LengthKind::platform_radius), radius) <= 4.0 * eps);
    }
  }

  TEST_CASE("every length scales with the robot") {
    Random random(125);
    for (int n = 0; n < 50; ++n) {
      const Robot robot = random_robot(random);
      for (const LengthKind kind :
           {LengthKind::mean_leg, LengthKind::platform_radius, LengthKind::natural, LengthKind::optimal}) {
        const double one = characteristic_length(robot.geometry, robot.configuration, kind);
        for (const double scale : {0x1p-100, 0x1p-20, 0x1p20, 0x1p100}) {  // exact
          const Robot other = scaled(robot, scale);
          CHECK(relative_error(characteristic_length(other.geometry, other.configuration, kind), scale * one) <= 1e-9);
        }
      }
    }
  }

  TEST_CASE("singular configurations: natural and optimal are NaN, the others finite") {
    const Geometry g = Geometry::hexagonal(0, 3, 2, 0);
    for (const Configuration& c : {neutral(2, 0), neutral(2, 2)}) {
      CHECK(std::isnan(characteristic_length(g, c, LengthKind::natural)));
      CHECK(std::isnan(characteristic_length(g, c, LengthKind::optimal)));
      CHECK(std::isfinite(characteristic_length(g, c, LengthKind::mean_leg)));
      CHECK(std::isfinite(characteristic_length(g, c, LengthKind::platform_radius)));
    }
    Configuration c = neutral(2, 1);
    c.position.x() = not_a_number;
    for (const LengthKind kind : {LengthKind::mean_leg, LengthKind::natural, LengthKind::optimal})
      CHECK(std::isnan(characteristic_length(g, c, kind)));
  }

  TEST_CASE("kinds by name") {
    CHECK(length_kind("mean_leg") == LengthKind::mean_leg);
    CHECK(length_kind("platform_radius") == LengthKind::platform_radius);
    CHECK(length_kind("natural") == LengthKind::natural);
    CHECK(length_kind("optimal") == LengthKind::optimal);
    CHECK(refuses("kind", [] { length_kind("unit"); }));
    CHECK(refuses("kind", [] { length_kind(""); }));
  }
}
