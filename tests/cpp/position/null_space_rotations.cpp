/// null_space_rotations against the rotations from which the problems were built, against a scan of the circle of
/// rotations that solve the first equation (no quaternion, no linear algebra in it), and against symmetries. Where
/// solutions merge or form a curve, see degenerate_rotations.cpp.

#include <doctest/doctest.h>

#include <algorithm>

#include "math/rows_of.hpp"
#include "position/rotation_problem.hpp"
#include "support/oracle.hpp"
#include "support/rotation_problems.hpp"

using namespace ninedof;
using namespace support;

namespace {

const Triple axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};

/// A rotation with third column a.
Mat3 frame_on(const Vec3& a) {
  const Vec3 x = a.unitOrthogonal();
  Mat3 q;
  q << x, a.cross(x), a;
  return q;
}

/// Real solutions counted without solving. Q = X Rz(phi) Ry(a) Rz(psi) Y^T with X e_z = d_1, Y e_z = w_1, cos a = c_1
/// solves the first equation; the others read A cos psi + B sin psi + C = 0, and eliminating psi leaves a function of
/// phi that changes its sign at every simple solution. Two within one step of phi are missed.
int sign_changes(const RotationProblem& p) {
  const Mat3 x = frame_on(p.d[0]), y = frame_on(p.w[0]);
  const Mat3 tilt = Eigen::AngleAxisd(std::acos(p.c[0]), Vec3::UnitY()).toRotationMatrix();
  const auto eliminated = [&](double phi) {
    const Mat3 left = x * Eigen::AngleAxisd(phi, Vec3::UnitZ()).toRotationMatrix() * tilt;
    const auto row = [&](std::size_t i) {
      const Vec3 d = left.transpose() * p.d[i], w = y.transpose() * p.w[i];
      return Vec3(d.x() * w.x() + d.y() * w.y(), d.y() * w.x() - d.x() * w.y(),
                  d.z() * w.z() - p.c[static_cast<Eigen::Index>(i)]);
    };
    const Vec3 n = row(1).cross(row(2));  // (cos psi, sin psi, 1) is parallel to it
    return n.x() * n.x() + n.y() * n.y() - n.z() * n.z();
  };
  constexpr int steps = 3000;
  int changes = 0;
  bool before = eliminated(0.0) > 0.0;
  for (int k = 1; k <= steps; ++k) {
    const bool now = eliminated(2.0 * pi * k / steps) > 0.0;
    changes += now != before ? 1 : 0;
    before = now;
  }
  return changes;
}

/// A random rotation, a half turn, or one within 1e-3 to 1e-14 of a half turn or of the identity.
Mat3 some_rotation(Random& random, int kind) {
  switch (kind % 4) {
    case 0: return Eigen::AngleAxisd(pi, random.unit()).toRotationMatrix();
    case 1: return Eigen::AngleAxisd(pi - random.log_uniform(1e-14, 1e-3), random.unit()).toRotationMatrix();
    case 2: return random.rotation(random.log_uniform(1e-14, 1e-3));
    default: return random.rotation();
  }
}

/// Directions from O to the joints of a neutral robot with the hexagons a1, a2, b1, b2: solved by the identity.
RotationProblem neutral_problem(double a1, double a2, double b1, double b2, double zp, double zs) {
  const Geometry g = Geometry::hexagonal(a1, a2, b1, b2);
  Triple d, w;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = (g.base_external()[i] - Vec3(0.0, 0.0, zs)).normalized();
    w[i] = (g.platform_external()[i] + Vec3(0.0, 0.0, zp - zs)).normalized();
  }
  return solved_by(Mat3::Identity(), d, w);
}

bool same_candidates(const RotationCandidates& a, const RotationCandidates& b) {
  bool same = a.count == b.count && a.reliable == b.reliable && a.self_motion == b.self_motion;
  for (std::size_t k = 0; same && k < static_cast<std::size_t>(a.count); ++k) same = a.rotation[k] == b.rotation[k];
  return same;
}

}  // namespace

