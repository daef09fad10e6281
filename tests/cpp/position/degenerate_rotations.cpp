/// null_space_rotations where solutions merge, form a curve, or satisfy g = 0 for a form g of the method: against
/// the rotations from which the problems were built.

#include <doctest/doctest.h>

#include "position/rotation_problem.hpp"
#include "support/rotation_problems.hpp"

using namespace ninedof;
using namespace support;

TEST_SUITE("degenerate_rotations") {
  TEST_CASE("one, two or three legs through O (|c_i| = 1): roots of multiplicity 2, 4 and 8") {
    Random random(306);
    for (int n = 0; n < 200; ++n) {
      const Mat3 q = random.rotation();
      const Triple d = random_directions(random);
      Triple w = random_directions(random);
      for (std::size_t i = 0; i < 3; ++i) {
        w[i] = random.sign() * (q.transpose() * d[i]);
        RotationProblem p = solved_by(q, d, w);
        p.c = p.c.cwiseMax(-1.0).cwiseMin(1.0);
        const auto found = solutions(p);
        CHECK(distance(found, q) <= 1e-6);
        for (const auto& s : found) CHECK(residual(p, s.rotation) <= 1e-13);
      }
    }
  }

  TEST_CASE("double roots, and two solutions that have nearly merged") {
    Random random(307);
    for (const double shift : {0.0, 1e-15, 1e-9, 1e-6, 1e-4}) {
      int odd = 0;
      for (int n = 0; n < 1500; ++n) {
        const Mat3 q = random.rotation();
        const Triple d = random_directions(random);
        Vec3 axis;
        const Triple w = with_double_root(random, q, d, random_directions(random), axis);
        const Mat3 beside = Eigen::AngleAxisd(shift, axis).toRotationMatrix() * q;  // 2 shift from the other
        const RotationProblem p = solved_by(beside, d, w);
        const auto found = solutions(p);
        CHECK(distance(found, beside) <= 1e-5);
        for (const auto& s : found) CHECK(residual(p, s.rotation) <= 1e-13);
        odd += static_cast<int>(found.size() % 2);
      }
      if (shift >= 1e-6) CHECK(odd == 0);
      if (shift == 0.0) CHECK(odd > 1000);  // the pair is usually counted once
    }
  }

  TEST_CASE("self-motion: two pairs parallel with each other, all base or all platform directions parallel") {
    Random random(308);
    for (int n = 0; n < 200; ++n) {
      const Mat3 q = random.rotation();
      const double sign = random.sign();
      const auto self_motion = [&](const Triple& d, const Triple& w) {
        const RotationCandidates c = null_space_rotations(solved_by(q, d, w));
        return c.self_motion && c.count == 0 && c.reliable;
      };
      Triple d = random_directions(random), w = random_directions(random);
      d[2] = sign * d[0];
      w[2] = sign * w[0];
      CHECK(self_motion(d, w));
      // With other lengths the two legs are incompatible.
      RotationProblem p = solved_by(q, d, w);
      p.c[2] += 0.01;
      CHECK((solutions(p).empty() && !null_space_rotations(p).self_motion));
      // Only base directions, only platform directions, or both but of different legs: no special case.
      for (const auto& [a, b] :
           {std::pair{d, random_directions(random)}, {random_directions(random), w}, {Triple{d[0], d[2], d[1]}, w}})
        CHECK(distance(solutions(solved_by(q, a, b)), q) <= 1e-7);
      d[1] = -d[0];
      CHECK(self_motion(d, random_directions(random)));
      w[1] = w[0];
      CHECK(self_motion(random_directions(random), w));
      CHECK(self_motion(d, w));
    }
  }

  TEST_CASE("coplanar directions are no special case") {
    Random random(309);
    for (int n = 0; n < 300; ++n) {
      const Mat3 q = random.rotation();
      Triple d = random_directions(random), w = random_directions(random);
      d[2] = (random.normal() * d[0] + random.normal() * d[1]).normalized();
      if (n % 2 == 1) w[2] = (random.normal() * w[0] + random.normal() * w[1]).normalized();
      const auto found = solutions(solved_by(q, d, w));
      CHECK(found.size() % 2 == 0);
      CHECK(distance(found, q) <= 1e-9);
    }
  }

  TEST_CASE("a solution with g = 0 for one, two or three of the four pairs of forms") {
    // The rows of g, to which z is made orthogonal; its length does not matter.
    constexpr double a = 0.6821, b = 0.2714, c = -0.3917, d = 0.5547;
    const Eigen::Matrix4d g{{a, b, c, d}, {-b, a, -d, c}, {-c, d, a, -b}, {-d, -c, b, a}};
    CHECK((g * g.transpose() - Eigen::Matrix4d::Identity()).norm() < 1e-3);
    Random random(310);
    for (int n = 0; n < 300; ++n) {
      const int planes = 1 + n % 3;
      Eigen::Vector4d inside = random.matrix<Eigen::Vector4d>();
      inside.head(planes).setZero();
      const Eigen::Vector4d z = (g.transpose() * inside).normalized();
      const Mat3 q = Eigen::Quaterniond(z[0], z[1], z[2], z[3]).toRotationMatrix();
      const RotationProblem p = solved_by(q, random_directions(random), random_directions(random));
      CHECK(null_space_rotations(p).reliable);
      const auto found = solutions(p);
      CHECK(distance(found, q) <= 1e-9);
      // With rotated platform axes no solution has g = 0, and all of them must correspond.
      const Mat3 turn = random.rotation();
      const auto elsewhere = solutions({p.d, turned(turn, p.w), p.c});
      CHECK(elsewhere.size() == found.size());
      for (const auto& s : elsewhere) CHECK(distance(found, s.rotation * turn) <= 1e-9);
    }
  }
}
