/// Velocities at singular configurations, each built from its geometric condition and not from a determinant.

#include <doctest/doctest.h>

#include "ninedof/kinematics/velocity.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

Vec3 mean(const Triple& t) {
  return (t[0] + t[1] + t[2]) / 3.0;
}

/// A point in the plane of a triple, away from its centre.
Vec3 in_the_plane(const Triple& t) {
  return mean(t) + 0.31 * (t[1] - t[0]) - 0.17 * (t[2] - t[0]);
}

/// NaN, or too large to be mistaken for a result.
bool implausible(const auto& m) {
  return m.array().isNaN().any() || m.cwiseAbs().maxCoeff() > 1e12;
}

}  // namespace

TEST_SUITE("velocity_singular") {
  TEST_CASE("O in the plane of the base joints (det B = 0): NaN where exact, else very large") {
    const Geometry flat = Geometry::hexagonal(0.4, 3.0, 2.0, 0.3);
    const Configuration exact{Vec3(0.1, 0.2, 2.0), Mat3::Identity(), Vec3(0.3, -0.2, 0.0)};
    CHECK(all_nan(jacobian(flat, exact)));
    const VelocityMatrices m = velocity_matrices(flat, exact);
    CHECK(all_nan(m.G.rightCols<3>().bottomRows<3>()));
    CHECK(m.G.leftCols<6>().allFinite());
    const Velocity v = forward_velocity(flat, exact, Vec9::Ones());
    CHECK((!v.sdot.allFinite() && !v.pdot.allFinite() && !v.omega.allFinite()));

    Random random(68);
    for (int n = 0; n < 300; ++n) {
      auto [g, c] = random_robot(random);
      c.internal_point = in_the_plane(g.base_internal());
      CHECK(implausible(jacobian(g, c)));
      CHECK(implausible(forward_velocity(g, c, random.matrix<Vec9>()).sdot));
    }
  }

  TEST_CASE("O exactly in an oblique plane of joints: NaN, where a division would give infinity") {
    const Triple oblique{Vec3(2, -1, -1), Vec3(-1, 2, -1), Vec3(-1, -1, 2)};
    const Triple plate{Vec3(3, 0, 0), Vec3(-1, 2, 0), Vec3(-1, -2, 0)};
    const Geometry g(plate, oblique, plate, plate);
    const Velocity v = forward_velocity(g, {Vec3(0, 0, 3), Mat3::Identity(), Vec3::Zero()}, Vec9::Ones());
    CHECK(all_nan(v.sdot));
    CHECK(all_nan(v.omega));
    CHECK(all_nan(v.pdot));
  }

  TEST_CASE("O in the plane of the platform joints (det C = 0): only the velocity of O is determined") {
    const Geometry flat = Geometry::hexagonal(0.4, 3.0, 2.0, 0.3);
    const Configuration exact{Vec3(0.1, 0.2, 2.0), Mat3::Identity(), Vec3(0.3, -0.2, 2.0)};
    CHECK(all_nan(jacobian(flat, exact)));
    const Velocity v = forward_velocity(flat, exact, Vec9::Ones());
    CHECK((v.sdot.allFinite() && !v.pdot.allFinite() && !v.omega.allFinite()));

    Random random(69);
    for (int n = 0; n < 300; ++n) {
      auto [g, c] = random_robot(random);
      c.internal_point = c.position + c.rotation * in_the_plane(g.platform_internal());
      CHECK(implausible(jacobian(g, c)));
    }
  }

  TEST_CASE("O on the line of an external leg (det N = 0): NaN or very large, but the velocity of O is known") {
    Random random(70);
    for (int n = 0; n < 300; ++n) {
      auto [g, c] = random_robot(random);
      const Vec3 foot = g.base_external()[0], head = c.position + c.rotation * g.platform_external()[0];
      c.internal_point = foot + random.uniform(0.3, 0.7) * (head - foot);
      CHECK(implausible(jacobian(g, c)));
      const Velocity v = forward_velocity(g, c, random.matrix<Vec9>());
      CHECK(v.sdot.allFinite());
      CHECK(implausible(v.omega));
    }
  }

  TEST_CASE("approaching det C = 0: sdot keeps its digits, the platform's velocity grows as 1 / distance") {
    const Geometry flat = Geometry::hexagonal(0.4, 3.0, 2.0, 0.3);
    const auto at = [&](double distance) {
      return forward_velocity(flat, {Vec3(0.1, 0.2, 2.0), Mat3::Identity(), Vec3(0.3, -0.2, 2.0 - distance)},
                              Vec9::Unit(3));
    };
    const double expected = at(1e-4).pdot.norm() * 1e-4;
    for (const double distance : {0x1p-20, 0x1p-30, 0x1p-40, 0x1p-50}) {  // 2 - distance is exact
      CHECK(at(distance).sdot.norm() == 0.0);
      CHECK(at(distance).pdot.norm() * distance == doctest::Approx(expected).epsilon(1e-2));
    }
  }

  TEST_CASE("a leg of zero length: no Jacobian, rate 0") {
    Random random(71);
    auto [g, c] = random_robot(random);
    c.internal_point = g.base_internal()[1];
    CHECK(all_nan(jacobian(g, c)));
    const Vec9 rates = inverse_velocity(g, c, {random.unit(), random.unit(), random.unit()});
    CHECK(rates.allFinite());
    CHECK(rates[7] == 0.0);
  }
}
