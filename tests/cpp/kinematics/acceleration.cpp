/// acceleration.hpp against derivatives in time of leg lengths along a curved motion, computed in extended
/// precision from distances alone, and against identities. No oracle here contains the three 3x3 systems of the code.

#include "ninedof/kinematics/acceleration.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/motion.hpp"

using namespace ninedof;
using namespace support;

namespace {

using Real = oracle::Real;
using Vector3 = Eigen::Matrix<Real, 3, 1>;

/// Leg lengths at time t of the motion Q(t) = exp(t omega + t^2 alpha / 2) Q, which has angular velocity omega and
/// angular acceleration alpha at t = 0: the commutator terms of the exponential are of third order.
oracle::Vector lengths_at(const Robot& robot, const Motion& m, Real t) {
  const auto& [g, c] = robot;
  const auto moved = [t](const Vec3& from, const Vec3& v, const Vec3& a) {
    return Vector3(from.cast<Real>() + t * v.cast<Real>() + t * t / 2 * a.cast<Real>());
  };
  const Vector3 p = moved(c.position, m.v.pdot, m.a.pddot), s = moved(c.internal_point, m.v.sdot, m.a.sddot);
  const Vector3 turn = moved(Vec3::Zero(), m.v.omega, m.a.alpha);
  const auto joint = [&](const Vec3& u) {
    const Vector3 start = c.rotation.cast<Real>() * u.cast<Real>();
    return t == 0 ? Vector3(p + start) : Vector3(p + Eigen::AngleAxis<Real>(turn.norm(), turn.normalized()) * start);
  };
  oracle::Vector out(9);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out[k] = (joint(g.platform_external()[i]) - g.base_external()[i].cast<Real>()).norm();
    out[k + 3] = (s - joint(g.platform_internal()[i])).norm();
    out[k + 6] = (s - g.base_internal()[i].cast<Real>()).norm();
  }
  return out;
}

/// Second derivative in time at t = 0, by central differences of the sixth order.
Vec9 differenced_twice(const Robot& robot, const Motion& m) {
  constexpr Real h = 2e-3L;
  const auto pair = [&](int k) {
    return oracle::Vector(lengths_at(robot, m, static_cast<Real>(k) * h) +
                          lengths_at(robot, m, static_cast<Real>(-k) * h));
  };
  const oracle::Vector sum = 270 * pair(1) - 27 * pair(2) + 2 * pair(3) - 490 * lengths_at(robot, m, 0);
  return (sum / (180 * h * h)).cast<double>();
}

}  // namespace

