/// accuracy.hpp against the inverse of differentiated leg lengths, against all 512 corners, and by the leg lengths of
/// the samples; and the private solver behind the samples.

#include "ninedof/statics/accuracy.hpp"

#include <doctest/doctest.h>

#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/robot/legs.hpp"
#include "support/oracle.hpp"
#include "support/singular.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

Mat9 oracle_map(const Robot& robot) {
  return oracle::rounded(oracle::inverse(oracle::rates(robot.geometry, robot.configuration)));
}

Tolerances random_tolerances(Random& random, double size) {
  Tolerances t;
  for (double& leg : t.legs) leg = random.uniform(0.0, size);
  for (double& joint : t.joints) joint = random.uniform(0.0, size);
  return t;
}

/// Legs and the joints at their ends, written out: r, r^, u, u~ by threes.
Vec9 box_of(const Tolerances& t) {
  Vec9 box = t.legs;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    box[k] += t.joints[i] + t.joints[i + 6];
    box[k + 3] += t.joints[i + 9];
    box[k + 6] += t.joints[i + 3];
  }
  return box;
}

}  // namespace

TEST_SUITE("accuracy") {
  TEST_CASE("the map inverts the differentiated leg lengths") {
    Random random(411);
    for (int n = 0; n < 500; ++n) {
      const Robot robot = random_robot(random);
      const Mat9 expected = oracle_map(robot), found = error_map(robot.geometry, robot.configuration);
      CHECK(matrix_error(found, expected) <= 64.0 * eps * expected.norm());
    }
  }

  TEST_CASE("bounds are the maxima over the 512 corners") {
    Random random(412);
    for (int n = 0; n < 100; ++n) {
      const Robot robot = random_robot(random);
      const Tolerances t = random_tolerances(random, 1e-3);
      const Mat9 map = oracle_map(robot) * box_of(t).asDiagonal();
      Vec9 components = Vec9::Zero();
      Vec3 distances = Vec3::Zero();
      for (unsigned corner = 0; corner < 512; ++corner) {
        Vec9 signs;
        for (unsigned k = 0; k < 9; ++k) signs[k] = (corner >> k & 1U) != 0U ? 1.0 : -1.0;
        const Vec9 motion = map * signs;
        components = components.cwiseMax(motion.cwiseAbs());
        for (Eigen::Index k = 0; k < 3; ++k) distances[k] = std::max(distances[k], motion.segment<3>(3 * k).norm());
      }
      const ErrorBounds found = error_bounds(robot.geometry, robot.configuration, t);
      CHECK(matrix_error(found.components, components) <= 1e-12);
      CHECK(relative_error(found.rotation, distances[0]) <= 1e-12);
      CHECK(relative_error(found.position, distances[1]) <= 1e-12);
      CHECK(relative_error(found.internal_point, distances[2]) <= 1e-12);
    }
  }

  TEST_CASE("singular configurations: infinite where the lengths do not determine the motion") {
    Random random(413);
    const Tolerances t = random_tolerances(random, 1e-3);
    for (int n = 0; n < 150; ++n) {
      const int kind = n % 3;
      const auto [g, c] = random_singular_robot(random, kind);
      const ErrorBounds found = error_bounds(g, c, t);
      CHECK(found.rotation == infinity);
      CHECK(found.position == infinity);
      CHECK(std::isinf(found.internal_point) == (kind == 0));
      CHECK(std::isinf(found.components[8]) == (kind == 0));
      CHECK(found.covariance(2, 2) == infinity);
      CHECK(std::isnan(found.covariance(8, 2)));
      CHECK(all_nan(error_sample(g, c, t, 0, 0)));
    }
  }

  TEST_CASE("samples: lengths within tolerance, a function of seed and index, close to the map where small") {
    Random random(414);
    const Robot robot = random_robot(random);
    const auto& [g, c] = robot;
    Tolerances t;
    t.legs.setConstant(1e-5);
    const Mat9 map = oracle_map(robot);
    const Vec9 rest = leg_lengths(g, c);
    for (std::uint64_t n = 0; n < 500; ++n) {
      const Vec9 motion = error_sample(g, c, t, 3, n);
      const Vec9 off = leg_lengths(g, plus(c, motion)) - rest;
      CHECK(off.cwiseAbs().maxCoeff() <= 1e-5 * (1.0 + 1e-9));
      CHECK((motion - map * off).norm() <= 1e-2 * motion.norm());
      CHECK(motion == error_sample(g, c, t, 3, n));
      CHECK(motion != error_sample(g, c, t, 4, n));
      CHECK(motion != error_sample(g, c, t, 3, n + 1));
    }
  }

  TEST_CASE("invalid tolerances are rejected, NaN gives NaN") {
    Random random(417);
    auto [g, c] = random_robot(random);
    for (const double bad : {-1e-12, infinity}) {
      Tolerances t;
      t.legs[3] = bad;
      CHECK(refuses("leg_errors", [&] { error_bounds(g, c, t); }));
      CHECK(refuses("leg_errors", [&] { error_sample(g, c, t, 0, 0); }));
      t = {};
      t.joints[11] = bad;
      CHECK(refuses("joint_errors", [&] { error_bounds(g, c, t); }));
      CHECK(refuses("joint_errors", [&] { error_sample(g, c, t, 0, 0); }));
    }
    Tolerances t;
    t.joints[5] = not_a_number;
    CHECK(all_nan(error_bounds(g, c, t).components));
    CHECK(std::isnan(error_bounds(g, c, t).position));
    CHECK(all_nan(error_sample(g, c, t, 0, 0)));
    c.position.x() = not_a_number;
    CHECK(all_nan(error_map(g, c)));
    CHECK(all_nan(error_bounds(g, c, {}).covariance));
    CHECK(all_nan(error_sample(g, c, {}, 0, 0)));
  }

  TEST_CASE("errors of joints fill a ball evenly: no mean, a fifth of the squared radius along every line") {
    Random random(7);
    constexpr int samples = 4000;
    constexpr double radius = 1e-5;
    for (int n = 0; n < 6; ++n) {
      const auto [g, c] = random_robot(random);
      Tolerances t;
      t.joints[0] = radius;  // r_1: what counts is the component along leg 1
      const Vec6 per_length = jacobian(g, c).col(0);
      double sum = 0.0, squares = 0.0;
      for (unsigned k = 0; k < samples; ++k) {
        const double moved = error_sample(g, c, t, 1, k).head<6>().dot(per_length) / per_length.squaredNorm() / radius;
        sum += moved;
        squares += moved * moved;
      }
      CHECK(std::abs(sum / samples) < 0.03);
      CHECK(std::abs(squares / samples - 0.2) < 0.02);
    }
  }
}
