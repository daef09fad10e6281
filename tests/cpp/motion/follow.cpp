/// follow.hpp against difference quotients of distances between joints, power, and tracking.

#include "ninedof/motion/follow.hpp"

#include <doctest/doctest.h>

#include <stop_token>

#include "ninedof/conditioning/conditioning.hpp"
#include "support/motion.hpp"

using namespace ninedof;
using namespace support;

namespace {

const Configuration home = neutral(3.9828, 2.4432);

/// A smooth motion about home for a second.
Trajectory waves(Random& random, int n) {
  const Vec3 shift = 0.3 * random.unit(), turn = 0.25 * random.unit(), phase = random.matrix<Vec3>();
  Trajectory out;
  for (int k = 0; k < n; ++k) {
    const double t = static_cast<double>(k) / (n - 1);
    const Vec3 sines = (3.0 * t * Vec3::Ones() + phase).array().sin(), w = turn.cwiseProduct(sines);
    out.time.push_back(t);
    out.poses.push_back(
        {home.position + shift.cwiseProduct(sines), Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix()});
  }
  return out;
}

/// Distance of the joints of leg k.
double distance(const PlatformPose& pose, const Vec3& s, int k) {
  const std::size_t i = static_cast<std::size_t>(k % 3);
  if (k < 3)
    return (pose.position + pose.rotation * published.platform_external()[i] - published.base_external()[i]).norm();
  if (k < 6) return (pose.position + pose.rotation * published.platform_internal()[i] - s).norm();
  return (published.base_internal()[i] - s).norm();
}

}  // namespace

TEST_SUITE("follow") {
  TEST_CASE("rates and accelerations are those of the distances between the joints") {
    Random random(331);
    for (const auto kind : {TrajectoryRule::Kind::carried, TrajectoryRule::Kind::shifted, TrajectoryRule::Kind::held,
                            TrajectoryRule::Kind::between}) {
      const Trajectory trajectory = waves(random, 801);
      FollowSettings settings;
      settings.rule = {kind, 0.4};
      const Followed found = follow(published, trajectory, home, settings);
      const double h = trajectory.time[1];
      for (std::size_t k = 1; k + 1 < 801; ++k)
        for (int leg = 0; leg < 9; ++leg) {
          const auto length = [&](std::size_t j) {
            return distance(trajectory.poses[j], found.internal_point[j], leg);
          };
          const double rate = (length(k + 1) - length(k - 1)) / (2.0 * h);
          const double acceleration = (length(k + 1) - 2.0 * length(k) + length(k - 1)) / (h * h);
          CHECK(std::abs(found.leg_lengths[k][leg] - length(k)) < 1e-13);
          CHECK(std::abs(found.leg_rates[k][leg] - rate) < 5e-5);
          CHECK(std::abs(found.leg_accelerations[k][leg] - acceleration) < 5e-4);
        }
      CHECK(found.tracked == 801);
      CHECK(found.tracking_error < 1e-9);
      CHECK(found.breaks.empty());
      CHECK(found.leg_forces.empty());
      const Configuration last{trajectory.poses[800].position, trajectory.poses[800].rotation,
                               found.internal_point[800]};
      CHECK(found.condition_number[800] == condition_number(published, last));
    }
  }

  TEST_CASE("leg forces have the power of the load") {
    Random random(332);
    const Trajectory trajectory = waves(random, 50);
    FollowSettings settings;
    for (int k = 0; k < 50; ++k) settings.loads.push_back({random.matrix<Vec3>(), random.matrix<Vec3>()});
    const Followed found = follow(published, trajectory, home, settings);
    for (std::size_t k = 0; k < 50; ++k) {
      const Load& load = settings.loads[k];
      const Velocity& v = found.derivatives.velocity[k];
      const double power =
          found.leg_forces[k].dot(found.leg_rates[k]) + load.moment.dot(v.omega) + load.force.dot(v.pdot);
      CHECK(std::abs(power) < 1e-11);
    }
  }

  TEST_CASE("tracking ends at a singularity, whose time is known") {
    Trajectory down;  // the platform reaches the height of O, which is held
    for (int k = 0; k <= 100; ++k) {
      down.time.push_back(0.01 * k);
      down.poses.push_back({home.position - Vec3(0.0, 0.0, 0.03 * k), home.rotation});
    }
    FollowSettings settings;
    settings.rule.kind = TrajectoryRule::Kind::held;
    settings.limits.low[0] = distance(down.poses[50], home.internal_point, 0);
    const Followed found = follow(published, down, home, settings);
    const double crossing = (3.9828 - 2.4432) / 3.0;
    const auto of = [&](const std::string& name) {
      return std::ranges::find_if(found.breaks, [&](const LimitBreak& b) { return b.limit == name; });
    };
    REQUIRE(of("det C") != found.breaks.end());
    CHECK(std::abs(of("det C")->begin - crossing) < 1e-2);
    REQUIRE(of("l1 low") != found.breaks.end());
    CHECK(of("l1 low")->begin == doctest::Approx(0.5));
    CHECK(down.time[found.tracked - 1] < crossing);
    CHECK(down.time[found.tracked] > crossing - 0.02);
  }

  TEST_CASE("threads change nothing, a stop ends the call, bad arguments are refused") {
    Random random(333);
    const Trajectory trajectory = waves(random, 300);
    FollowSettings settings;
    settings.threads = 1;
    const Followed one = follow(published, trajectory, home, settings);
    settings.threads = 3;
    const Followed three = follow(published, trajectory, home, settings);
    CHECK(one.leg_accelerations == three.leg_accelerations);
    CHECK(one.condition_number == three.condition_number);
    std::stop_source source;
    source.request_stop();
    CHECK_THROWS_AS(follow(published, trajectory, home, settings, {source.get_token(), {}}), Stopped);
    settings.loads.resize(2);
    CHECK(refuses("loads", [&] { follow(published, trajectory, home, settings); }));
    settings.loads.clear();
    settings.limits = {Vec9::Constant(5.0), Vec9::Constant(2.0)};
    CHECK(message_of([&] { follow(published, trajectory, home, settings); }).starts_with("limits: got 5 to 2"));
    settings.limits = {};
    settings.characteristic_length = 0.0;
    CHECK(refuses("characteristic_length", [&] { follow(published, trajectory, home, settings); }));
  }
}
