/// velocity.hpp against finite differences of leg lengths, against the complex-step oracle (which uses neither the
/// paper's matrices nor the closed form), and against the identities of eqs. (30)-(36).

#include "ninedof/kinematics/velocity.hpp"

#include <doctest/doctest.h>

#include "ninedof/robot/legs.hpp"
#include "support/oracle.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

Velocity random_velocity(Random& random) {
  return {random.matrix<Vec3>(), random.matrix<Vec3>(), random.matrix<Vec3>()};
}

Vec9 tangent(const Velocity& v, double time) {
  Vec9 t;
  t << v.omega, v.pdot, v.sdot;
  return time * t;
}

Vec6 twist(const Velocity& v, double characteristic_length) {
  Vec6 t;
  t << characteristic_length * v.omega, v.pdot;
  return t;
}

/// Fourth-order central difference of the leg lengths along a motion.
Vec9 differenced_rates(const Geometry& g, const Configuration& c, const Velocity& v) {
  constexpr double h = 1e-3;
  const auto at = [&](double step) { return leg_lengths(g, plus(c, tangent(v, step * h))); };
  return (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
}

}  // namespace

TEST_SUITE("velocity") {
  TEST_CASE("A to G are the matrices of eqs. (30)-(35), entry by entry") {
    Random random(61);
    for (int n = 0; n < 100; ++n) {
      const auto [g, c] = random_robot(random);
      const double lc = random.log_uniform(0.1, 10.0);
      const VelocityMatrices v = velocity_matrices(g, c, lc);
      for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Vec3 u = c.rotation * g.platform_external()[k], u_tilde = c.rotation * g.platform_internal()[k];
        const Vec3 e = (c.position + u - g.base_external()[k]).normalized();
        const Vec3 e_tilde = (c.internal_point - c.position - u_tilde).normalized();
        const Vec3 e_hat = (c.internal_point - g.base_internal()[k]).normalized();
        CHECK((v.A.row(i).head<3>().transpose() - u.cross(e) / lc).norm() <= 32.0 * eps / lc);
        CHECK((v.A.row(i).tail<3>().transpose() - e).norm() <= 8.0 * eps);
        CHECK((v.B.row(i).transpose() - e_hat).norm() <= 8.0 * eps);
        CHECK((v.C.row(i).transpose() - e_tilde).norm() <= 8.0 * eps);
        CHECK((v.D.row(i).transpose() - u_tilde.cross(e_tilde) / lc).norm() <= 32.0 * eps / lc);
      }
      CHECK(v.E.leftCols<3>() == v.D);
      CHECK(v.E.rightCols<3>() == v.C);
      CHECK(v.F.topRows<3>() == v.A);
      CHECK(v.F.bottomRows<3>() == v.E);
      Mat69 expected = Mat69::Zero();
      expected.topLeftCorner<3, 3>().setIdentity();
      expected.block<3, 3>(3, 3) = -Mat3::Identity();
      expected.block<3, 3>(3, 6) =
          oracle::rounded(oracle::product(oracle::wide(v.C), oracle::inverse(oracle::wide(v.B))));
      CHECK(matrix_error(v.G, expected) <= 1e-13);
    }
  }

  TEST_CASE("inverse velocity is the derivative of the leg lengths along plus()") {
    Random random(62);
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_robot(random);
      const Velocity v = random_velocity(random);
      const Vec9 rates = inverse_velocity(g, c, v);
      CHECK((rates - differenced_rates(g, c, v)).cwiseAbs().maxCoeff() <= 1e-9);
      const oracle::Matrix expected = oracle::product(oracle::rates(g, c), oracle::wide(tangent(v, 1.0)));
      CHECK((rates - oracle::rounded(expected)).cwiseAbs().maxCoeff() <= 64.0 * eps);
    }
  }

  TEST_CASE("F t = G udot for every motion and any characteristic length") {
    Random random(63);
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_robot(random);
      const double lc = random.log_uniform(0.01, 100.0);
      const Velocity v = random_velocity(random);
      const VelocityMatrices m = velocity_matrices(g, c, lc);
      const Vec6 right = m.G * inverse_velocity(g, c, v);
      CHECK((m.F * twist(v, lc) - right).norm() <= 1e-12 * std::max(1.0, m.G.norm()));
    }
  }

  TEST_CASE("J' against the inverse of the differentiated leg lengths, and against F^-1 G") {
    Random random(64);
    for (int n = 0; n < 1000; ++n) {
      const auto [g, c] = random_robot(random);
      const double lc = random.log_uniform(0.1, 10.0);
      const oracle::Matrix expected = oracle::jacobian(g, c, lc);
      const Mat69 j = jacobian(g, c, lc);
      // The error grows with the condition numbers of the three systems behind J'; each half is measured separately.
      const VelocityMatrices m = velocity_matrices(g, c, lc);
      const double tolerance = 16.0 * eps * oracle::conditioning_of_rates(g, c);
      CHECK(matrix_error(j.topRows<3>(), oracle::rounded(expected.topRows(3))) <= tolerance);
      CHECK(matrix_error(j.bottomRows<3>(), oracle::rounded(expected.bottomRows(3))) <= tolerance);
      CHECK(matrix_error(j, oracle::rounded(oracle::solve(oracle::wide(m.F), oracle::wide(m.G)))) <= 16.0 * tolerance);
    }
  }

  TEST_CASE("the characteristic length multiplies the angular rows only") {
    Random random(65);
    const auto [g, c] = random_robot(random);
    const Mat69 one = jacobian(g, c), eight = jacobian(g, c, 8.0);
    CHECK(eight.topRows<3>() == 8.0 * one.topRows<3>());
    CHECK(eight.bottomRows<3>() == one.bottomRows<3>());
  }

  TEST_CASE("forward velocity undoes inverse velocity, and is J' udot") {
    Random random(66);
    for (int n = 0; n < 500; ++n) {
      const auto [g, c] = random_robot(random);
      const Velocity v = random_velocity(random);
      const Vec9 rates = inverse_velocity(g, c, v);
      const Velocity back = forward_velocity(g, c, rates);
      const double tolerance = 64.0 * eps * oracle::conditioning_of_rates(g, c);
      CHECK((tangent(back, 1.0) - tangent(v, 1.0)).norm() <= tolerance * tangent(v, 1.0).norm());
      CHECK((jacobian(g, c, 0.7) * rates - twist(v, 0.7)).norm() <= tolerance * tangent(v, 1.0).norm());
    }
  }

  TEST_CASE("with powers of two as units of length the bits are the same, from 1e-90 to 1e90") {
    Random random(72);
    for (int n = 0; n < 20; ++n) {
      const Robot robot = random_robot(random);
      const Vec9 rates = random.matrix<Vec9>();
      const Velocity one = forward_velocity(robot.geometry, robot.configuration, rates);
      const Mat69 j = jacobian(robot.geometry, robot.configuration);
      for (const double scale : {0x1p-300, 0x1p-20, 0x1p20, 0x1p300}) {
        const auto [g, c] = scaled(robot, scale);
        const Velocity v = forward_velocity(g, c, scale * rates);
        CHECK(v.omega == one.omega);
        CHECK(v.pdot == scale * one.pdot);
        CHECK(v.sdot == scale * one.sdot);
        CHECK(jacobian(g, c, scale) == j);
      }
    }
  }

  TEST_CASE("differences of leg lengths along the forward velocity give the rates back") {
    Random random(67);
    for (int n = 0; n < 100; ++n) {
      const auto [g, c] = random_robot(random);
      const Vec9 rates = 0.1 * random.matrix<Vec9>();
      const Velocity v = forward_velocity(g, c, rates);
      if (tangent(v, 1.0).norm() > 3.0) continue;  // differences too coarse close to a singularity
      CHECK((differenced_rates(g, c, v) - rates).cwiseAbs().maxCoeff() <= 1e-8);
    }
  }

  TEST_CASE("NaN gives NaN; an invalid characteristic length is rejected by name") {
    Configuration c = neutral(2, 1);
    const Geometry g = Geometry::hexagonal(0, 3, 2, 0);
    for (const double bad : {0.0, -1.0, not_a_number, infinity}) {
      CHECK(refuses("characteristic_length", [&] { jacobian(g, c, bad); }));
      CHECK(refuses("characteristic_length", [&] { velocity_matrices(g, c, bad); }));
    }
    c.position.y() = not_a_number;
    CHECK(all_nan(jacobian(g, c)));
    CHECK(all_nan(forward_velocity(g, c, Vec9::Ones()).omega));
  }
}
