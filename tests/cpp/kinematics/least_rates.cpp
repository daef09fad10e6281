/// null_motion and internal_velocity against least squares in extended precision on the differentiated leg lengths,
/// which do not contain B, C or the platform point at O.

#include <doctest/doctest.h>

#include "ninedof/kinematics/velocity.hpp"
#include "support/oracle.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

using oracle::Matrix;
using oracle::Real;
using oracle::Vector;

Vector twist(const Vec3& omega, const Vec3& pdot) {
  Vec6 t;
  t << omega, pdot;
  return oracle::wide(t);
}

/// Rows times the roots of their weights.
Matrix weighted(Matrix m, const Vec9& weights) {
  for (Eigen::Index k = 0; k < 9; ++k) m.row(k) *= std::sqrt(static_cast<Real>(weights[k]));
  return m;
}

/// Least-norm solution of the weighted problem: the pseudo-inverse of all nine rates as functions of sdot.
Vec3 expected_sdot(const Robot& robot, const Vec3& omega, const Vec3& pdot, const Vec9& weights) {
  const Matrix rates = oracle::rates(robot.geometry, robot.configuration);
  const Vector fixed = oracle::product(rates.leftCols(6), twist(omega, pdot));
  return oracle::rounded(
      -oracle::least_squares(weighted(rates.rightCols(3), weights), weighted(fixed, weights), 1e-15L));
}

Vec9 random_weights(Random& random, double spread) {
  return Vec9::NullaryExpr([&] { return random.log_uniform(1.0 / spread, spread); });
}

/// A point in the plane of a triple, away from its centre.
Vec3 in_plane(const Triple& t) {
  return t[0] + 0.41 * (t[1] - t[0]) + 0.23 * (t[2] - t[0]);
}

const Geometry flat = Geometry::hexagonal(0.4, 3.0, 2.0, 0.3);

}  // namespace

