/// Internal points: local optimality, limits, reasons of failure, stopping a path. The search of the whole chamber is
/// in the Python tests.

#include <doctest/doctest.h>

#include <cmath>
#include <stop_token>

#include "ninedof/conditioning/conditioning.hpp"
#include "ninedof/redundancy/redundancy_path.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/support.hpp"

using namespace support;
using ninedof::best_internal_path;
using ninedof::best_internal_point;
using ninedof::Criterion;
using ninedof::InternalPoint;
using ninedof::InternalPointProblem;
using ninedof::InternalPointStatus;

TEST_SUITE("redundancy") {
  TEST_CASE("no point near an optimum is better") {
    Random random(1);
    int inside = 0;  // away from limits and walls, where all neighbours are allowed
    for (int n = 0; n < 40; ++n) {
      const Vec3 p = Vec3(0.0, 0.0, 3.98) + 0.5 * random.unit();
      const Mat3 q = random.rotation(0.3);
      for (const Criterion criterion : {Criterion::condition_number, Criterion::leg_centring}) {
        InternalPointProblem problem;
        problem.criterion = criterion;
        problem.limits.low.setConstant(1.0);
        problem.limits.high.setConstant(6.0);
        const InternalPoint best = best_internal_point(published, p, q, problem);
        if (best.status == InternalPointStatus::infeasible || !best.active.empty()) continue;
        REQUIRE(best.status == InternalPointStatus::found);
        ++inside;
        const auto value = [&](const Vec3& s) {
          const Configuration c{p, q, s};
          if (criterion == Criterion::condition_number) return ninedof::condition_number(published, c);
          return ((ninedof::leg_lengths(published, c).tail<6>().array() - 3.5) / 2.5).square().sum();
        };
        CHECK(relative_error(best.value, value(best.s)) < 1e-12);
        for (int k = 0; k < 100; ++k)
          CHECK(value(best.s + random.log_uniform(1e-5, 1e-1) * random.unit()) >= best.value * (1.0 - 1e-9));
      }
    }
    CHECK(inside > 40);
  }

  TEST_CASE("a path of one pose has the best point of that pose, and a fine path has small steps") {
    InternalPointProblem problem;
    const Vec3 p(0.4, -0.2, 3.9);
    const InternalPoint alone = best_internal_point(published, p, Mat3::Identity(), problem);
    const std::vector<ninedof::PlatformPose> one{{p, Mat3::Identity()}};
    const auto path = best_internal_path(published, one, problem, 0.1);
    REQUIRE(path.size() == 1);
    CHECK((path[0].s - alone.s).norm() < 1e-5);
    std::vector<ninedof::PlatformPose> poses;
    for (int k = 0; k <= 50; ++k) poses.push_back({Vec3(-1.0 + 0.04 * k, 0.3, 4.0), Mat3::Identity()});
    const auto line = best_internal_path(published, poses, problem, 0.05);
    for (std::size_t k = 0; k < line.size(); ++k) {
      CHECK(line[k].status == InternalPointStatus::found);
      if (k > 0) CHECK((line[k].s - line[k - 1].s).norm() < 0.1);
    }
  }

  TEST_CASE("a pose without a point says why") {
    InternalPointProblem problem;
    problem.limits.high.setConstant(4.0);
    const InternalPoint legs = best_internal_point(published, {0.0, 0.0, 3.98}, Mat3::Identity(), problem);
    CHECK(legs.status == InternalPointStatus::infeasible);
    CHECK(legs.active.names() == std::vector<std::string>{"l1 high", "l2 high", "l3 high"});
    CHECK(legs.s.hasNaN());
    problem.limits.high.setConstant(infinity);
    CHECK(best_internal_point(published, {0.0, 0.0, 3.98}, Mat3::Identity(), problem, Vec3(0.1, 0.0, 0.0)).status ==
          InternalPointStatus::singular);
    CHECK(best_internal_point(published, {0.0, 0.0, not_a_number}, Mat3::Identity(), problem).status ==
          InternalPointStatus::missing);
    problem.characteristic_length = -1.0;
    CHECK(refuses("characteristic_length",
                  [&] { best_internal_point(published, {0.0, 0.0, 3.98}, Mat3::Identity(), problem); }));
    problem.characteristic_length = 1.0;
    const std::vector<ninedof::PlatformPose> one{{{0.0, 0.0, 3.98}, Mat3::Identity()}};
    CHECK(refuses("smoothness", [&] { best_internal_path(published, one, problem, 0.0); }));
  }

  TEST_CASE("a closed path ends where it begins, and does not depend on where that is") {
    // A third of a turn further on the robot is the same, and so is its size, the unit of the smoothness.
    const auto loop = [](int first) {
      std::vector<ninedof::PlatformPose> poses;
      for (int k = 0; k <= 12; ++k) {
        const double angle = 2.0 * pi * ((first + k) % 12) / 12.0;
        poses.push_back({Vec3(0.6 * std::cos(angle), 0.6 * std::sin(angle), 4.0), Mat3::Identity()});
      }
      return poses;
    };
    const auto path = best_internal_path(published, loop(0), {}, 0.1),
               later = best_internal_path(published, loop(4), {}, 0.1);
    CHECK((path.front().s == path.back().s && path.front().value == path.back().value));
    for (std::size_t k = 0; k < 12; ++k) CHECK((later[k].s - path[(k + 4) % 12].s).norm() < 1e-5);
    std::vector<ninedof::PlatformPose> poses = loop(0);
    CHECK(is_closed(poses));
    poses.back().position.x() += 1e-11;
    CHECK_FALSE(is_closed(poses));
    CHECK_FALSE(is_closed(std::vector<ninedof::PlatformPose>(12, poses.front())));
    CHECK_FALSE(is_closed(std::vector{poses[0], poses[1], poses[0]}));
  }

  TEST_CASE("a stop ends a path during the searches and during the descent") {
    const std::vector<ninedof::PlatformPose> poses(40, {{0.4, -0.2, 3.9}, Mat3::Identity()});
    for (const long last : {3L, 40L}) {
      std::stop_source source;
      long reported = 0;
      const ninedof::Control control{source.get_token(), [&](long done, long total, double value) {
                                       CHECK(done == ++reported);
                                       CHECK(total == 40);
                                       CHECK(std::isnan(value));
                                       if (done == last) source.request_stop();
                                     }};
      CHECK_THROWS_AS(best_internal_path(published, poses, {}, 0.1, {}, control), ninedof::Stopped);
      CHECK(reported == last);
    }
  }
}
