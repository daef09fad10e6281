/// legs.hpp: lengths as plain distances, directions by the loop equations (11)-(13), the octahedral robot by hand.

#include "ninedof/robot/legs.hpp"

#include <doctest/doctest.h>

#include "support/oracle.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

TEST_SUITE("legs") {
  TEST_CASE("lengths are distances between joints, in the order l, q, r") {
    Random random(51);
    for (int n = 0; n < 1000; ++n) {
      const Robot robot = random_robot(random);
      const Vec9 lengths = leg_lengths(robot.geometry, robot.configuration);
      const oracle::Vector expected = oracle::leg_lengths(robot.geometry, robot.configuration);
      for (Eigen::Index k = 0; k < 9; ++k)
        CHECK(relative_error(lengths[k], static_cast<double>(expected[k])) <= 16.0 * eps);
      const Legs k = legs(robot.geometry, robot.configuration);
      CHECK(lengths.head<3>() == k.l);
      CHECK(lengths.segment<3>(3) == k.q);
      CHECK(lengths.tail<3>() == k.r);
    }
  }

  TEST_CASE("the loops of eqs. (11)-(13) close, unit vectors have the documented directions") {
    Random random(52);
    for (int n = 0; n < 500; ++n) {
      const auto [g, c] = random_robot(random);
      const Legs k = legs(g, c);
      const Vec3 v = c.position - c.internal_point;  // (10)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        CHECK((c.position + k.u[i] - k.l[row] * k.e[i] - g.base_external()[i]).norm() <= 32.0 * eps);
        CHECK((c.internal_point - k.r[row] * k.e_hat[i] - g.base_internal()[i]).norm() <= 32.0 * eps);
        CHECK((v + k.u_tilde[i] + k.q[row] * k.e_tilde[i]).norm() <= 32.0 * eps);
        for (const Triple* t : {&k.e, &k.e_tilde, &k.e_hat})
          CHECK((*t)[i].norm() == doctest::Approx(1.0).epsilon(4.0 * eps));
        CHECK((k.u[i] - c.rotation * g.platform_external()[i]).norm() <= 8.0 * eps);
        CHECK((k.u_tilde[i] - c.rotation * g.platform_internal()[i]).norm() <= 8.0 * eps);
      }
    }
  }

  TEST_CASE("the octahedral robot: internal legs 1, external legs sqrt 2") {
    const double side = std::sqrt(2.0), height = 1.0 / std::sqrt(3.0);
    const Vec9 lengths = leg_lengths(Geometry::hexagonal(0, side, side, 0), neutral(2.0 * height, height));
    for (Eigen::Index k = 0; k < 9; ++k) CHECK(lengths[k] == doctest::Approx(k < 3 ? side : 1.0).epsilon(4.0 * eps));
  }

  TEST_CASE("lengths scale with the robot from 1e-99 to 1e99, directions do not change") {
    Random random(53);
    for (int n = 0; n < 50; ++n) {
      const Robot robot = random_robot(random);
      const Legs one = legs(robot.geometry, robot.configuration);
      for (const double scale : {0x1p-328, 0x1p-40, 0x1p40, 0x1p328}) {  // powers of two: no rounding
        const Robot other = scaled(robot, scale);
        const Legs k = legs(other.geometry, other.configuration);
        CHECK(matrix_error(k.l, scale * one.l) <= 4.0 * eps);
        CHECK(matrix_error(k.q, scale * one.q) <= 4.0 * eps);
        CHECK(matrix_error(k.r, scale * one.r) <= 4.0 * eps);
        for (std::size_t i = 0; i < 3; ++i) CHECK((k.e[i] - one.e[i]).norm() <= 4.0 * eps);
      }
    }
  }

  TEST_CASE("a leg of zero length has length 0 and no direction; the others are not affected") {
    Random random(54);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      Robot robot = random_robot(random);
      Configuration& c = robot.configuration;
      c.rotation.setIdentity();
      c.internal_point = robot.geometry.base_internal()[i];
      Legs k = legs(robot.geometry, c);
      CHECK(k.r[row] == 0.0);
      CHECK(k.e_hat[i] == Vec3::Zero());
      CHECK(k.e_hat[(i + 1) % 3].norm() == doctest::Approx(1.0));

      c.position.setZero();
      c.internal_point = robot.geometry.platform_internal()[i];
      k = legs(robot.geometry, c);
      CHECK(k.q[row] == 0.0);
      CHECK(k.e_tilde[i] == Vec3::Zero());

      const Geometry coupled(robot.geometry.platform_external(), robot.geometry.base_internal(),
                             robot.geometry.platform_external(), robot.geometry.platform_internal());
      k = legs(coupled, c);
      CHECK(k.l == Vec3::Zero());
      CHECK(k.e[i] == Vec3::Zero());
    }
  }

  TEST_CASE(
      "idle: a change of 1e-9 of the longest leg and no more, whatever the length of the leg itself and the unit") {
    for (const double unit : {1e-6, 1.0, 350.0, 1e9}) {
      Vec9 shortest, longest;
      shortest << 1.0, 1e-6, 2.0, 3.0, 0.5, 0.25, 1.0, 1.0, 4.0;
      longest = shortest;
      longest[0] += 3.9e-9;  // of 4
      longest[1] += 3.9e-9;
      longest[2] += 4.1e-9;
      longest[3] += 1e-13;
      longest[4] += 1e-7;
      const std::array<bool, 9> idle = idle_legs(unit * shortest, unit * longest);
      CHECK(idle == std::array{true, true, false, true, false, true, true, true, true});
    }
  }

  TEST_CASE("NaN gives NaN") {
    Configuration c = neutral(2, 1);
    c.internal_point.x() = not_a_number;
    const Vec9 lengths = leg_lengths(Geometry::hexagonal(0, 3, 2, 0), c);
    CHECK(lengths.head<3>().allFinite());
    for (Eigen::Index k = 3; k < 9; ++k) CHECK(std::isnan(lengths[k]));
  }
}
