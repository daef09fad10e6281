/// ellipsoid.hpp against the singular values and vectors of J' from the complex-step oracle, by leg forces of norm 1,
/// and at singular configurations by the motion that moves no leg.

#include "ninedof/statics/ellipsoid.hpp"

#include <doctest/doctest.h>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/statics/statics.hpp"
#include "support/oracle.hpp"
#include "support/singular.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

void check(const Eigen::MatrixXd& directions, const Eigen::VectorXd& semi_axes, const oracle::Matrix& j) {
  const oracle::Vector sigma = oracle::singular_values(j);
  const double ratio = oracle::conditioning_of(j);
  REQUIRE(semi_axes.size() == sigma.size());
  for (Eigen::Index k = 0; k < sigma.size(); ++k)
    CHECK(relative_error(semi_axes[k], static_cast<double>(sigma[k])) <= 256.0 * eps * ratio);
  const oracle::Matrix squared = oracle::congruence(oracle::wide(directions), oracle::wide(semi_axes).cwiseAbs2());
  CHECK(matrix_error(oracle::rounded(squared), oracle::rounded(oracle::product(j, j.transpose()))) <=
        256.0 * eps * ratio);
  CHECK(oracle::from_orthonormal(oracle::wide(directions)) <= 1e-14);
}

template <int N>
void check_against(const Ellipsoid<N>& found, const oracle::Matrix& j) {
  check(found.directions, found.semi_axes, j);
}

}  // namespace

TEST_SUITE("ellipsoid") {
  TEST_CASE("velocity ellipsoids are the images of the unit ball under J' and its halves") {
    Random random(421);
    for (int n = 0; n < 500; ++n) {
      const auto [g, c] = random_robot(random);
      const double lc = random.log_uniform(0.2, 5.0);
      const oracle::Matrix j = oracle::jacobian(g, c, lc);
      check_against(velocity_ellipsoid(g, c, lc), j);
      check_against(velocity_ellipsoid(g, c, TwistPart::rotation, lc), j.topRows(3));
      check_against(velocity_ellipsoid(g, c, TwistPart::translation, lc), j.bottomRows(3));
    }
  }

  TEST_CASE("loads on a force ellipsoid are balanced by leg forces of norm 1") {
    Random random(422);
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_robot(random);
      const double lc = random.log_uniform(0.2, 5.0);
      const auto norm = [&](const Vec3& moment, const Vec3& force) {
        return leg_forces(g, c, {lc * moment, force, Vec3::Zero()}).forces.norm();
      };
      const Ellipsoid<6> w = force_ellipsoid(g, c, lc);
      const Ellipsoid<3> m = force_ellipsoid(g, c, TwistPart::rotation, lc);
      const Ellipsoid<3> f = force_ellipsoid(g, c, TwistPart::translation, lc);
      const Vec6 load = w.directions * w.semi_axes.cwiseProduct(random.matrix<Vec6>().normalized());
      const Vec3 moment = m.directions * m.semi_axes.cwiseProduct(random.unit());
      const Vec3 force = f.directions * f.semi_axes.cwiseProduct(random.unit());
      CHECK(norm(load.head<3>(), load.tail<3>()) == doctest::Approx(1.0).epsilon(1e-11));
      CHECK(norm(moment, Vec3::Zero()) == doctest::Approx(1.0).epsilon(1e-11));
      CHECK(norm(Vec3::Zero(), force) == doctest::Approx(1.0).epsilon(1e-11));
    }
  }

  TEST_CASE("twists: the semi-axes are the singular values of conditioning.hpp") {
    Random random(423);
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_robot(random);
      const Vec6 sigma = singular_values(g, c, 1.7);
      CHECK(matrix_error(velocity_ellipsoid(g, c, 1.7).semi_axes, sigma) <= 64.0 * eps * sigma[0] / sigma[5]);
    }
  }

  TEST_CASE("singular configurations: one infinite semi-axis along the free motion, one force of zero") {
    Random random(424);
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_singular_robot(random, n % 3);
      const Eigen::MatrixXd v = oracle::rounded(oracle::right_singular_vectors(oracle::rates(g, c)));
      const Vec6 free = v.col(8).head<6>().normalized();
      const Ellipsoid<6> fast = velocity_ellipsoid(g, c), strong = force_ellipsoid(g, c);
      CHECK(fast.semi_axes[0] == infinity);
      CHECK(fast.semi_axes.tail<5>().allFinite());
      CHECK(std::abs(fast.directions.col(0).dot(free)) == doctest::Approx(1.0).epsilon(1e-9));
      CHECK(strong.semi_axes[5] == 0.0);
      CHECK(strong.directions.col(5) == fast.directions.col(0));
      for (const TwistPart part : {TwistPart::rotation, TwistPart::translation}) {
        const Vec3 half = part == TwistPart::rotation ? free.head<3>() : free.tail<3>();
        const Ellipsoid<3> e = velocity_ellipsoid(g, c, part);
        CHECK(e.semi_axes[0] == infinity);
        CHECK(e.semi_axes.tail<2>().allFinite());
        CHECK(std::abs(e.directions.col(0).dot(half.normalized())) == doctest::Approx(1.0).epsilon(1e-8));
      }
    }
  }

  TEST_CASE("independent of the length unit; NaN gives NaN; an invalid characteristic length is rejected") {
    Random random(425);
    auto [g, c] = random_robot(random);
    const Ellipsoid<6> expected = velocity_ellipsoid(g, c, 0.8);
    for (const double scale : {1e-9, 1e-3, 25.4, 1e9}) {
      const Robot other = scaled({g, c}, scale);
      CHECK(matrix_error(velocity_ellipsoid(other.geometry, other.configuration, 0.8 * scale).semi_axes,
                         expected.semi_axes) <= 1e-13);
    }
    for (const double bad : {0.0, -1.0, not_a_number, infinity}) {
      CHECK(refuses("characteristic_length", [&] { velocity_ellipsoid(g, c, bad); }));
      CHECK(refuses("characteristic_length", [&] { force_ellipsoid(g, c, TwistPart::rotation, bad); }));
    }
    c.rotation(1, 2) = not_a_number;
    CHECK(all_nan(velocity_ellipsoid(g, c).semi_axes));
    CHECK(all_nan(force_ellipsoid(g, c, TwistPart::translation).directions));
  }
}