TEST_SUITE("null_space_rotations") {
  TEST_CASE("the original rotation is found, to the accuracy of its condition; solutions come in pairs") {
    Random random(301);
    std::array<int, 9> counts{};
    double worst_candidate = 0.0, worst = 0.0, worst_residual = 0.0;
    for (int n = 0; n < 20000; ++n) {
      const Mat3 q = some_rotation(random, n);
      const RotationProblem p = solved_by(q, random_directions(random), random_directions(random));
      const RotationCandidates candidates = null_space_rotations(p);
      CHECK((candidates.reliable && !candidates.self_motion));
      const auto found = solutions(p, candidates);
      double candidate = infinity, accuracy = infinity;
      for (std::size_t k = 0; k < static_cast<std::size_t>(candidates.count); ++k)
        candidate = std::min(candidate, apart(candidates.rotation[k], q));
      for (const auto& s : found) {
        accuracy = std::min(accuracy, apart(s.rotation, q) * oracle::least_singular_value(rows_of(s.at.row)));
        worst_residual = std::max(worst_residual, residual(p, s.rotation));
      }
      worst_candidate = std::max(worst_candidate, candidate);
      worst = std::max(worst, accuracy);
      ++counts[found.size()];
    }
    CHECK(worst_candidate <= 1e-8);
    CHECK(worst <= 32.0 * eps);
    CHECK(worst_residual <= 32.0 * eps);
    CHECK(counts[1] + counts[3] + counts[5] + counts[7] == 0);
    for (const std::size_t even : {2, 4, 6, 8}) CHECK(counts[even] > 20);
  }

  TEST_CASE("all real solutions are found, and no others") {
    Random random(302);
    int equal = 0;
    constexpr int problems = 300;
    for (int n = 0; n < problems; ++n) {
      // Half of the problems are not built from a solution.
      RotationProblem p = solved_by(random.rotation(), random_directions(random), random_directions(random));
      if (n % 2 == 1) p.c = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
      const int found = static_cast<int>(solutions(p).size()), expected = sign_changes(p);
      CHECK(found >= expected);
      CHECK((found - expected) % 2 == 0);
      equal += found == expected ? 1 : 0;
    }
    CHECK(equal >= problems - 3);  // the scan misses pairs less than 0.002 apart
  }

  TEST_CASE("eight solutions: two orthonormal triads and a zero diagonal") {
    const auto found = solutions({axes, axes, Vec3::Zero()});
    CHECK(found.size() == 8);
    // The two cyclic permutations, with an even number of minus signs.
    for (const Mat3& cycle : {Mat3{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, Mat3{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}})
      for (const Vec3& signs : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
        CHECK(distance(found, signs.asDiagonal() * cycle) <= 32.0 * eps);
    for (const auto& s : found)
      CHECK((rows_of(s.at.row) * rows_of(s.at.row).transpose() - Mat3::Identity()).norm() <= 32.0 * eps);
    // They are simple, so nearby problems also have eight.
    Random random(303);
    for (int n = 0; n < 200; ++n) {
      Triple d = axes, w = axes;
      for (std::size_t i = 0; i < 3; ++i) {
        d[i] = (d[i] + 0.1 * random.unit()).normalized();
        w[i] = (w[i] + 0.1 * random.unit()).normalized();
      }
      CHECK(solutions({d, w, 0.1 * random.unit()}).size() == 8);
    }
  }

  TEST_CASE("neutral robots, their joints coupled or not; regular and similar hexagons") {
    struct Sides {
      double a1, a2, b1, b2;
    };
    for (const Sides& s :
         {Sides{0, 3, 2, 0}, {0, 1.5, 1.5, 0}, {1, 3, 2, 0.5}, {0.5, 3, 2, 1}, {0, 3, 2, 1}, {1, 3, 2, 0}})
      for (const double zs : {0.4, 1.0, 1.9, 2.0}) {
        CAPTURE(s.a1);
        CAPTURE(zs);
        const auto found = solutions(neutral_problem(s.a1, s.a2, s.b1, s.b2, 2.0, zs));
        CHECK(found.size() % 2 == 0);
        CHECK(distance(found, Mat3::Identity()) <= 16.0 * eps);
      }
    // a1/a2 = b1/b2: the neutral pose is singular, a double root.
    for (const Sides& s : {Sides{1, 2, 1, 2}, {1, 1, 1, 1}, {0.6, 1.2, 1, 2}})
      CHECK(distance(solutions(neutral_problem(s.a1, s.a2, s.b1, s.b2, 2.0, 0.7)), Mat3::Identity()) <= 1e-6);
  }

  TEST_CASE("mirror images: O below its platform, O below the base, base and platform exchanged") {
    const Mat3 z = Vec3(1, 1, -1).asDiagonal();
    Random random(304);
    for (int n = 0; n < 300; ++n) {
      const RotationProblem p =
          n < 30 ? neutral_problem(0.05 * n, 3, 2, 0.03 * n, 2.0, 0.7)
                 : solved_by(random.rotation(), random_directions(random), random_directions(random));
      const auto found = solutions(p);
      const auto below_platform = solutions({p.d, turned(z, p.w), -p.c});  // -QZ: d.(-QZ) Zw = -d.Qw
      const auto below_base = solutions({turned(z, p.d), turned(z, p.w), p.c});
      const auto exchanged = solutions({p.w, p.d, p.c});
      CHECK(below_platform.size() == found.size());
      CHECK(below_base.size() == found.size());
      CHECK(exchanged.size() == found.size());
      for (const auto& s : found) {
        const double tolerance = 64.0 * eps / oracle::least_singular_value(rows_of(s.at.row));
        CHECK(distance(below_platform, -s.rotation * z) <= tolerance);
        CHECK(distance(below_base, z * s.rotation * z) <= tolerance);
        CHECK(distance(exchanged, s.rotation.transpose()) <= tolerance);
      }
    }
  }

  TEST_CASE("rotated axes give rotated solutions") {
    Random random(305);
    for (int n = 0; n < 300; ++n) {
      const RotationProblem p = solved_by(random.rotation(), random_directions(random), random_directions(random));
      const auto found = solutions(p);
      const Mat3 left = random.rotation();
      // Makes a half turn of the first solution.
      const Mat3 half_turn = Eigen::AngleAxisd(pi, random.unit()).toRotationMatrix();
      const Mat3 right = half_turn * left * found[0].rotation;
      const auto other = solutions({turned(left, p.d), turned(right, p.w), p.c});
      CHECK(other.size() == found.size());
      for (const auto& s : found)
        CHECK(distance(other, left * s.rotation * right.transpose()) <=
              64.0 * eps / oracle::least_singular_value(rows_of(s.at.row)));
    }
  }

  TEST_CASE("input that is not finite gives no candidates; the same problem gives the same bits") {
    Random random(311);
    const RotationProblem good = solved_by(random.rotation(), random_directions(random), random_directions(random));
    const RotationCandidates once = null_space_rotations(good);
    for (const double bad : {not_a_number, infinity}) {
      for (int which = 0; which < 3; ++which) {
        RotationProblem p = good;
        (which == 0 ? p.d[1].y() : which == 1 ? p.w[0].z() : p.c[2]) = bad;
        const RotationCandidates none = null_space_rotations(p);
        CHECK((none.count == 0 && !none.reliable && !none.self_motion));
      }
    }
    CHECK(same_candidates(null_space_rotations(good), once));
  }
}