TEST_SUITE("least_rates") {
  TEST_CASE("null motions are the derivatives of the leg lengths by O, and J' maps them to zero") {
    Random random(221);
    for (int n = 0; n < 200; ++n) {
      const Robot robot = random_robot(random);
      const auto& [g, c] = robot;
      const Mat93 rates = null_motion(g, c);
      CHECK(matrix_error(rates, oracle::rounded(oracle::rates(g, c).rightCols(3))) <= 16.0 * eps);
      CHECK(rates.topRows<3>().isZero(0.0));
      CHECK(oracle::rank(oracle::wide(rates)) == 3);
      const double lost = oracle::conditioning_of_rates(g, c);
      CHECK((jacobian(g, c) * rates).cwiseAbs().maxCoeff() <= 16.0 * eps * lost * jacobian(g, c).norm());
      const Vec3 sdot = random.matrix<Vec3>();
      CHECK((rates * sdot - inverse_velocity(g, c, {Vec3::Zero(), Vec3::Zero(), sdot})).norm() <= 16.0 * eps);
    }
  }

  TEST_CASE("internal velocity solves the least-squares problem for any weights") {
    Random random(222);
    for (int n = 0; n < 300; ++n) {
      const Robot robot = random_robot(random);
      const Vec3 omega = random.matrix<Vec3>(), pdot = random.matrix<Vec3>();
      const Vec9 weights = n % 2 == 0 ? Vec9(Vec9::Ones()) : random_weights(random, 100.0);
      const Vec3 found = internal_velocity(robot.geometry, robot.configuration, omega, pdot, weights);
      const Vec3 expected = expected_sdot(robot, omega, pdot, weights);
      const Matrix free = oracle::rates(robot.geometry, robot.configuration).rightCols(3);
      const double lost = oracle::conditioning_of(weighted(free, weights));
      CHECK((found - expected).norm() <= 64.0 * eps * lost * (omega.norm() + pdot.norm()));
      CHECK(internal_velocity(robot.geometry, robot.configuration, omega, pdot, 0x1p40 * weights) == found);
    }
  }

  TEST_CASE("with unit weights the leg rates are the pseudo-inverse of J' times the twist") {
    Random random(223);
    for (int n = 0; n < 200; ++n) {
      const auto [g, c] = random_robot(random);
      const double lc = random.log_uniform(0.1, 10.0);
      const Vec3 omega = random.matrix<Vec3>(), pdot = random.matrix<Vec3>();
      // The shortest solution of J' udot = t.
      const Vector expected = oracle::least_squares(oracle::jacobian(g, c, lc), twist(lc * omega, pdot), 0.0L);
      const Vec9 found = inverse_velocity(g, c, {omega, pdot, internal_velocity(g, c, omega, pdot)});
      const double lost = oracle::conditioning_of(oracle::rates(g, c).rightCols(3));
      CHECK((found - oracle::rounded(expected)).norm() <= 64.0 * eps * lost * (omega.norm() + pdot.norm()));
    }
  }

  TEST_CASE("the error grows with the condition number and not with its square") {
    Random random(224);
    for (const double height : {1e-2, 1e-4, 1e-6, 1e-8}) {
      // O close to both planes, which coincide: the components of C and B normal to them are of the size of that
      // height.
      for (int n = 0; n < 20; ++n) {
        const Configuration c{Vec3(0.1, 0.2, height * random.uniform(2.0, 3.0)), Mat3::Identity(),
                              Vec3(0.3, -0.2, height)};
        const Vec3 omega = random.matrix<Vec3>(), pdot = random.matrix<Vec3>();
        const Vec3 expected = expected_sdot({flat, c}, omega, pdot, Vec9::Ones());
        CHECK((internal_velocity(flat, c, omega, pdot) - expected).norm() <= 32.0 * eps / height * expected.norm());
      }
    }
  }

  TEST_CASE("finite where only B is singular, and where only C is") {
    Random random(225);
    for (int n = 0; n < 200; ++n) {
      for (const bool lower : {true, false}) {
        auto [g, c] = random_robot(random);
        c.internal_point =
            lower ? in_plane(g.base_internal()) : Vec3(c.position + c.rotation * in_plane(g.platform_internal()));
        const Vec3 omega = random.matrix<Vec3>(), pdot = random.matrix<Vec3>();
        const Vec9 weights = random_weights(random, 10.0);
        const double lost = 10.0 * oracle::conditioning_of(oracle::rates(g, c).rightCols(3));
        CHECK((internal_velocity(g, c, omega, pdot, weights) - expected_sdot({g, c}, omega, pdot, weights)).norm() <=
              64.0 * eps * lost * (omega.norm() + pdot.norm()));
      }
    }
  }

  TEST_CASE("where one is singular, the legs of the other determine the motion of O normal to the plane") {
    const Configuration in_base{Vec3(0.1, 0.2, 2.0), Mat3::Identity(), Vec3(0.3, -0.2, 0.0)};
    // The platform rises: the upper legs move O along, and the lower ones do not resist.
    CHECK(internal_velocity(flat, in_base, Vec3::Zero(), Vec3::UnitZ()).z() > 0.5);
    const Configuration in_platform{Vec3(0.1, 0.2, 2.0), Mat3::Identity(), Vec3(0.3, -0.2, 2.0)};
    // The lower legs hold O, and the rates of the upper ones do not depend on the platform rising.
    CHECK(internal_velocity(flat, in_platform, Vec3::Zero(), Vec3::UnitZ()).norm() <= 4.0 * eps);
  }

  TEST_CASE("both singular in one direction: the shortest solution, and leg rates that are still minimal") {
    const Configuration c{Vec3(0.1, 0.2, 0.0), Mat3::Identity(), Vec3(0.3, -0.2, 0.0)};
    Random random(226);
    for (int n = 0; n < 100; ++n) {
      const Vec3 omega = random.matrix<Vec3>(), pdot = random.matrix<Vec3>();
      const Vec9 weights = random_weights(random, 10.0);
      const Vec3 found = internal_velocity(flat, c, omega, pdot, weights);
      CHECK((found - expected_sdot({flat, c}, omega, pdot, weights)).norm() <= 1e-13 * (omega.norm() + pdot.norm()));
      CHECK(found.z() == 0.0);
    }
    CHECK(oracle::rank(oracle::wide(null_motion(flat, c))) == 2);
  }

  TEST_CASE("very different weights: large weights dominate, small ones determine the remaining direction") {
    // O in the platform's plane, upper legs with large weights: in the plane O follows the platform, normal to it the
    // lower legs with their small weights determine its motion.
    const Configuration c{Vec3(0.1, 0.2, 2.0), Mat3::Identity(), Vec3(0.3, -0.2, 2.0)};
    for (const double light : {1e-6, 1e-12, 1e-20, 1e-26}) {
      Vec9 weights = Vec9::Ones();
      weights.tail<3>().setConstant(light);
      const Vec3 pdot(0.3, -0.7, 0.2);
      const Vec3 found = internal_velocity(flat, c, Vec3::Zero(), pdot, weights);
      CHECK((found.head<2>() - pdot.head<2>()).norm() <= 10.0 * light + 8.0 * eps);
      // min over z of |B (pdot_x, pdot_y, z)|
      const Mat3 b = velocity_matrices(flat, c).B;
      const double z = -b.col(2).dot(b.leftCols<2>() * pdot.head<2>()) / b.col(2).squaredNorm();
      CHECK(found.z() == doctest::Approx(z).epsilon(10.0 * light + 1e-12));
    }
  }

  TEST_CASE("external weights have no effect; one that is not finite and positive is rejected by name") {
    Random random(227);
    const auto [g, c] = random_robot(random);
    const Vec3 omega = random.matrix<Vec3>(), pdot = random.matrix<Vec3>();
    Vec9 weights = random_weights(random, 10.0);
    const Vec3 one = internal_velocity(g, c, omega, pdot, weights);
    weights.head<3>() = Vec3(1e-200, 1e200, 3.0);
    CHECK(internal_velocity(g, c, omega, pdot, weights) == one);
    for (Eigen::Index k = 0; k < 9; ++k)
      for (const double bad : {0.0, -1.0, not_a_number, infinity}) {
        Vec9 wrong = Vec9::Ones();
        wrong[k] = bad;
        CHECK(refuses("weights", [&] { internal_velocity(g, c, omega, pdot, wrong); }));
      }
  }

  TEST_CASE("NaN in any argument gives NaN") {
    Random random(228);
    const auto [g, good] = random_robot(random);
    const Vec3 one = Vec3::Ones();
    for (Eigen::Index k = 0; k < 3; ++k) {
      Vec3 bad = one;
      bad[k] = not_a_number;
      CHECK(all_nan(internal_velocity(g, good, bad, one)));
      CHECK(all_nan(internal_velocity(g, good, one, bad)));
      Configuration c = good;
      c.internal_point[k] = not_a_number;
      CHECK(all_nan(internal_velocity(g, c, one, one)));
      c = good;
      c.position[k] = not_a_number;
      CHECK(all_nan(internal_velocity(g, c, one, one)));
      CHECK(all_nan(null_motion(g, c).middleRows<3>(3)));
    }
  }
}
