/// locked_legs.hpp against singular values of J' without columns, and derivatives against difference quotients.

#include "ninedof/conditioning/locked_legs.hpp"

#include <doctest/doctest.h>

#include <Eigen/SVD>
#include <cmath>
#include <vector>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/kinematics/velocity.hpp"
#include "support/designs.hpp"

using namespace ninedof;
using namespace designs;

namespace {

std::vector<LegSet> all_sets() {
  std::vector<LegSet> out;
  for (int k = 0; k < 9; ++k) {
    out.push_back({k});
    for (int other = 0; other < k; ++other) out.push_back({k, other});
  }
  return out;
}

Eigen::VectorXd left(const Mat69& j, const LegSet& locked) {
  std::vector<Eigen::Index> columns;
  for (int k = 0; k < 9; ++k)
    if (k != locked.first && k != locked.second) columns.push_back(k);
  return Eigen::JacobiSVD<Eigen::MatrixXd>(j(Eigen::all, columns)).singularValues();
}

Spectrum spectrum_at(const Eigen::VectorXd& x, int leg) {
  const Points at = points_of(x);
  return locked_spectrum(at, nine_legs(at), x[point_coordinates - 1], leg);
}

}  // namespace

TEST_SUITE("locked_legs") {
  TEST_CASE("every leg and every pair: the condition number of the columns that are left") {
    Random random(1401);
    for (int n = 0; n < cases(40); ++n) {
      const Robot r = n % 2 == 0 ? random_robot(random) : random_symmetric_robot(random);
      const double lc = random.log_uniform(0.3, 3.0);
      const PosedPoints here = posed_points(r.geometry, r.configuration);
      const LockedLegs legs(here.at, here.legs, lc);
      const Mat69 j = jacobian(r.geometry, r.configuration, lc);
      const double healthy = condition_number(r.geometry, r.configuration, lc);
      double squares = 0.0;
      for (int leg = 0; leg < 9; ++leg) squares += std::pow(legs.relative_manipulability(leg), 2);
      CHECK(squares == doctest::Approx(3.0).epsilon(1e-13));
      for (const LegSet& locked : all_sets()) {
        CAPTURE(locked.first);
        CAPTURE(locked.second);
        const Eigen::VectorXd sigma = left(j, locked);
        const double expected = sigma[0] / sigma[locked.freedoms() - 1];
        CHECK(legs.condition_number(locked) == doctest::Approx(expected).epsilon(1e-13 * (healthy + expected)));
        if (locked.freedoms() < 6) CHECK(sigma[locked.freedoms()] <= 1e-12 * healthy * sigma[0]);
      }
      for (int leg = 3; leg < 9; ++leg) {
        const Vec6 sigma = locked_spectrum(here.at, here.legs, lc, leg).sigma;
        CHECK(sigma[0] / sigma[5] == doctest::Approx(legs.condition_number({leg})).epsilon(1e-12 * healthy));
      }
    }
  }

  TEST_CASE("derivatives of singular values with a leg locked, by every point and the characteristic length") {
    Random random(1402);
    int compared = 0;
    for (int n = 0; n < cases(20); ++n) {
      const Robot r = random_robot(random);
      Eigen::VectorXd x(point_coordinates);
      const Points at = points(r.geometry, r.configuration);
      for (int k = 0; k < point_count; ++k) x.segment<3>(3 * k) = at[at_index(k)];
      x[point_coordinates - 1] = random.log_uniform(0.5, 2.0);
      const int leg = 3 + n % 6;
      const Spectrum s = spectrum_at(x, leg);
      const auto sigma = [&](const Eigen::VectorXd& y) { return Eigen::VectorXd(spectrum_at(y, leg).sigma); };
      Eigen::MatrixXd expected(6, point_coordinates);
      for (Eigen::Index k = 0; k < point_coordinates; ++k) expected.col(k) = difference(sigma, x, k, 1e-4);
      for (int k = 0; k < 6; ++k) {
        const double above = k > 0 ? s.sigma[k - 1] - s.sigma[k] : infinity;
        const double below = k < 5 ? s.sigma[k] - s.sigma[k + 1] : infinity;
        if (std::min(above, below) < 0.05 || s.sigma[0] > 30.0) continue;
        ++compared;
        PointGradient g = zero_gradient();
        add_spectrum_gradient(points_of(x), nine_legs(points_of(x)), s, k, k, 0.5 / s.sigma[k], g);
        for (int point = 0; point < point_count; ++point)
          CHECK((g.point[at_index(point)] - expected.row(k).segment<3>(3 * point).transpose()).norm() <= 1e-6);
        CHECK(std::abs(g.length - expected(k, point_coordinates - 1)) <= 1e-6);
      }
    }
    CHECK(compared > cases(30));
  }

  TEST_CASE("no control: a singular pose, two legs in line, and where O alone moves a leg") {
    Random random(1403);
    const Robot r = random_robot(random);
    Configuration c = r.configuration;
    const Vec3 upper = c.position + c.rotation * r.geometry.platform_internal()[0];
    c.internal_point = 0.5 * (upper + r.geometry.base_internal()[1]);  // q1 and r2 in line
    const PosedPoints in_line = posed_points(r.geometry, c);
    const LockedLegs legs(in_line.at, in_line.legs, 1.0);
    CHECK(legs.condition_number({3}) < 1e6);
    CHECK(legs.condition_number({3, 7}) > 1e14);
    // O at a joint of an external leg: det N = 0.
    c.internal_point = c.position + c.rotation * r.geometry.platform_external()[0];
    const PosedPoints singular = posed_points(r.geometry, c);
    const LockedLegs lost(singular.at, singular.legs, 1.0);
    for (const LegSet& locked : all_sets()) CHECK(lost.condition_number(locked) == infinity);
    const Vec3 nowhere = Vec3::Constant(not_a_number);
    const PosedPoints missing = posed_points(r.geometry, {nowhere, r.configuration.rotation, nowhere});
    CHECK(std::isnan(LockedLegs(missing.at, missing.legs, 1.0).condition_number({4})));
    CHECK_THROWS(LockedLegs(in_line.at, in_line.legs, 0.0));
  }
}
