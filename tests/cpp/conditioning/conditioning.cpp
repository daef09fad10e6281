/// conditioning.hpp against the singular values of J' from the complex-step oracle, which forms J' by inverting the 9x9
/// matrix of rates and shares neither M nor its singular value routine; exact values, singularities, invariances.

#include "ninedof/conditioning/conditioning.hpp"

#include <doctest/doctest.h>

#include "ninedof/kinematics/velocity.hpp"
#include "support/oracle.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

double kappa(const Robot& r, double lc = 1.0) {
  return condition_number(r.geometry, r.configuration, lc);
}

/// The whole robot moved rigidly: base joints, platform and O.
Robot moved(const Robot& r, const Mat3& q, const Vec3& shift) {
  Triple base = r.geometry.base_external(), lower = r.geometry.base_internal();
  for (std::size_t i = 0; i < 3; ++i) {
    base[i] = q * base[i] + shift;
    lower[i] = q * lower[i] + shift;
  }
  const Configuration& c = r.configuration;
  return {{base, lower, r.geometry.platform_external(), r.geometry.platform_internal()},
          {q * c.position + shift, q * c.rotation, q * c.internal_point + shift}};
}

/// The mirror image in the plane y = 0.
Robot mirrored(const Robot& r) {
  const Mat3 mirror = Vec3(1, -1, 1).asDiagonal();
  const auto image = [&](Triple t) {
    for (Vec3& joint : t) joint = mirror * joint;
    return t;
  };
  const Geometry& g = r.geometry;
  const Configuration& c = r.configuration;
  return {
      {image(g.base_external()), image(g.base_internal()), image(g.platform_external()), image(g.platform_internal())},
      {mirror * c.position, mirror * c.rotation * mirror, mirror * c.internal_point}};
}

/// Legs renumbered: external, lower internal and upper internal legs by different permutations.
Robot renumbered(const Robot& r, Random& random) {
  const auto turn = [&] { return static_cast<std::size_t>(random.uniform(0.0, 2.999)); };
  const std::size_t i = turn(), j = turn(), k = turn();
  const auto by = [](const Triple& t, std::size_t first) {
    return Triple{t[first], t[(first + 2) % 3], t[(first + 1) % 3]};
  };
  const Geometry& g = r.geometry;
  return {
      {by(g.base_external(), i), by(g.base_internal(), j), by(g.platform_external(), i), by(g.platform_internal(), k)},
      r.configuration};
}

}  // namespace

