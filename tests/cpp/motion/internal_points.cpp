/// internal_points.hpp: every rule against what it promises of O.

#include "ninedof/motion/internal_points.hpp"

#include <doctest/doctest.h>

#include "ninedof/conditioning/conditioning.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

using Kind = TrajectoryRule::Kind;

const Configuration turned_home = neutral(3.9828, 2.4432, 0.2);

Trajectory random_trajectory(Random& random, int n) {
  Trajectory out;
  for (int k = 0; k < n; ++k) {
    out.time.push_back(k);
    out.poses.push_back({turned_home.position + 0.5 * random.unit(), random.rotation(0.5)});
  }
  return out;
}

Trajectory line(std::size_t n) {
  Trajectory out;
  for (std::size_t k = 0; k < n; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(n - 1);
    out.time.push_back(share);
    out.poses.push_back({turned_home.position + share * Vec3(0.6, 0.2, 0.1), turned_home.rotation});
  }
  return out;
}

}  // namespace

TEST_SUITE("internal_points") {
  TEST_CASE("O keeps its place in the platform, relative to its origin or in the base") {
    Random random(321);
    const Trajectory trajectory = random_trajectory(random, 20);
    const Configuration start{random.matrix<Vec3>(), random.rotation(), random.matrix<Vec3>()};
    const auto carried = internal_points(published, trajectory, start, {});
    const auto shifted = internal_points(published, trajectory, start, {Kind::shifted});
    const auto held = internal_points(published, trajectory, start, {Kind::held});
    const Vec3 relative = start.internal_point - start.position;
    for (std::size_t k = 0; k < 20; ++k) {
      const auto& [p, q] = trajectory.poses[k];
      CHECK((start.rotation * q.transpose() * (carried[k] - p) - relative).norm() < 1e-13);
      CHECK((shifted[k] - p - relative).norm() < 1e-14);
      CHECK(held[k] == start.internal_point);
    }
  }

  TEST_CASE("O between the plates divides the way from the lower to the upper internal joints") {
    Random random(322);
    const Geometry g = random_robot(random).geometry;
    const Trajectory trajectory = random_trajectory(random, 20);
    const auto at = [&](double fraction) {
      return internal_points(g, trajectory, turned_home, {Kind::between, fraction});
    };
    const auto below = at(0.0), above = at(1.0), between = at(0.3);
    for (std::size_t k = 0; k < 20; ++k) {
      Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
      for (std::size_t i = 0; i < 3; ++i) {
        lower += g.base_internal()[i] / 3.0;
        upper += (trajectory.poses[k].position + trajectory.poses[k].rotation * g.platform_internal()[i]) / 3.0;
      }
      CHECK((below[k] - lower).norm() < 1e-13);
      CHECK((above[k] - upper).norm() < 1e-13);
      CHECK((between[k] - (0.7 * lower + 0.3 * upper)).norm() < 1e-13);
    }
  }

  TEST_CASE("the best O is that of best_internal_path, and between the poses searched nearly as good") {
    constexpr std::size_t n = sanitized ? 41 : 401, step = sanitized ? 1 : 2;  // all of the shorter one are searched
    const Trajectory every = line(n);
    std::vector<PlatformPose> searched;
    for (std::size_t k = 0; k < n; k += step) searched.push_back(every.poses[k]);
    if (!sanitized) REQUIRE(searched.size() == TrajectoryRule::most_searched);
    const auto path =
        best_internal_path(published, searched, {}, 0.1, internal_points(published, every, turned_home, {})[0]);
    const auto found = internal_points(published, every, turned_home, {Kind::best});
    REQUIRE(found.size() == n);
    const auto index = [&](std::size_t k) {
      return condition_number(published, {every.poses[k].position, every.poses[k].rotation, found[k]});
    };
    for (std::size_t k = 0; k < n; k += step) CHECK((found[k] - path[k / step].s).norm() < 1e-12);
    for (std::size_t k = 1; k + 1 < n; k += 2)
      CHECK(relative_error(index(k), 0.5 * (index(k - 1) + index(k + 1))) < 1e-3);
  }

  TEST_CASE("a pose that allows no O is named with what forbids it, and bad arguments are refused") {
    InternalPointProblem problem;
    problem.limits.high.setConstant(3.0);
    const auto best = [&] { internal_points(published, line(5), turned_home, {Kind::best}, problem); };
    CHECK(message_of(best).starts_with(
        "internal_point: got 'best', but no position of O is allowed at t = 0 (l1 high, "));
    CHECK(refuses("internal_point",
                  [&] { internal_points(published, line(5), turned_home, {Kind::between, not_a_number}); }));
    Trajectory wrong = line(5);
    wrong.time[3] = wrong.time[2];
    CHECK(refuses("time", [&] { internal_points(published, wrong, turned_home, {}); }));
    wrong.time.pop_back();
    CHECK(refuses("poses", [&] { internal_points(published, wrong, turned_home, {}); }));
    CHECK(refuses("time", [&] { internal_points(published, line(2), turned_home, {}); }));
    wrong = line(5);
    wrong.poses[2].rotation *= 2.0;
    CHECK(refuses("rotation", [&] { wrong.validate(); }));
  }
}
