/// All assembly modes: the original configuration is among them, leg_lengths of each mode gives the nine lengths, and
/// two methods that share only the equations find the same number.

#include "ninedof/position/forward_position.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "ninedof/robot/legs.hpp"
#include "support/support.hpp"

using namespace support;
using ninedof::AssemblyMode;
using ninedof::AssemblyModes;
using ninedof::forward_position;
using ninedof::leg_lengths;
using ninedof::PositionObstacle;
using ninedof::PositionStatus;
using ninedof::RotationMethod;

namespace {

double distance(const Configuration& a, const Configuration& b) {
  return std::max({(a.position - b.position).norm(), (a.internal_point - b.internal_point).norm(),
                   (a.rotation - b.rotation).norm()});
}

double nearest(const AssemblyModes& modes, const Configuration& c) {
  double least = infinity;
  for (const AssemblyMode& m : modes) least = std::min(least, distance(m.configuration, c));
  return least;
}

double worst_length(const Geometry& g, const AssemblyModes& modes, const Vec9& lengths) {
  double worst = 0.0;
  for (const AssemblyMode& m : modes)
    worst = std::max(worst, (leg_lengths(g, m.configuration) - lengths).cwiseAbs().maxCoeff());
  return worst / lengths.maxCoeff();
}

}  // namespace