TEST_SUITE("acceleration") {
  TEST_CASE("inverse acceleration is the second derivative of the leg lengths along a curved motion") {
    Random random(201);
    for (int n = 0; n < 300; ++n) {
      const Robot robot = random_robot(random);
      const Motion m = random_motion(random);
      const Vec9 found = inverse_acceleration(robot.geometry, robot.configuration, m.v, m.a);
      // The truncation error of the differences grows with the eighth power of the speed.
      const double speed = 1.0 + stacked(m.v).norm();
      CHECK((found - differenced_twice(robot, m)).cwiseAbs().maxCoeff() <= 1e-13 * std::pow(speed, 8.0));
    }
  }

  TEST_CASE("at rest a leg acceleration is a leg rate: the same matrix of rates") {
    Random random(202);
    for (int n = 0; n < 100; ++n) {
      const auto [g, c] = random_robot(random);
      const Velocity v{random.matrix<Vec3>(), random.matrix<Vec3>(), random.matrix<Vec3>()};
      const Velocity rest{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
      const Vec9 found = inverse_acceleration(g, c, rest, {v.omega, v.pdot, v.sdot});
      const oracle::Matrix expected = oracle::product(oracle::rates(g, c), oracle::wide(stacked(v)));
      CHECK((found - oracle::rounded(expected)).cwiseAbs().maxCoeff() <= 64.0 * eps);
    }
  }

  TEST_CASE("forward acceleration undoes inverse acceleration") {
    Random random(203);
    for (int n = 0; n < 500; ++n) {
      const Robot robot = random_robot(random);
      const auto& [g, c] = robot;
      const Motion m = random_motion(random);
      const Acceleration back =
          forward_acceleration(g, c, inverse_velocity(g, c, m.v), inverse_acceleration(g, c, m.v, m.a));
      // Velocities have an error proportional to the condition number, and are squared.
      const double lost = std::pow(conditioning_of(robot), 2.0),
                   size = stacked(m.a).norm() + stacked(m.v).squaredNorm();
      CHECK((stacked(back) - stacked(m.a)).norm() <= 64.0 * eps * lost * size);
    }
  }

  TEST_CASE("differences of leg lengths along the forward motion give rates and accelerations back") {
    Random random(204);
    for (int n = 0; n < 100; ++n) {
      const Robot robot = random_robot(random);
      const auto& [g, c] = robot;
      const Vec9 rates = 0.1 * random.matrix<Vec9>(), accelerations = 0.1 * random.matrix<Vec9>();
      const Motion m{forward_velocity(g, c, rates), forward_acceleration(g, c, rates, accelerations)};
      if (stacked(m.v).norm() + stacked(m.a).norm() > 3.0) continue;  // differences too coarse close to a singularity
      CHECK((differenced_twice(robot, m) - accelerations).cwiseAbs().maxCoeff() <= 1e-9);
    }
  }

  TEST_CASE("with powers of two as units of length the bits are the same, from 1e-90 to 1e90") {
    Random random(208);
    for (int n = 0; n < 20; ++n) {
      const Robot robot = random_robot(random);
      const Vec9 rates = random.matrix<Vec9>(), accelerations = random.matrix<Vec9>();
      const Velocity v = forward_velocity(robot.geometry, robot.configuration, rates);
      const Acceleration a = forward_acceleration(robot.geometry, robot.configuration, rates, accelerations);
      const Mat69 rate = jacobian_rate(robot.geometry, robot.configuration, v);
      for (const double scale : {0x1p-300, 0x1p-20, 0x1p20, 0x1p300}) {
        const auto [g, c] = scaled(robot, scale);
        const Velocity scaled_v = forward_velocity(g, c, scale * rates);
        const Acceleration found = forward_acceleration(g, c, scale * rates, scale * accelerations);
        CHECK(found.alpha == a.alpha);
        CHECK(found.pddot == scale * a.pddot);
        CHECK(found.sddot == scale * a.sddot);
        CHECK(inverse_acceleration(g, c, scaled_v, found) ==
              scale * inverse_acceleration(robot.geometry, robot.configuration, v, a));
        CHECK(jacobian_rate(g, c, scaled_v, scale) == rate);
      }
    }
  }

  TEST_CASE("a motion along a leg adds no acceleration; one across it adds speed^2 / length, also for short legs") {
    const Geometry g = Geometry::hexagonal(0.4, 3.0, 2.0, 0.3);
    for (const double length : {1.0, 1e-8, 1e-150}) {
      Configuration c = neutral(2.0, 1.0);
      const Vec3 joint = g.base_internal()[0];
      const Geometry shifted({g.base_external()[0] - joint, g.base_external()[1] - joint, g.base_external()[2] - joint},
                             {g.base_internal()[0] - joint, g.base_internal()[1] - joint, g.base_internal()[2] - joint},
                             g.platform_external(), g.platform_internal());
      c.internal_point = Vec3(0.0, 0.0, length);
      const Vec3 zero = Vec3::Zero();
      const Velocity along{zero, zero, Vec3(0, 0, 3)}, across{zero, zero, Vec3(0, 3, 0)};
      CHECK(inverse_acceleration(shifted, c, along, {zero, zero, zero})[6] == 0.0);
      CHECK(relative_error(inverse_acceleration(shifted, c, across, {zero, zero, zero})[6], 9.0 / length) <= 4.0 * eps);
    }
  }

  TEST_CASE("O in the plane of the base joints: nothing is determined") {
    const Geometry flat = Geometry::hexagonal(0.4, 3.0, 2.0, 0.3);
    const Configuration exact{Vec3(0.1, 0.2, 2.0), Mat3::Identity(), Vec3(0.3, -0.2, 0.0)};
    CHECK(all_nan(stacked(forward_acceleration(flat, exact, Vec9::Ones(), Vec9::Ones()))));
    CHECK(all_nan(jacobian_rate(flat, exact, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitX()})));
    const Motion m{{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}};
    CHECK(inverse_acceleration(flat, exact, m.v, m.a).allFinite());
  }

  TEST_CASE("O in the plane of the platform joints: the acceleration of O is known, that of the platform is not") {
    const Geometry flat = Geometry::hexagonal(0.4, 3.0, 2.0, 0.3);
    const Configuration exact{Vec3(0.1, 0.2, 2.0), Mat3::Identity(), Vec3(0.3, -0.2, 2.0)};
    const Acceleration a = forward_acceleration(flat, exact, Vec9::Ones(), Vec9::Ones());
    CHECK((a.sddot.allFinite() && a.pddot.array().isNaN().all() && a.alpha.array().isNaN().all()));
    CHECK(all_nan(jacobian_rate(flat, exact, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitX()})));
  }

  TEST_CASE("O on the line of an external leg: NaN or very large") {
    Random random(209);
    for (int n = 0; n < 100; ++n) {
      auto [g, c] = random_robot(random);
      const Vec3 foot = g.base_external()[0], head = c.position + c.rotation * g.platform_external()[0];
      c.internal_point = foot + random.uniform(0.3, 0.7) * (head - foot);
      const Acceleration a = forward_acceleration(g, c, random.matrix<Vec9>(), random.matrix<Vec9>());
      CHECK(a.sddot.allFinite());
      CHECK((a.alpha.array().isNaN().any() || a.alpha.cwiseAbs().maxCoeff() > 1e12));
      const Mat69 rate = jacobian_rate(g, c, random_motion(random).v);
      CHECK((rate.array().isNaN().all() || rate.cwiseAbs().maxCoeff() > 1e12));
    }
  }

  TEST_CASE("a leg of zero length of any kind has no acceleration; the others have") {
    Random random(210);
    for (Eigen::Index leg = 0; leg < 9; ++leg) {
      auto [random_geometry, c] = random_robot(random);
      // Numbers whose sums are exact: a leg that only rounding makes vanish has a length.
      const auto exactly = [](const Vec3& v) -> Vec3 { return (v.array() * 0x1p20).round() * 0x1p-20; };
      const auto triple = [&](const Triple& t) -> Triple { return {exactly(t[0]), exactly(t[1]), exactly(t[2])}; };
      const Geometry g(triple(random_geometry.base_external()), triple(random_geometry.base_internal()),
                       triple(random_geometry.platform_external()), triple(random_geometry.platform_internal()));
      c = {exactly(c.position), Mat3::Identity(), exactly(c.internal_point)};
      const auto i = static_cast<std::size_t>(leg % 3);
      if (leg < 3) c.position = g.base_external()[i] - g.platform_external()[i];
      else if (leg < 6) c.internal_point = c.position + g.platform_internal()[i];
      else c.internal_point = g.base_internal()[i];
      // p + u - r and s - p - u~ must vanish in floating-point arithmetic.
      Triple external = g.base_external(), upper = g.platform_internal();
      if (leg < 3) external[i] = c.position + g.platform_external()[i];
      if (leg >= 3 && leg < 6) upper[i] = c.internal_point - c.position;
      const Geometry exact(external, g.base_internal(), g.platform_external(), upper);
      const Motion m = random_motion(random);
      const Vec9 found = inverse_acceleration(exact, c, m.v, m.a);
      for (Eigen::Index k = 0; k < 9; ++k) CHECK(std::isnan(found[k]) == (k == leg));
      CHECK(stacked(forward_acceleration(exact, c, Vec9::Ones(), Vec9::Ones())).hasNaN());
      CHECK(all_nan(jacobian_rate(exact, c, m.v)));
    }
  }

  TEST_CASE("NaN gives NaN; an invalid characteristic length is rejected by name") {
    Random random(211);
    const auto [g, good] = random_robot(random);
    const Motion m = random_motion(random);
    for (const double bad : {0.0, -1.0, not_a_number, infinity})
      CHECK(refuses("characteristic_length", [&] { jacobian_rate(g, good, m.v, bad); }));
    Configuration c = good;
    c.position.y() = not_a_number;
    CHECK(all_nan(jacobian_rate(g, c, m.v)));
    CHECK(all_nan(forward_acceleration(g, c, Vec9::Ones(), Vec9::Ones()).alpha));
    Velocity v = m.v;
    v.sdot.x() = not_a_number;
    CHECK(all_nan(jacobian_rate(g, good, v)));
    CHECK(all_nan(inverse_acceleration(g, good, v, m.a).tail<6>()));
    Vec9 rates = Vec9::Ones();
    rates[3] = not_a_number;
    const Acceleration a = forward_acceleration(g, good, rates, Vec9::Ones());
    CHECK((a.sddot.allFinite() && a.alpha.array().isNaN().all() && a.pddot.array().isNaN().all()));
  }
}
