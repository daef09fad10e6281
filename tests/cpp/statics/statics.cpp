/// statics.hpp against the complex-step oracle, which uses no leg directions, and against sums of forces and moments
/// joint by joint; singular configurations of all three kinds, units, bad input.

#include "ninedof/statics/statics.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "support/oracle.hpp"
#include "support/singular.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

Load random_load(Random& random) {
  return {random.matrix<Vec3>(), random.matrix<Vec3>(), random.matrix<Vec3>()};
}

Vec9 stacked(const Load& load) {
  Vec9 v;
  v << load.moment, load.force, load.force_at_o;
  return v;
}

/// The sum of leg forces f and `load` on the platform (moment about p, force) and on O.
Vec9 left_over(const Robot& robot, const Vec9& f, const Load& load) {
  const auto& [g, c] = robot;
  Load sum = load;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Vec3 u = c.rotation * g.platform_external()[i], u_tilde = c.rotation * g.platform_internal()[i];
    const Vec3 on_platform = f[k] * (c.position + u - g.base_external()[i]).normalized();
    const Vec3 on_o = f[k + 3] * (c.internal_point - c.position - u_tilde).normalized();
    sum.moment += u.cross(on_platform) - u_tilde.cross(on_o);
    sum.force += on_platform - on_o;
    sum.force_at_o += on_o + f[k + 6] * (c.internal_point - g.base_internal()[i]).normalized();
  }
  return stacked(sum);
}

}  // namespace

