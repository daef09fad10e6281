/// sensitivity.hpp against conditioning.hpp, with which it shares only the singular value routine: derivatives of every
/// singular value by every coordinate of the fourteen points, mixed derivatives, and exactly equal singular values.

#include "ninedof/conditioning/sensitivity.hpp"

#include <doctest/doctest.h>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/kinematics/velocity.hpp"
#include "support/designs.hpp"
#include "support/oracle.hpp"

using namespace ninedof;
using namespace designs;

namespace {

Eigen::VectorXd flat(const Points& at, double lc) {
  Eigen::VectorXd x(point_coordinates);
  for (int k = 0; k < point_count; ++k) x.segment<3>(3 * k) = at[static_cast<std::size_t>(k)];
  x[point_coordinates - 1] = lc;
  return x;
}
Eigen::VectorXd flat(const PointGradient& g) {
  return flat(g.point, g.length);
}

/// The robot with its platform frame rotated to the base axes.
Robot robot_of(const Eigen::VectorXd& x) {
  const Points at = points_of(x);
  const auto triple = [&](std::size_t first, const Vec3& origin) -> Triple {
    return {at[first] - origin, at[first + 1] - origin, at[first + 2] - origin};
  };
  const Vec3 p = at[point_p], zero = Vec3::Zero();
  return {{triple(point_r, zero), triple(point_r_hat, zero), triple(point_u, p), triple(point_u_tilde, p)},
          {p, Mat3::Identity(), at[point_s]}};
}

/// Singular values of M, descending, and M^T M, which does not depend on a basis.
Eigen::VectorXd sigma(const Eigen::VectorXd& x) {
  const Robot r = robot_of(x);
  return singular_values(r.geometry, r.configuration, x[point_coordinates - 1]).cwiseInverse().reverse();
}
Mat6 gram_of(const Eigen::VectorXd& x) {
  const Robot r = robot_of(x);
  const Mat6 m = conditioning_matrix(r.geometry, r.configuration, x[point_coordinates - 1]);
  return m.transpose() * m;
}

struct Case {
  Eigen::VectorXd x;
  Points at;
  NineLegs legs;
  Spectrum s;

  Case(const Robot& r, double lc)
      : x(flat(points(r.geometry, r.configuration), lc)),
        at(points_of(x)),
        legs(nine_legs(at)),
        s(spectrum(at, legs, lc)) {}

  Eigen::VectorXd gradient(int a, int b, double scale = 1.0) const {
    PointGradient g = zero_gradient();
    add_spectrum_gradient(at, legs, s, a, b, scale, g);
    return flat(g);
  }
};

}  // namespace

