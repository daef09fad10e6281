/// The number of assembly modes with its proof: against the two methods that have none, from wrong guesses and none,
/// and where a proof is impossible.

#include "ninedof/position/certified_modes.hpp"

#include <doctest/doctest.h>

#include "ninedof/math/rotation.hpp"
#include "ninedof/position/forward_position.hpp"
#include "ninedof/robot/legs.hpp"
#include "position/certified/rotation_search.hpp"
#include "support/support.hpp"

using namespace support;
using ninedof::AssemblyMode;
using ninedof::AssemblyModes;
using ninedof::certified_modes;
using ninedof::CertifiedModes;
using ninedof::contains;
using ninedof::forward_position;
using ninedof::leg_lengths;
using ninedof::PositionObstacle;
using ninedof::PositionStatus;
using ninedof::RotationMethod;
using ninedof::UndecidedModes;

namespace {

double distance(const Configuration& a, const Configuration& b, double unit) {
  return std::max({(a.position - b.position).lpNorm<Eigen::Infinity>() / unit,
                   (a.internal_point - b.internal_point).lpNorm<Eigen::Infinity>() / unit,
                   (a.rotation - b.rotation).cwiseAbs().maxCoeff()});
}

}  // namespace

TEST_SUITE("certified_modes") {
  TEST_CASE("the number is that of both methods, and the enclosures hold what the null-space method finds") {
    Random random(51);
    int both = 0;
    for (int n = 0; n < cases(2000); ++n) {
      const auto [g, c] = any_robot(random, n % 2 == 0);
      const Vec9 lengths = leg_lengths(g, c);
      const CertifiedModes certified = certified_modes(g, lengths);
      const AssemblyModes quick = forward_position(g, lengths);
      REQUIRE(certified.complete());
      CHECK(certified.proved == certified.modes.count);
      CHECK(certified.modes.certain);
      if (quick.certain) CHECK(certified.proved == quick.count);
      const AssemblyModes slow = forward_position(g, lengths, RotationMethod::null_space);
      if (!slow.certain || n % 8 != 0) continue;
      ++both;
      for (const AssemblyMode& mode : slow) {
        int holds = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(certified.modes.count); ++k)
          // Its own error, of some units of the last place over the separation, comes on top.
          holds += distance(certified.modes.mode[k].configuration, mode.configuration, lengths.maxCoeff()) <=
                           certified.radius[k] + 1e-12 / mode.separation
                       ? 1
                       : 0;
        CHECK(holds == 1);
      }
    }
    CHECK(both > cases(150));
  }

  TEST_CASE("guesses prove nothing: none, wrong ones and repeated ones give the same solutions") {
    Random random(52);
    int all = 0;
    for (int n = 0; n < cases(200); ++n) {
      const auto [g, c] = any_robot(random, n % 2 == 0);
      const Vec9 lengths = leg_lengths(g, c);
      const auto s = ninedof::meeting_bounds(g.base_internal(), lengths.tail<3>());
      const auto o = ninedof::meeting_bounds(g.platform_internal(), lengths.segment<3>(3));
      REQUIRE(s.size() == 2);
      REQUIRE(o.size() == 2);
      const ninedof::RotationQuadrics quadrics(g, s[0].point, o[0].point, lengths.head<3>());
      const auto blind = ninedof::proved_rotations(quadrics, {});
      std::vector<Eigen::Vector4d> guesses;
      for (int k = 0; k < 3; ++k) guesses.push_back(ninedof::quaternion_from_rotation(random.rotation()));
      for (const AssemblyMode& mode : forward_position(g, lengths))
        if (mode.base_side == 1 && mode.platform_side == 1) {
          guesses.push_back(ninedof::quaternion_from_rotation(mode.configuration.rotation));
          guesses.push_back(-guesses.back());
        }
      const auto guessed = ninedof::proved_rotations(quadrics, guesses);
      CHECK(blind.undecided.empty());
      CHECK(guessed.undecided.empty());
      CHECK(blind.proved.size() == guessed.proved.size());
      all += static_cast<int>(blind.proved.size());
      for (const auto& a : blind.proved) {
        CHECK(a.guess == 0);
        int same = 0;
        for (const auto& b : guessed.proved) same += inside(a.enclosure, b.alone) ? 1 : 0;
        CHECK(same == 1);
      }
    }
    CHECK(all > cases(100));
  }

  TEST_CASE("bounds of O and of the equations hold the pose that the lengths come from") {
    Random random(53);
    for (int n = 0; n < cases(500); ++n) {
      const auto [g, c] = any_robot(random, false);
      // Lengths have rounding errors, so the pose is no exact solution; the bounds of O must be nearly as narrow as
      // them.
      const Vec9 lengths = leg_lengths(g, c);
      int near = 0;
      for (const auto& s : ninedof::meeting_bounds(g.base_internal(), lengths.tail<3>())) {
        const Vec3 middle(ninedof::middle(s.point.x), ninedof::middle(s.point.y), ninedof::middle(s.point.z));
        near += (middle - c.internal_point).norm() < 1e-9 ? 1 : 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const auto away = ninedof::norm(s.point - ninedof::bounds_of(g.base_internal()[i]));
          CHECK(contains(away, lengths[static_cast<Eigen::Index>(6 + i)]));
        }
      }
      CHECK(near == 1);
    }
  }

  TEST_CASE("quadratics: ranges hold values, and solved equations have the same solutions") {
    Random random(54);
    for (int n = 0; n < cases(500); ++n) {
      ninedof::Quadratics f;
      const Vec3 root = random.uniform(0.1, 1.0) * random.unit();
      const auto at = [](const ninedof::Quadratic& q, const Vec3& t) {
        const std::array<double, 6> product{t[0] * t[0], t[0] * t[1], t[1] * t[1],
                                            t[0] * t[2], t[1] * t[2], t[2] * t[2]};
        double out = middle(q.value);
        for (std::size_t k = 0; k < 3; ++k) out += middle(q.slope[k]) * t[static_cast<Eigen::Index>(k)];
        for (std::size_t k = 0; k < 6; ++k) out += middle(q.bend[k]) * product[k];
        return out;
      };
      for (auto& q : f) {
        for (auto& x : q.slope) x = random.normal();
        for (auto& x : q.bend) x = random.normal();
        q.value = -at(q, root);
        const Vec3 reach = random.matrix<Vec3>().cwiseAbs(), inner = reach.cwiseProduct(random.unit());
        const auto bounds = range(q, reach);
        CHECK(contains(bounds, at(q, inner)));
      }
      const auto solved = solved_for_linear(f);
      REQUIRE(solved);
      for (std::size_t i = 0; i < 3; ++i) {
        const double rest = at((*solved)[i], root) + root[static_cast<Eigen::Index>(i)];
        double size = 1.0;
        for (const auto& x : (*solved)[i].bend) size += magnitude(x);
        CHECK(std::abs(rest) < 1e-12 * size);
      }
    }
  }

  TEST_CASE("the octahedron: 32 modes, at the borders of the charts") {
    const double a = std::numbers::sqrt2, third = 1.0 / std::numbers::sqrt3;
    const Geometry g = Geometry::hexagonal(0.0, a, a, 0.0);
    const CertifiedModes certified = certified_modes(g, leg_lengths(g, ninedof::neutral(2.0 * third, third)));
    CHECK(certified.complete());
    CHECK(certified.proved == 32);
    for (const double r : certified.radius) CHECK(r < 1e-12);
  }

  TEST_CASE("a double mode is undecided") {
    const Geometry g = Geometry::hexagonal(0.0, 4.0, 0.0, 3.0);  // similar hexagons: the neutral pose is singular
    const Configuration c = ninedof::neutral(3.0, 2.0);
    const Vec9 lengths = leg_lengths(g, c);
    const CertifiedModes certified = certified_modes(g, lengths);
    CHECK(!certified.complete());
    CHECK(certified.proved == 16);
    bool among = false;
    for (const UndecidedModes& box : certified.undecided) {
      CHECK(box.radius < 1e-6);
      among |= distance(box.middle, c, lengths.maxCoeff()) <= box.radius + 1e-8;
    }
    CHECK(among);
  }

  TEST_CASE("O on an external joint, or in a plane of internal joints: nothing is proved there") {
    Random random(55);
    for (int n = 0; n < 20; ++n) {
      auto [g, c] = any_robot(random, false);
      c.internal_point = g.base_external()[0];
      const CertifiedModes certified = certified_modes(g, leg_lengths(g, c));
      CHECK(!certified.complete());
      CHECK(std::isinf(certified.undecided.front().radius));
    }
    // Exactly in the plane: centres and radii are small integers.
    const Geometry g(Triple{Vec3(-4, -3, 0), Vec3(4, -3, 0), Vec3(-4, 3, 0)},
                     Triple{Vec3(-4, -3, 0), Vec3(4, -3, 0), Vec3(-4, 3, 0)},
                     Triple{Vec3(1, 0, 1), Vec3(0, 1, 2), Vec3(-1, 0, 1)},
                     Triple{Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(-1, -1, 0)});
    const auto points = ninedof::meeting_bounds(g.base_internal(), Vec3(5, 5, 5));
    REQUIRE(points.size() == 1);
    CHECK(points[0].side == 0);
    CHECK(contains(points[0].point.z, 0.0));
    const CertifiedModes tangent = certified_modes(g, leg_lengths(g, {Vec3(0, 0, 4), Mat3::Identity(), Vec3::Zero()}));
    CHECK(!tangent.complete());
    CHECK(tangent.proved == 0);
    CHECK(tangent.undecided.front().base_side == 0);
    // Shorter by some units in the last place the spheres do not meet. Without a proof they touch.
    Vec9 shorter = leg_lengths(g, {Vec3(0, 0, 4), Mat3::Identity(), Vec3::Zero()});
    shorter.tail<3>() *= 1.0 - 4e-15;
    REQUIRE(forward_position(g, shorter).count > 0);
    const CertifiedModes none = certified_modes(g, shorter);
    CHECK(none.complete());
    CHECK(none.modes.count == 0);
    CHECK(none.modes.status == PositionStatus::infeasible);
    CHECK(none.modes.obstacle == PositionObstacle::lower_legs);
  }

  TEST_CASE("a family of modes: what was not examined is undecided") {
    Random random(56);
    for (int n = 0; n < 10; ++n) {
      const Vec3 s(0.1, 0.2, 1.5), o(0.05, -0.1, -1.2);
      Triple base = random_triple(random, 1.0), platform = random_triple(random, 1.0);
      base[1] = s + 1.7 * (base[0] - s);  // two legs with O on their lines
      platform[1] = o + 0.6 * (platform[0] - o);
      const Geometry g(base, random_triple(random, 1.0), platform, random_triple(random, 1.0));
      const Configuration c{s - o, Mat3::Identity(), s};
      const Vec9 lengths = leg_lengths(g, c);
      const CertifiedModes certified = certified_modes(g, lengths);
      CHECK(!certified.complete());
      bool among = false;
      for (const UndecidedModes& box : certified.undecided)
        among |= distance(box.middle, c, lengths.maxCoeff()) <= box.radius + 1e-8;
      CHECK(among);
    }
  }

  TEST_CASE("lengths that cannot be assembled: proved, with the legs named") {
    const Geometry g = Geometry::hexagonal(0.5, 2.5, 1.5, 0.25);
    const Vec9 lengths = leg_lengths(g, ninedof::neutral(2.0, 1.0));
    const auto obstacle = [&](Eigen::Index leg, double factor) {
      Vec9 other = lengths;
      other[leg] *= factor;
      const CertifiedModes certified = certified_modes(g, other);
      CHECK(certified.complete());
      CHECK(certified.proved == 0);
      CHECK(certified.modes.status == PositionStatus::infeasible);
      return certified.modes.obstacle;
    };
    CHECK(obstacle(0, 6.0) == PositionObstacle::external_leg_1);
    CHECK(obstacle(3, 6.0) == PositionObstacle::upper_legs);
    CHECK(obstacle(8, 6.0) == PositionObstacle::lower_legs);
    CHECK(refuses("leg_lengths", [&] { certified_modes(g, -lengths); }));
  }
}
