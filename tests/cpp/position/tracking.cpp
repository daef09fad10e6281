/// Tracking against the list of all modes, and the statements of its certificate.

#include "ninedof/position/tracking.hpp"

#include <doctest/doctest.h>

#include "ninedof/math/rotation.hpp"
#include "ninedof/position/forward_position.hpp"
#include "ninedof/robot/legs.hpp"
#include "ninedof/singularity/singularity.hpp"
#include "support/support.hpp"

using namespace support;
using ninedof::leg_lengths;
using ninedof::track;
using ninedof::Tracked;
using ninedof::TrackStatus;

namespace {

double angle(const Mat3& a, const Mat3& b) {
  return 2.0 * std::asin(std::min(1.0, (a - b).norm() / (2.0 * std::numbers::sqrt2)));
}

}  // namespace

TEST_SUITE("tracking") {
  TEST_CASE("certified: a mode, and the only one within the radius") {
    Random random(1);
    int certified = 0;
    for (int n = 0; n < 2000; ++n) {
      const auto [g, c] = random_robot(random);
      const Configuration to = ninedof::plus(c, 0.03 * random.matrix<Vec9>());
      const Vec9 lengths = leg_lengths(g, to);
      const Tracked t = track(g, lengths, c);
      if (t.status != TrackStatus::tracked) continue;
      CHECK((leg_lengths(g, t.configuration) - lengths).cwiseAbs().maxCoeff() < 1e-12 * lengths.maxCoeff());
      CHECK(t.reached == 1.0);
      if (t.steps > 1 || !(t.certificate <= 0.5)) continue;
      ++certified;
      int within = 0;
      for (const ninedof::AssemblyMode& m : ninedof::forward_position(g, lengths)) {
        if ((m.configuration.internal_point - t.configuration.internal_point).norm() > 1e-6) continue;
        const Vec3 o = m.configuration.rotation.transpose() *
                       (m.configuration.internal_point - m.configuration.position),
                   there = t.configuration.rotation.transpose() *
                           (t.configuration.internal_point - t.configuration.position);
        if ((o - there).norm() > 1e-6) continue;
        within += angle(m.configuration.rotation, c.rotation) < t.alone_within ? 1 : 0;
      }
      CHECK(within == 1);
    }
    CHECK(certified > 600);
  }

  TEST_CASE("a step that Newton's method alone takes to another mode") {
    const Geometry g = Geometry::hexagonal(0.0, 5.8124, 2.9062, 0.0);
    const Configuration c{
        {-0.7094, -0.3459, 2.3928}, ninedof::exp_rotation({0.774, 1.1364, 0.1021}), {-0.2139, -0.1043, 0.7215}};
    Vec9 to;
    to << 3.1924, 4.5945, 4.7009, 3.0629, 2.9089, 0.2422, 3.3902, 3.2709, 3.6362;
    const Vec9 from = leg_lengths(g, c);
    std::vector<Vec9> path;
    for (int k = 1; k <= 400; ++k) path.push_back(k < 400 ? Vec9(from + k / 400.0 * (to - from)) : to);
    const Tracked one = track(g, to, c), fine = track(g, path, c).back();
    REQUIRE(one.status == TrackStatus::tracked);
    REQUIRE(fine.status == TrackStatus::tracked);
    CHECK(angle(one.configuration.rotation, fine.configuration.rotation) < 1e-7);
    CHECK(one.steps > 1);
  }

  TEST_CASE("long steps end where short ones do, and no determinant changes its sign") {
    Random random(4);
    int divided = 0, compared = 0;
    for (int n = 0; n < cases(4000); ++n) {
      const auto [g, c] = random_robot(random);
      const Vec9 from = leg_lengths(g, c), to = from + random.log_uniform(0.01, 1.0) * random.matrix<Vec9>();
      if (!(to.minCoeff() > 0.0)) continue;
      const Tracked t = track(g, to, c);
      if (t.status != TrackStatus::tracked) continue;
      const auto before = ninedof::singularity_margins(g, c), after = ninedof::singularity_margins(g, t.configuration);
      CHECK((before.n * after.n > 0.0 && before.b * after.b > 0.0 && before.c * after.c > 0.0));
      divided += t.steps > 1 ? 1 : 0;
      if (n % 10 != 0) continue;
      std::vector<Vec9> path;
      for (int k = 1; k <= 100; ++k) path.push_back(k < 100 ? Vec9(from + k / 100.0 * (to - from)) : to);
      const Tracked fine = track(g, path, c).back();
      if (fine.status != TrackStatus::tracked) continue;
      CHECK(angle(t.configuration.rotation, fine.configuration.rotation) < 1e-6);
      ++compared;
    }
    CHECK(divided > cases(500));
    CHECK(compared > cases(100));
  }

  TEST_CASE("a path to a configuration and back ends at its start") {
    Random random(2);
    int kept = 0;
    for (int n = 0; n < 100; ++n) {
      const auto [g, c] = random_robot(random);
      const Vec9 direction = 0.15 * random.matrix<Vec9>();
      std::vector<Vec9> lengths;
      for (int k = 0; k <= 40; ++k)
        lengths.push_back(leg_lengths(g, ninedof::plus(c, std::sin(pi * k / 40.0) * direction)));
      const std::vector<Tracked> path = track(g, lengths, c);
      REQUIRE(path.size() == lengths.size());
      if (path.back().status != TrackStatus::tracked) continue;
      ++kept;
      CHECK((path.back().configuration.rotation - c.rotation).norm() < 1e-9);
      CHECK((path.back().configuration.position - c.position).norm() < 1e-9);
    }
    CHECK(kept > 50);
  }

  TEST_CASE("steps after one that is not tracked are not tried") {
    const Geometry g = Geometry::hexagonal(0.3, 2.0, 1.0, 0.2);
    const Configuration c = ninedof::neutral(2.0, 1.1);
    std::vector<Vec9> lengths(3, leg_lengths(g, c));
    lengths[1].tail<3>() *= 0.1;
    const std::vector<Tracked> path = track(g, lengths, c);
    CHECK(path[0].status == TrackStatus::tracked);
    CHECK(path[1].status == TrackStatus::infeasible);
    CHECK(path[2].status == TrackStatus::unproved);
    CHECK(path[1].configuration.rotation.hasNaN());
    CHECK(path[2].steps == 0);
  }

  TEST_CASE("a singularity on the path ends as lost after few steps") {
    // The external legs grow until the platform cannot follow: before that its mode meets another.
    const Geometry g = Geometry::hexagonal(0.3, 2.0, 1.0, 0.2);
    const Configuration c = ninedof::neutral(2.0, 1.1);
    Vec9 far = leg_lengths(g, c);
    far.head<3>() *= 1.9;  // the internal legs do not let the platform rise so far
    const Tracked t = track(g, far, c);
    CHECK(t.status != TrackStatus::tracked);
    CHECK(t.configuration.position.hasNaN());
    CHECK(t.reached < 1.0);
  }

  TEST_CASE("results scale with the length unit") {
    Random random(3);
    for (const double unit : {1e-6, 1e6}) {
      const auto [g, c] = random_robot(random);
      const Configuration to = ninedof::plus(c, 0.002 * random.matrix<Vec9>());
      const Robot big = scaled({g, c}, unit), big_to = scaled({g, to}, unit);
      const Tracked a = track(g, leg_lengths(g, to), c),
                    b = track(big.geometry, leg_lengths(big.geometry, big_to.configuration), big.configuration);
      CHECK(a.status == b.status);
      CHECK(relative_error(a.certificate, b.certificate) < 1e-6);
      CHECK((a.configuration.rotation - b.configuration.rotation).norm() < 1e-10);
    }
  }

  TEST_CASE("invalid lengths are rejected by name") {
    const Geometry g = Geometry::hexagonal(0.3, 2.0, 1.0, 0.2);
    CHECK(refuses("leg_lengths", [&] { track(g, Vec9::Constant(-1.0), ninedof::neutral(2.0, 1.1)); }));
  }
}
