/// inverse_dynamics.hpp, payload.hpp, drives.hpp: against the energy of points, bisection and sums.

#include "ninedof/dynamics/inverse_dynamics.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/dynamics/drives.hpp"
#include "ninedof/dynamics/payload.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

Masses some_masses(Random& random) {
  Masses m;
  m.platform = 3.0;
  m.centre = random.matrix<Vec3>();
  m.inertia = Vec3(1.0, 1.4, 0.9).asDiagonal();
  m.cylinder = random.matrix<Vec9>().cwiseAbs();
  m.rod = random.matrix<Vec9>().cwiseAbs();
  m.cylinder_centre = random.matrix<Vec9>();
  m.rod_centre = random.matrix<Vec9>();
  m.cylinder_inertia = random.matrix<Vec9>().cwiseAbs();
  m.rod_inertia = random.matrix<Vec9>().cwiseAbs();
  m.internal_point = 0.4;
  return m;
}

}  // namespace

TEST_SUITE("inverse_dynamics") {
  TEST_CASE("at rest the load is the weights, and their power is that of the height") {
    Random random(71);
    const auto [g, c] = random_robot(random);
    const Masses masses = some_masses(random);
    const Vec3 gravity = random.matrix<Vec3>();
    const auto potential = [&](const Configuration& at) {
      const Legs k = legs(g, at);
      double sum = masses.platform * (at.position + at.rotation * masses.centre).dot(gravity) +
                   masses.internal_point * at.internal_point.dot(gravity);
      for (std::size_t leg = 0; leg < 9; ++leg) {
        const std::size_t i = leg % 3;
        const Eigen::Index row = static_cast<Eigen::Index>(leg);
        const Vec3 e = leg < 3 ? k.e[i] : leg < 6 ? k.e_tilde[i] : k.e_hat[i];
        const Vec3 end = leg < 3 ? Vec3(at.position + k.u[i]) : at.internal_point;
        const Vec3 start = leg < 3   ? g.base_external()[i]
                           : leg < 6 ? Vec3(at.position + k.u_tilde[i])
                                     : g.base_internal()[i];
        sum += masses.cylinder[row] * gravity.dot(start + masses.cylinder_centre[row] * e);
        sum += masses.rod[row] * gravity.dot(end - masses.rod_centre[row] * e);
      }
      return sum;
    };
    const Load load = inertial_load(g, {c}, masses, gravity);
    for (int n = 0; n < 9; ++n) {
      const Vec9 way = Vec9::Unit(n);
      const double slope = (potential(plus(c, 1e-6 * way)) - potential(plus(c, -1e-6 * way))) / 2e-6;
      Vec9 all;
      all << load.moment, load.force, load.force_at_o;
      CHECK(std::abs(all[n] - slope) < 1e-7 * (1.0 + std::abs(slope)));
    }
    const LegForces f = inverse_dynamics(g, {c}, masses, gravity);
    CHECK((f.forces - leg_forces(g, c, load).forces).norm() == 0.0);
  }

  TEST_CASE("masses that are none are refused") {
    Masses m;
    validate(m);
    m.rod[4] = -1.0;
    CHECK(refuses("rod", [&] { validate(m); }));
    m.rod[4] = 0.0;
    m.platform = infinity;
    CHECK(refuses("platform", [&] { validate(m); }));
  }

  TEST_CASE("the payload is the mass at which the first leg reaches its limit") {
    Random random(72);
    for (int n = 0; n < 50; ++n) {
      const auto [g, c] = random_robot(random);
      PayloadLimits limits{Vec9::Constant(80.0), Vec9::Constant(60.0), random.matrix<Vec3>(), Vec3(0, 0, -9.81)};
      const Load without{random.matrix<Vec3>(), random.matrix<Vec3>(), Vec3::Zero()};
      validate(limits);
      const double mass = payload_of(payload_shares(g, c, limits, without));
      const auto fits = [&](double m) {
        Masses load;
        load.platform = m;
        load.centre = limits.centre;
        const Vec9 f = inverse_dynamics(g, {c}, load, limits.gravity, without).forces;
        return (f.array() <= 80.0).all() && (f.array() >= -60.0).all();
      };
      if (std::isnan(mass)) {
        CHECK(!fits(0.0));
        continue;
      }
      CHECK(fits(0.999999 * mass));
      CHECK(!fits(1.000001 * mass));
      limits.push = limits.pull = Vec9::Constant(infinity);
      CHECK(payload_of(payload_shares(g, c, limits, without)) == infinity);
      limits.push[2] = -1.0;
      CHECK(refuses("force", [&] { validate(limits); }));
    }
  }

  TEST_CASE("figures of drives are those of straight lines between samples") {
    const std::vector<double> time{0.0, 1.0, 3.0};
    std::vector<Vec9> forces(3, Vec9::Zero()), rates(3, Vec9::Ones());
    forces[0][0] = 2.0;
    forces[1][0] = -2.0;
    forces[2][0] = -4.0;
    const DriveFigures f = drive_figures(time, forces, rates);
    CHECK(f.push[0] == 2.0);
    CHECK(f.pull[0] == 4.0);
    CHECK(f.work[0] == doctest::Approx(0.5));
    CHECK(f.returned[0] == doctest::Approx(0.5 + 6.0));
    CHECK(f.rms[0] == doctest::Approx(std::sqrt((4.0 / 3.0 + 56.0 / 3.0) / 3.0)));
    CHECK(refuses("forces, rates", [&] { drive_figures(time, std::span(forces).first(2), rates); }));
  }
}