TEST_SUITE("sensitivity") {
  TEST_CASE("singular values and twists are those of M; rates are leg rates with the right sum of squares") {
    Random random(221);
    for (int n = 0; n < 200; ++n) {
      const Robot r = random_robot(random);
      const double lc = random.log_uniform(0.3, 3.0);
      const Case c(r, lc);
      CHECK(matrix_error(c.s.sigma, sigma(c.x)) <= 32.0 * eps * c.s.sigma[0] / c.s.sigma[5]);
      CHECK(matrix_error(gram_of(c.x) * c.s.twist, c.s.twist * c.s.sigma.cwiseAbs2().asDiagonal()) <= 64.0 * eps);
      const Robot same = robot_of(c.x);
      for (Eigen::Index k = 0; k < 6; ++k) {
        const Vec6 t = c.s.twist.col(k);
        const Vec9 rates =
            inverse_velocity(same.geometry, same.configuration, {t.head<3>() / lc, t.tail<3>(), c.s.sdot.col(k)});
        CHECK((c.s.rates.col(k) - rates).cwiseAbs().maxCoeff() <= 64.0 * eps * c.s.sigma[0]);
        CHECK(std::abs(rates.norm() - c.s.sigma[k]) <= 64.0 * eps * c.s.sigma[0]);
      }
    }
  }

  TEST_CASE("every singular value's derivative by every coordinate of every point and the characteristic length") {
    Random random(222);
    int compared = 0;
    for (int n = 0; n < 60; ++n) {
      const Case c(random_robot(random), random.log_uniform(0.5, 2.0));
      Eigen::MatrixXd expected(6, point_coordinates);
      for (Eigen::Index k = 0; k < point_coordinates; ++k) expected.col(k) = difference(sigma, c.x, k, 1e-4);
      for (int k = 0; k < 6; ++k) {
        // Close to equal singular values finite differences are inaccurate.
        const double above = k > 0 ? c.s.sigma[k - 1] - c.s.sigma[k] : infinity;
        const double below = k < 5 ? c.s.sigma[k] - c.s.sigma[k + 1] : infinity;
        if (std::min(above, below) < 0.03) continue;
        ++compared;
        const Eigen::VectorXd got = c.gradient(k, k, 0.5 / c.s.sigma[k]);
        CAPTURE(n);
        CAPTURE(k);
        CHECK((got - expected.row(k).transpose()).cwiseAbs().maxCoeff() <= 1e-7);
        CHECK(got.cwiseAbs().maxCoeff() > 1e-3);
      }
    }
    CHECK(compared > 200);
  }

  TEST_CASE("mixed derivatives v_a^T d(M^T M) v_b, all pairs, for any singular values") {
    Random random(223);
    for (int n = 0; n < 20; ++n) {
      // Symmetric robots have exactly equal singular values.
      const Robot robot = n % 2 == 0 ? random_robot(random) : random_symmetric_robot(random);
      const Case c(robot, random.log_uniform(0.5, 2.0));
      for (Eigen::Index k = 0; k < point_coordinates; ++k) {
        const Mat6 moved = difference(gram_of, c.x, k, 1e-4);
        const Mat6 expected = c.s.twist.transpose() * moved * c.s.twist;
        for (int a = 0; a < 6; ++a)
          for (int b = a; b < 6; ++b) {
            CAPTURE(a);
            CAPTURE(b);
            CAPTURE(k);
            CHECK(std::abs(c.gradient(a, b)[k] - expected(a, b)) <= 1e-8);
            CHECK(c.gradient(b, a)[k] == doctest::Approx(c.gradient(a, b)[k]).epsilon(1e-12));
          }
      }
    }
  }

  TEST_CASE(
      "equal singular values of a C3 design, neutral: in any direction the pair splits by the eigenvalues of its "
      "block") {
    Random random(224);
    int split = 0;
    for (int n = 0; n < 100; ++n) {
      const Case c(random_symmetric_robot(random), random.log_uniform(0.5, 2.0));
      const Eigen::VectorXd along =
          Eigen::VectorXd::NullaryExpr(point_coordinates, [&] { return random.normal(); }).normalized();
      const auto ahead = [&](double h) { return sigma(c.x + h * along); };
      for (int k = 0; k < 5; ++k) {
        if (c.s.sigma[k] - c.s.sigma[k + 1] > 1e-9) continue;
        const bool third =
            (k > 0 && c.s.sigma[k - 1] - c.s.sigma[k] < 0.05) || (k < 4 && c.s.sigma[k + 1] - c.s.sigma[k + 2] < 0.05);
        if (third || c.s.sigma[k] < 0.05) continue;
        Eigen::Matrix2d block;
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j) block(i, j) = c.gradient(k + i, k + j).dot(along) / (2.0 * c.s.sigma[k]);
        // The sum of the pair is smooth.
        constexpr double h = 1e-4;
        const auto sum = [&](double t) { return ahead(t).segment<2>(k).squaredNorm(); };
        const double slope = (8.0 * (sum(h) - sum(-h)) - (sum(2 * h) - sum(-2 * h))) / (12.0 * h);
        CHECK(std::abs(block.trace() * 2.0 * c.s.sigma[k] - slope) <= 1e-8);
        // Each of the two has a one-sided slope.
        const Eigen::VectorXd slopes = oracle::symmetric_eigenvalues(block);
        const Eigen::Vector2d one_sided =
            (-11.0 * sigma(c.x) + 18.0 * ahead(h) - 9.0 * ahead(2 * h) + 2.0 * ahead(3 * h)).segment<2>(k) / (6.0 * h);
        if (slopes[1] - slopes[0] < 0.01) continue;  // the two bend into each other's order
        CHECK(std::abs(slopes[1] - one_sided[0]) <= 1e-6);
        CHECK(std::abs(slopes[0] - one_sided[1]) <= 1e-6);
        // A diagonal entry alone is the slope of neither.
        split += std::abs(block(0, 0) - slopes[0]) > 1e-3 && std::abs(block(0, 0) - slopes[1]) > 1e-3;
      }
    }
    CHECK(split > 50);
  }

  TEST_CASE("moving the whole robot changes no singular value, scaling all lengths only dimensional ones") {
    Random random(225);
    for (int n = 0; n < 50; ++n) {
      const Case c(random_robot(random), random.log_uniform(0.5, 2.0));
      for (int k = 0; k < 6; ++k) {
        const Eigen::VectorXd g = c.gradient(k, k);
        Vec3 total = Vec3::Zero();
        for (int point = 0; point < point_count; ++point) total += g.segment<3>(3 * point);
        CHECK(total.cwiseAbs().maxCoeff() <= 1e-12);
        CHECK(std::abs(g.dot(c.x)) <= 1e-12);  // M is dimensionless
      }
    }
  }

  TEST_CASE("a leg of zero length and NaN: no exception, no invented number") {
    Random random(226);
    Robot r = random_robot(random);
    r.configuration.internal_point = r.geometry.base_internal()[0];
    const Case c(r, 1.0);
    CHECK(c.legs.length[6] == 0.0);
    CHECK(c.s.sigma.allFinite());
    for (int k = 0; k < 6; ++k) CHECK(c.gradient(k, k).allFinite());
    Points at = c.at;
    at[point_p].x() = not_a_number;
    CHECK(all_nan(spectrum(at, nine_legs(at), 1.0).sigma));
    for (const double bad : {0.0, -1.0, not_a_number, infinity})
      CHECK(refuses("characteristic_length", [&] { spectrum(c.at, c.legs, bad); }));
  }
}