TEST_SUITE("conditioning") {
  TEST_CASE("singular values and condition number of J', random robots and characteristic lengths") {
    Random random(91);
    for (int n = 0; n < 1000; ++n) {
      const auto [g, c] = random_robot(random);
      const double lc = random.log_uniform(0.05, 20.0);
      const oracle::Vector expected = oracle::singular_values(oracle::jacobian(g, c, lc));
      const double ratio = static_cast<double>(expected[0] / expected[5]);
      const Vec6 sigma = singular_values(g, c, lc);
      CAPTURE(ratio);
      // Values of M have an error of eps sigma_max(M) = eps / sigma_min(J'): relative to value k of J', eps sigma_k /
      // sigma_min.
      for (Eigen::Index k = 0; k < 6; ++k) {
        const double tolerance = 16.0 * eps * static_cast<double>(expected[k] / expected[5]);
        CHECK(relative_error(sigma[k], static_cast<double>(expected[k])) <= tolerance);
      }
      CHECK(relative_error(condition_number(g, c, lc), ratio) <= 32.0 * eps * ratio);
    }
  }

  TEST_CASE("M J' has orthonormal rows, and the singular values of M are the reciprocals of those of J'") {
    Random random(92);
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_robot(random);
      const Mat6 m = conditioning_matrix(g, c, 0.8);
      const Mat69 j = jacobian(g, c, 0.8);
      const oracle::Matrix rows = oracle::product(oracle::wide(m), oracle::wide(j));
      const double tolerance = 64.0 * eps * kappa({g, c}, 0.8);
      CHECK(oracle::from_orthonormal(rows.transpose()) <= tolerance);
      const oracle::Vector of_j = oracle::singular_values(oracle::wide(j)),
                           of_m = oracle::singular_values(oracle::wide(m));
      CHECK((of_j.cwiseProduct(of_m.reverse()) - oracle::Vector::Ones(6)).norm() <= tolerance);
    }
  }

  TEST_CASE("every index by its definition on J'") {
    Random random(93);
    for (int n = 0; n < 300; ++n) {
      const auto [g, c] = random_robot(random);
      const oracle::Matrix j = oracle::jacobian(g, c, 1.3), square = oracle::product(j, j.transpose());
      const oracle::Matrix inverse = oracle::product(j.transpose(), oracle::inverse(square));  // the pseudo-inverse
      const long double mean = square.trace() / 6;
      const oracle::Matrix off = square - mean * oracle::Matrix::Identity(6, 6);
      const double tolerance = 64.0 * eps * kappa({g, c}, 1.3);
      CHECK(relative_error(condition_number(g, c, 1.3, Norm::frobenius),
                           static_cast<double>(j.norm() * inverse.norm())) <= tolerance);
      CHECK(reciprocal_condition_number(g, c, 1.3) == 1.0 / kappa({g, c}, 1.3));
      CHECK(relative_error(manipulability(g, c, 1.3), static_cast<double>(std::sqrt(oracle::determinant(square)))) <=
            tolerance);
      CHECK(relative_error(isotropy_residual(g, c, 1.3), static_cast<double>(off.norm() / (mean * std::sqrt(6.0L)))) <=
            tolerance);
    }
  }

  TEST_CASE("the octahedral robot: J' J'^T has eigenvalues 4 and 2/9, three times each") {
    const double side = std::sqrt(2.0), height = 1.0 / std::sqrt(3.0), lc = side / 3.0;
    const Geometry g = Geometry::hexagonal(0, side, side, 0);
    const Configuration c = neutral(2.0 * height, height);
    const Vec6 sigma = singular_values(g, c, lc);
    for (Eigen::Index k = 0; k < 6; ++k)
      CHECK(sigma[k] == doctest::Approx(k < 3 ? 2.0 : std::sqrt(2.0 / 9.0)).epsilon(16.0 * eps));
    CHECK(condition_number(g, c, lc) == doctest::Approx(3.0 * std::sqrt(2.0)).epsilon(16.0 * eps));
    CHECK(manipulability(g, c, lc) == doctest::Approx(8.0 * std::pow(2.0 / 9.0, 1.5)).epsilon(64.0 * eps));
    const double mean = (4.0 + 2.0 / 9.0) / 2.0;
    CHECK(isotropy_residual(g, c, lc) == doctest::Approx((4.0 - mean) / mean).epsilon(64.0 * eps));
    CHECK(condition_number(g, c, lc, Norm::frobenius) ==
          doctest::Approx(std::sqrt(3.0 * (4.0 + 2.0 / 9.0) * 3.0 * (0.25 + 4.5))).epsilon(64.0 * eps));
  }

  TEST_CASE("the published condition number, with the definition that reproduces it") {
    const Geometry g = Geometry::hexagonal(0, 5.8124, 2.9062, 0);
    CHECK(condition_number(g, neutral(3.9828, 2.3745)) == doctest::Approx(3.9110).epsilon(5e-6));
    CHECK(condition_number(g, neutral(3.9828, 2.5110)) == doctest::Approx(3.9110).epsilon(5e-6));
  }

  TEST_CASE("approaching a singularity: accurate to the digits that the condition number allows") {
    const Geometry g = Geometry::hexagonal(0.4, 3.0, 2.0, 0.3);
    for (double gap = 0.1; gap > 1e-12; gap *= 0.1) {
      CAPTURE(gap);
      const Configuration base{Vec3(0.1, 0.2, 2.0), Random(94).rotation(0.4), Vec3(0.2, -0.1, gap)};  // near det B = 0
      Configuration platform = base;  // near det C = 0
      platform.internal_point = platform.position + platform.rotation * Vec3(0.1, 0.1, -gap);
      for (const Configuration& c : {base, platform}) {
        const double expected = static_cast<double>(oracle::condition_number(g, c, 1.0));
        CHECK(expected > 0.1 / gap);
        CHECK(relative_error(condition_number(g, c), expected) <= 64.0 * eps * expected);
      }
    }
  }

  TEST_CASE("singular configurations of all three kinds: infinite, in and outside the coordinate planes") {
    Random random(95);
    int finite = 0;
    for (int n = 0; n < 900; ++n) {
      Robot robot = random_robot(random);
      const Geometry& g = robot.geometry;
      Configuration& c = robot.configuration;
      const auto in_plane = [&](const Triple& t) { return Vec3(t[0] + 0.3 * (t[1] - t[0]) + 0.4 * (t[2] - t[0])); };
      switch (n % 3) {
        case 0: c.internal_point = in_plane(g.base_internal()); break;
        case 1: c.internal_point = c.position + c.rotation * in_plane(g.platform_internal()); break;
        default:
          c.internal_point = 0.5 * (g.base_external()[1] + c.position + c.rotation * g.platform_external()[1]);
          break;
      }
      if (std::isfinite(kappa(robot))) ++finite;
    }
    CHECK(finite == 0);
  }

  TEST_CASE("similar hexagons at the neutral configuration are singular, O between base and platform or not") {
    Random random(96);
    for (int n = 0; n < 500; ++n) {
      const double a1 = random.uniform(0.1, 3.0), a2 = random.uniform(0.1, 3.0), ratio = random.uniform(0.2, 2.0);
      const Geometry g = Geometry::hexagonal(a1, a2, ratio * a1, ratio * a2);
      const Configuration c = neutral(random.uniform(0.5, 5.0), random.uniform(-2.0, 6.0));
      CHECK(condition_number(g, c) == infinity);
    }
  }

  TEST_CASE("values of every index at a singularity: O in a plane of joints, leg of zero length, all in one plane") {
    const Geometry g = Geometry::hexagonal(0.5, 3, 2, 0.5);
    for (const Configuration& c : {neutral(2, 0), neutral(2, 2), neutral(0, 0),
                                   Configuration{Vec3(0, 0, 2), Mat3::Identity(), g.base_internal()[0]}}) {
      CHECK(condition_number(g, c) == infinity);
      CHECK(condition_number(g, c, 1.0, Norm::frobenius) == infinity);
      CHECK(reciprocal_condition_number(g, c) == 0.0);
      CHECK(manipulability(g, c) == infinity);
      CHECK(isotropy_residual(g, c) == infinity);
      CHECK(singular_values(g, c)[0] == infinity);
      CHECK(!singular_values(g, c).hasNaN());
    }
  }

  TEST_CASE("all legs nearly in one plane: infinite even where squares of the deviation underflow") {
    const Geometry g = Geometry::hexagonal(0.5, 3, 2, 0.5);
    for (const double trace : {1e-300, 1e-170, 1e-160, 1e-155, 1e-150, 1e-100, 1e-20}) {
      CAPTURE(trace);
      CHECK(condition_number(g, neutral(2.0 * trace, trace)) == infinity);
    }
  }

  TEST_CASE("NaN in any coordinate gives NaN") {
    Random random(97);
    const auto [g, good] = random_robot(random);
    for (Eigen::Index k = 0; k < 15; ++k) {
      Configuration c = good;
      if (k < 3) c.position[k] = not_a_number;
      else if (k < 6) c.internal_point[k - 3] = not_a_number;
      else c.rotation((k - 6) / 3, (k - 6) % 3) = not_a_number;
      CAPTURE(k);
      CHECK(std::isnan(condition_number(g, c)));
      CHECK(std::isnan(condition_number(g, c, 1.0, Norm::frobenius)));
      CHECK(std::isnan(reciprocal_condition_number(g, c)));
      CHECK(std::isnan(manipulability(g, c)));
      CHECK(std::isnan(isotropy_residual(g, c)));
      CHECK(all_nan(singular_values(g, c)));
    }
    for (const double bad : {0.0, -1.0, not_a_number, infinity})
      CHECK(refuses("characteristic_length", [&] { condition_number(g, good, bad); }));
  }

  TEST_CASE("invariances: scale with the characteristic length, rigid motion, mirror image, numbering") {
    Random random(98);
    for (int n = 0; n < 300; ++n) {
      const Robot robot = random_robot(random);
      const double lc = random.log_uniform(0.1, 10.0), expected = kappa(robot, lc), tolerance = 64.0 * eps * expected;
      for (const double scale : {1e-9, 1e-3, 25.4, 1e9})
        CHECK(relative_error(kappa(scaled(robot, scale), lc * scale), expected) <= tolerance);
      const Mat3 about_z = Eigen::AngleAxisd(random.uniform(-pi, pi), Vec3::UnitZ()).toRotationMatrix();
      CHECK(relative_error(kappa(moved(robot, about_z, Vec3::Zero()), lc), expected) <= tolerance);
      CHECK(relative_error(kappa(moved(robot, random.rotation(), random.matrix<Vec3>()), lc), expected) <=
            4.0 * tolerance);
      CHECK(relative_error(kappa(mirrored(robot), lc), expected) <= tolerance);
      CHECK(relative_error(kappa(renumbered(robot, random), lc), expected) <= tolerance);
    }
  }

  TEST_CASE("hexagons: exchanging a1 with a2 and b1 with b2 is a mirror image") {
    Random random(99);
    for (int n = 0; n < 300; ++n) {
      const double a1 = random.uniform(0.0, 3.0), a2 = random.uniform(0.1, 3.0), b1 = random.uniform(0.1, 3.0),
                   b2 = random.uniform(0.0, 3.0), theta = random.uniform(-1.0, 1.0);
      const double one = condition_number(Geometry::hexagonal(a1, a2, b1, b2), neutral(3, 1.5, theta));
      const double other = condition_number(Geometry::hexagonal(a2, a1, b2, b1), neutral(3, 1.5, -theta));
      CHECK(relative_error(other, one) <= 64.0 * eps * one);
    }
  }
}