TEST_SUITE("statics") {
  TEST_CASE("leg forces: balance joint by joint, and H^T f + load = 0 with the differentiated lengths") {
    Random random(401);
    for (int n = 0; n < 500; ++n) {
      const Robot robot = random_robot(random);
      const Load load = random_load(random);
      const auto [f, unbalanced] = leg_forces(robot.geometry, robot.configuration, load);
      CHECK(left_over(robot, f, load).norm() <= 256.0 * eps * (1.0 + f.norm()));
      const oracle::Matrix h = oracle::rates(robot.geometry, robot.configuration);
      const oracle::Matrix expected = oracle::solve(h.transpose(), oracle::wide(-stacked(load)));
      CHECK(matrix_error(f, oracle::rounded(expected)) <=
            64.0 * eps * oracle::conditioning_of_rates(robot.geometry, robot.configuration));
      CHECK(stacked(unbalanced) == Vec9::Zero());
    }
  }

  TEST_CASE("singular configurations: forces of least norm balance what they can, the rest works on the free motion") {
    Random random(402);
    for (int n = 0; n < 300; ++n) {
      const Robot robot = random_singular_robot(random, n % 3);
      const auto& [g, c] = robot;
      const Load load = random_load(random);
      const auto [f, unbalanced] = leg_forces(g, c, load);
      CHECK(stacked(unbalanced).norm() > 1e-9);
      CHECK(left_over(robot, f, load).isApprox(stacked(unbalanced), 1e-6));
      const SelfStress stress = self_stress(g, c);
      REQUIRE(stress.cols() == 1);
      CHECK(std::abs(stress.col(0).dot(f)) <= 1e-12 * f.norm());
      CHECK(left_over(robot, stress.col(0), {}).norm() <= 1e-13);
      CHECK(std::abs(stress.norm() - 1.0) <= 1e-14);
      // The load without this part is balanced exactly.
      const Load rest{load.moment - unbalanced.moment, load.force - unbalanced.force,
                      load.force_at_o - unbalanced.force_at_o};
      CHECK(stacked(leg_forces(g, c, rest).unbalanced) == Vec9::Zero());
    }
  }

  TEST_CASE("regular configurations have no self-stress; one exists when the external legs meet in O") {
    Random random(403);
    for (int n = 0; n < 100; ++n) {
      const auto [g, c] = random_robot(random);
      CHECK(self_stress(g, c).cols() == 0);
    }
    const Geometry similar = Geometry::hexagonal(1.0, 4.0, 0.5, 2.0);
    CHECK(self_stress(similar, neutral(3.0, 2.0, pi)).cols() == 3);
  }

  TEST_CASE("ranks and forces do not depend on the length unit") {
    Random random(404);
    for (int n = 0; n < 60; ++n) {
      const Robot robot = n % 2 == 0 ? random_robot(random) : random_singular_robot(random, (n / 2) % 3);
      const Load load = random_load(random);
      const auto expected = leg_forces(robot.geometry, robot.configuration, load);
      for (const double scale : {1e-6, 1e-3, 25.4, 1e6}) {
        const Robot other = scaled(robot, scale);
        const auto found =
            leg_forces(other.geometry, other.configuration, {scale * load.moment, load.force, load.force_at_o});
        CHECK(matrix_error(found.forces, expected.forces) <= 1e-7);
        CHECK((found.unbalanced.force - expected.unbalanced.force).norm() <= 1e-9);
        CHECK((found.unbalanced.moment / scale - expected.unbalanced.moment).norm() <= 1e-8);
        CHECK(self_stress(other.geometry, other.configuration).cols() == n % 2);
      }
    }
  }

  TEST_CASE("stiffness inverts J diag(1/k) J^T, and with O held is H^T diag(k) H") {
    Random random(405);
    for (int n = 0; n < 300; ++n) {
      const Robot robot = random_robot(random);
      const auto& [g, c] = robot;
      const Vec9 k = Vec9::NullaryExpr([&] { return random.log_uniform(0.1, 10.0); });
      const oracle::Matrix j = oracle::jacobian(g, c, 1.0), h = oracle::rates(g, c);
      const oracle::Matrix weights = oracle::wide(k);
      const oracle::Matrix expected = oracle::inverse(oracle::congruence(j, weights.cwiseInverse()));
      const Mat6 found = stiffness(g, c, k);
      CHECK(matrix_error(found, oracle::rounded(expected)) <=
            64.0 * eps * oracle::conditioning_of_rates(robot.geometry, robot.configuration));
      CHECK(found == found.transpose());
      const oracle::Matrix held = oracle::congruence(h.transpose(), weights);
      CHECK(matrix_error(stiffness_with_o(g, c, k), oracle::rounded(held)) <= 64.0 * eps);
      CHECK(stiffness_with_o(g, c, k) == stiffness_with_o(g, c, k).transpose());
    }
  }

  TEST_CASE("singular configurations: stiffness is finite and zero in one direction; zero without legs") {
    Random random(406);
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_singular_robot(random, n % 3);
      const Mat6 k = stiffness(g, c, Vec9::Constant(3.0));
      const Eigen::VectorXd values = oracle::symmetric_eigenvalues(k);
      CHECK(std::abs(values[0]) <= 1e-13 * values[5]);
      CHECK(values[1] > 1e-9 * values[5]);
    }
    const auto [g, c] = random_robot(random);
    CHECK(stiffness(g, c, Vec9::Zero()) == Mat6::Zero());
  }

  TEST_CASE("NaN gives NaN; negative and infinite stiffness are rejected") {
    Random random(407);
    auto [g, c] = random_robot(random);
    Vec9 k = Vec9::Ones();
    for (const double bad : {-1.0, infinity, -infinity}) {
      k[4] = bad;
      CHECK(refuses("leg_stiffness", [&] { stiffness(g, c, k); }));
      CHECK(refuses("leg_stiffness", [&] { stiffness_with_o(g, c, k); }));
    }
    k[4] = not_a_number;
    CHECK(all_nan(stiffness(g, c, k)));
    CHECK(all_nan(leg_forces(g, c, {Vec3(0, not_a_number, 0), Vec3::Zero(), Vec3::Zero()}).forces));
    c.internal_point.z() = not_a_number;
    CHECK(all_nan(leg_forces(g, c, random_load(random)).forces));
    CHECK(all_nan(leg_forces(g, c, {}).unbalanced.force));
    CHECK(all_nan(self_stress(g, c)));
    CHECK(all_nan(stiffness(g, c, Vec9::Ones())));
  }

  TEST_CASE("a leg of zero length carries nothing") {
    Random random(408);
    auto [g, c] = random_robot(random);
    c.internal_point = g.base_internal()[2];
    const auto [f, unbalanced] = leg_forces(g, c, random_load(random));
    CHECK(f[8] == 0.0);
    CHECK(f.allFinite());
    CHECK(self_stress(g, c).row(8).norm() == doctest::Approx(1.0).epsilon(1e-14));
  }

  TEST_CASE("the least stiffness: of Schur complements by inverses, and no direction is softer") {
    Random random(409);
    for (int n = 0; n < cases(40); ++n) {
      const auto [g, c] = random_robot(random);
      const Vec9 k = Vec9::NullaryExpr([&] { return random.uniform(0.5, 3.0); });
      const LeastStiffness found = least_stiffness(g, c, k);
      const Eigen::Matrix<double, 6, 6> compliance = stiffness(g, c, k).inverse();
      // The platform free to turn: the inverse of the block of the compliance.
      for (int way = 0; way < 500; ++way) {
        const Vec3 d = random.unit();
        const double shift = d.dot(compliance.bottomRightCorner<3, 3>().inverse() * d);
        const double turn = d.dot(compliance.topLeftCorner<3, 3>().inverse() * d);
        CHECK(shift >= found.shift * (1.0 - 1e-8));
        CHECK(turn >= found.turn * (1.0 - 1e-8));
      }
      const Eigen::EigenSolver<Mat3> shifts(Mat3(compliance.bottomRightCorner<3, 3>()));
      const Eigen::EigenSolver<Mat3> turns(Mat3(compliance.topLeftCorner<3, 3>()));
      CHECK(relative_error(found.shift, 1.0 / shifts.eigenvalues().real().maxCoeff()) < 1e-8);
      CHECK(relative_error(found.turn, 1.0 / turns.eigenvalues().real().maxCoeff()) < 1e-8);
    }
    auto [g, c] = random_robot(random);
    CHECK(refuses("leg_stiffness", [&] { least_stiffness(g, c, -Vec9::Ones()); }));
    c.internal_point.z() = not_a_number;
    CHECK(std::isnan(least_stiffness(g, c, Vec9::Ones()).shift));
  }

  TEST_CASE("the weight acts at the centre of mass") {
    Random random(410);
    const Mat3 q = random.rotation();
    const Weight weight{3.0, random.matrix<Vec3>(), random.matrix<Vec3>()};
    const Load load = weight.at(q);
    const Vec3 arm = q * weight.centre;
    CHECK((load.force - 3.0 * weight.gravity).norm() < 1e-14);
    CHECK(std::abs(load.moment.dot(arm)) < 1e-13);
    const Vec3 turn = random.unit();  // the power of the moment is that of the force at the moved centre
    CHECK(load.moment.dot(turn) == doctest::Approx(load.force.dot(turn.cross(arm))));
  }
}