TEST_SUITE("forward_position") {
  TEST_CASE("round trip, and both methods") {
    Random random(1);
    int fast_enough = 0, both_certain = 0;
    for (int n = 0; n < 4000; ++n) {
      const bool hexagonal = n % 2 == 0;
      const auto [g, c] = any_robot(random, hexagonal);
      const Vec9 lengths = leg_lengths(g, c);
      const AssemblyModes modes = forward_position(g, lengths);
      CHECK(nearest(modes, c) < 1e-6);
      CHECK(worst_length(g, modes, lengths) < 1e-12);
      CHECK(modes.count % (hexagonal ? 4 : 2) == 0);
      fast_enough += modes.null_space_branches == 0 ? 1 : 0;
      const AssemblyModes fast = forward_position(g, lengths, RotationMethod::elimination);
      const AssemblyModes slow = forward_position(g, lengths, RotationMethod::null_space);
      CHECK(worst_length(g, slow, lengths) < 1e-12);
      if (!fast.certain || !slow.certain) continue;
      ++both_certain;
      REQUIRE(fast.count == slow.count);
      for (const AssemblyMode& m : fast) CHECK(nearest(slow, m.configuration) < 1e-6);
    }
    CHECK(fast_enough > 3980);
    CHECK(both_certain > 3500);  // the null-space method is not certain near nearly real solutions
  }

  TEST_CASE("planar robots, solved by mirror images, and nearly planar ones, solved in full, agree") {
    Random random(2);
    for (int n = 0; n < 200; ++n) {
      const auto [g, c] = any_robot(random, true);
      // The same robot in arbitrary frames, and one with a joint moved slightly out of its plane.
      const Mat3 turn = random.rotation();
      const auto turned = [&](Triple t) {
        for (Vec3& j : t) j = turn * j + Vec3(0.3, -0.2, 0.7);
        return t;
      };
      const Vec9 lengths = leg_lengths(g, c);
      const Geometry seen(turned(g.base_external()), turned(g.base_internal()), turned(g.platform_external()),
                          turned(g.platform_internal()));
      Triple bent = g.base_external();
      bent[1].z() += 1e-12;
      const Geometry lifted(bent, g.base_internal(), g.platform_external(), g.platform_internal());
      const AssemblyModes flat = forward_position(g, lengths), anywhere = forward_position(seen, lengths),
                          full = forward_position(lifted, lengths);
      double separation = 1.0;
      for (const AssemblyMode& m : flat) separation = std::min(separation, m.separation);
      if (separation < 1e-3) continue;
      CHECK(flat.count == anywhere.count);
      REQUIRE(flat.count == full.count);
      for (const AssemblyMode& m : flat) CHECK(nearest(full, m.configuration) < 1e-7);
    }
  }

  TEST_CASE("the octahedron: 32 modes, with the largest separation, and still 32 nearby") {
    const double a = std::numbers::sqrt2, third = 1.0 / std::numbers::sqrt3;
    const Geometry g = Geometry::hexagonal(0.0, a, a, 0.0);
    const AssemblyModes modes = forward_position(g, leg_lengths(g, ninedof::neutral(2.0 * third, third)));
    CHECK(modes.status == PositionStatus::found);
    CHECK(modes.certain);
    CHECK(modes.count == 32);
    for (const AssemblyMode& m : modes) CHECK(m.separation == doctest::Approx(1.0).epsilon(1e-12));
    Random random(3);
    for (int n = 0; n < 100; ++n) {
      const Robot off{Geometry::hexagonal(random.uniform(0.0, 0.1), a, a, random.uniform(0.0, 0.1)),
                      {Vec3(0.0, 0.0, 2.0 * third) + 0.05 * random.unit(), random.rotation(0.05),
                       Vec3(0.0, 0.0, third) + 0.03 * random.unit()}};
      CHECK(forward_position(off.geometry, leg_lengths(off.geometry, off.configuration)).count == 32);
    }
  }

  TEST_CASE("legs through O: an isolated mode, found although |c_i| = 1") {
    Random random(4);
    for (int n = 0; n < 100; ++n) {
      // Each external leg goes through O: platform joints on the far side of it, on the lines from the base joints.
      const Vec3 s(0.1, 0.2, 1.4);
      const Triple base = random_triple(random, 1.5);
      const Mat3 q = random.rotation(0.5);
      const Vec3 p = s + Vec3(0.05, -0.1, 1.2);
      Triple platform;
      const int stretched = 1 + n % 3;
      for (std::size_t i = 0; i < 3; ++i) {
        Vec3 joint = s - random.uniform(0.4, 0.9) * (base[i] - s);
        if (static_cast<int>(i) >= stretched) joint += 0.4 * random.unit();
        platform[i] = q.transpose() * (joint - p);
      }
      const Geometry g(base, random_triple(random, 1.3), platform, random_triple(random, 0.8));
      const Configuration c{p, q, s};
      const Vec9 lengths = leg_lengths(g, c);
      const AssemblyModes modes = forward_position(g, lengths);
      CHECK(nearest(modes, c) < (stretched == 3 ? 1e-5 : 1e-6));
      CHECK(worst_length(g, modes, lengths) < 1e-11);
      if (stretched == 3) CHECK(modes.status == PositionStatus::tangent);
    }
  }

  TEST_CASE("short legs of each kind, down to zero length") {
    Random random(6);
    for (const double length : {1e-2, 1e-4, 1e-6, 1e-8, 0.0})
      for (std::size_t leg = 0; leg < 9; ++leg)
        for (int n = 0; n < 6; ++n) {
          // Move the joint at the base, or at the platform for upper legs, to within `length` of the other end.
          const auto [g, c] = any_robot(random, false);
          std::array<Triple, 4> joints{g.base_external(), g.base_internal(), g.platform_external(),
                                       g.platform_internal()};
          const std::size_t i = leg % 3;
          const Vec3 off = length * random.unit();
          if (leg < 3) joints[0][i] = c.position + c.rotation * joints[2][i] + off;
          else if (leg < 6) joints[3][i] = c.rotation.transpose() * (c.internal_point - c.position + off);
          else joints[1][i] = c.internal_point + off;
          const Geometry made(joints[0], joints[1], joints[2], joints[3]);
          const AssemblyModes modes = forward_position(made, leg_lengths(made, c));
          CAPTURE(length);
          CAPTURE(leg);
          CHECK(nearest(modes, c) < 1e-5);
        }
  }

  TEST_CASE("O in a plane of joints, for any sizes") {
    Random random(7);
    for (const double near : {1.0, 1e-1, 1e-2, 1e-3})
      for (int n = 0; n < 60; ++n) {
        const auto [g, c] = any_robot(random, false);
        Triple lower = g.base_internal();  // O in their plane, `near` the first, the second or the third
        const std::size_t i = static_cast<std::size_t>(n % 3);
        lower[i] = c.internal_point + near * random.unit();
        const Vec3 a = lower[(i + 1) % 3] - lower[i], o = c.internal_point - lower[i];
        lower[(i + 2) % 3] = lower[i] + random.uniform(0.5, 1.5) * a + random.uniform(0.5, 2.0) / near * o;
        const Geometry made(g.base_external(), lower, g.platform_external(), g.platform_internal());
        const AssemblyModes modes = forward_position(made, leg_lengths(made, c));
        CAPTURE(near);
        CHECK(nearest(modes, c) < 1e-4);
      }
  }

  TEST_CASE("each mode says on which sides of the internal joints O is") {
    Random random(8);
    const auto side = [](const Triple& t, const Vec3& point) {
      return (t[1] - t[0]).cross(t[2] - t[0]).dot(point - t[0]) > 0.0 ? 1 : -1;
    };
    for (int n = 0; n < 60; ++n) {
      const auto [g, c] = any_robot(random, n % 2 == 0);
      for (const AssemblyMode& m : forward_position(g, leg_lengths(g, c))) {
        const Configuration& at = m.configuration;
        CHECK(m.base_side == side(g.base_internal(), at.internal_point));
        CHECK(m.platform_side ==
              side(g.platform_internal(), at.rotation.transpose() * (at.internal_point - at.position)));
      }
    }
  }

  TEST_CASE("two planar plates, O in the plane of one: the modes that are their own mirror images in it") {
    Random random(9);
    for (int n = 0; n < 40; ++n) {
      auto [g, c] = any_robot(random, true);
      c.rotation = random.rotation(0.5);
      c.internal_point[2] = 0.0;
      const AssemblyModes modes = forward_position(g, leg_lengths(g, c));
      CHECK(modes.status == PositionStatus::tangent);
      CHECK(nearest(modes, c) < 1e-5);
    }
  }

  TEST_CASE("one plate planar, the other not: no mirror images, all lengths kept by every mode") {
    Random random(11);
    for (int n = 0; n < 60; ++n) {
      const auto [flat, c] = any_robot(random, true);
      const Geometry bent = random_robot(random).geometry;
      const Geometry g = n % 2 == 0 ? Geometry(flat.base_external(), flat.base_internal(), bent.platform_external(),
                                               bent.platform_internal())
                                    : Geometry(bent.base_external(), bent.base_internal(), flat.platform_external(),
                                               flat.platform_internal());
      const Vec9 lengths = leg_lengths(g, c);
      const AssemblyModes modes = forward_position(g, lengths),
                          other = forward_position(g, lengths, RotationMethod::null_space);
      CHECK(nearest(modes, c) < 1e-5);
      CHECK(worst_length(g, modes, lengths) < 1e-9);
      CHECK(other.null_space_branches > 0);
      if (modes.certain && other.certain) CHECK(modes.count == other.count);
    }
  }

  TEST_CASE("in a unit that makes the robot huge or tiny: the same modes, each of them") {
    Random random(10);
    for (const double unit : {0x1p300, 0x1p-300})
      for (int n = 0; n < 20; ++n) {
        const Robot r = any_robot(random, false), other = scaled(r, unit);
        const AssemblyModes modes = forward_position(r.geometry, leg_lengths(r.geometry, r.configuration)),
                            same = forward_position(other.geometry, leg_lengths(other.geometry, other.configuration));
        REQUIRE(same.count == modes.count);
        for (std::size_t k = 0; k < static_cast<std::size_t>(modes.count); ++k) {
          const Configuration &a = modes.mode[k].configuration, &b = same.mode[k].configuration;
          CHECK(b.rotation == a.rotation);
          CHECK(b.position == unit * a.position);
          CHECK(b.internal_point == unit * a.internal_point);
        }
      }
  }

  TEST_CASE("lengths without a list of modes have a status and a reason") {
    Random random(5);
    const auto [g, home] = any_robot(random, false);
    Configuration c = home;
    c.internal_point = g.base_external()[1];
    AssemblyModes modes = forward_position(g, leg_lengths(g, c));
    CHECK(modes.status == PositionStatus::self_motion);
    CHECK(modes.count == 0);
    CHECK_FALSE(modes.certain);

    Vec9 lengths = leg_lengths(g, home);
    lengths.tail<3>() *= 0.01;
    modes = forward_position(g, lengths);
    CHECK(modes.status == PositionStatus::infeasible);
    CHECK(modes.obstacle == PositionObstacle::lower_legs);
    lengths = leg_lengths(g, home);
    lengths.segment<3>(3) *= 0.01;
    CHECK(forward_position(g, lengths).obstacle == PositionObstacle::upper_legs);
    lengths = leg_lengths(g, home);
    lengths[2] *= 20.0;
    CHECK(forward_position(g, lengths).obstacle == PositionObstacle::external_leg_3);
  }

  TEST_CASE("invalid lengths are rejected by name") {
    const Geometry g = Geometry::hexagonal(0.3, 2.0, 1.0, 0.2);
    for (const double bad : {-1.0, not_a_number, infinity}) {
      Vec9 lengths = Vec9::Ones();
      lengths[4] = bad;
      CHECK(refuses("leg_lengths", [&] { forward_position(g, lengths); }));
    }
    CHECK(refuses("leg_lengths", [&] { forward_position(g, Vec9::Zero()); }));
  }
}
