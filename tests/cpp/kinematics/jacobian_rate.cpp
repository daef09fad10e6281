/// The derivative of J' in time against differences of the oracle's J', a general inverse in extended precision, along
/// the motion; and against accelerations: together they are the derivative of the twist.

#include <doctest/doctest.h>

#include <cmath>

#include "support/motion.hpp"

using namespace ninedof;
using namespace support;

namespace {

using Real = oracle::Real;

/// J' at time t of the motion with constant omega, pdot and sdot, by the oracle.
oracle::Matrix jacobian_at(const Robot& robot, const Velocity& v, double t, double characteristic_length) {
  return oracle::jacobian(robot.geometry, plus(robot.configuration, t * stacked(v)), characteristic_length);
}

}  // namespace

TEST_SUITE("jacobian_rate") {
  TEST_CASE("the derivative of J' is that of the oracle's J' along the motion, both halves relative to their size") {
    Random random(205);
    for (int n = 0; n < 200; ++n) {
      const Robot robot = random_robot(random);
      const double conditioning = conditioning_of(robot);
      if (conditioning > 300.0) continue;  // differences too coarse
      const Velocity v = random_motion(random).v;
      const double lc = random.log_uniform(0.1, 10.0), h = 1e-3 / conditioning;
      const auto at = [&](double t) { return jacobian_at(robot, v, t, lc); };
      const oracle::Matrix difference =
          (45 * (at(h) - at(-h)) - 9 * (at(2 * h) - at(-2 * h)) + (at(3 * h) - at(-3 * h))) /
          (60 * static_cast<Real>(h));
      const Mat69 found = jacobian_rate(robot.geometry, robot.configuration, v, lc);
      const double tolerance = 1e-9;  // plus() rounds each configuration of the differences to double
      CHECK(matrix_error(found.topRows<3>(), difference.topRows(3).cast<double>()) <= tolerance);
      CHECK(matrix_error(found.bottomRows<3>(), difference.bottomRows(3).cast<double>()) <= tolerance);
    }
  }

  TEST_CASE("tdot = J' uddot + (d/dt J') udot for any motion of O and any characteristic length") {
    Random random(206);
    for (int n = 0; n < 500; ++n) {
      const Robot robot = random_robot(random);
      const auto& [g, c] = robot;
      const Motion m = random_motion(random);
      const double lc = random.log_uniform(0.01, 100.0);
      const Vec9 rates = inverse_velocity(g, c, m.v), accelerations = inverse_acceleration(g, c, m.v, m.a);
      const Vec6 found = jacobian(g, c, lc) * accelerations + jacobian_rate(g, c, m.v, lc) * rates;
      const double lost = std::pow(conditioning_of(robot), 2.0),
                   size = stacked(m.a).norm() + stacked(m.v).squaredNorm();
      CHECK((found.head<3>() / lc - m.a.alpha).norm() <= 64.0 * eps * lost * size);
      CHECK((found.tail<3>() - m.a.pddot).norm() <= 64.0 * eps * lost * size);
    }
  }

  TEST_CASE("the derivative of J' is linear in the velocity, and its angular rows in the characteristic length") {
    Random random(207);
    const auto [g, c] = random_robot(random);
    const Velocity v = random_motion(random).v, w = random_motion(random).v;
    const Velocity sum{v.omega + 2.0 * w.omega, v.pdot + 2.0 * w.pdot, v.sdot + 2.0 * w.sdot};
    const Mat69 one = jacobian_rate(g, c, v), eight = jacobian_rate(g, c, v, 8.0);
    CHECK(matrix_error(one + 2.0 * jacobian_rate(g, c, w), jacobian_rate(g, c, sum)) <= 1e-12);
    CHECK(eight.topRows<3>() == 8.0 * one.topRows<3>());
    CHECK(eight.bottomRows<3>() == one.bottomRows<3>());
    CHECK(jacobian_rate(g, c, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}).isZero(0.0));
  }
}
