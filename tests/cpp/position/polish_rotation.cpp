/// polish_rotation.hpp against the rotations from which the problems were built, against finite differences, and
/// against Kantorovich's theorem on where Newton's method converges.

#include "position/polish_rotation.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "math/rows_of.hpp"
#include "support/oracle.hpp"
#include "support/rotation_problems.hpp"

using namespace ninedof;
using namespace support;

namespace {

double orthogonality_error(const Mat3& q) {
  return (q.transpose() * q - Mat3::Identity()).cwiseAbs().maxCoeff();
}

double smallest_singular_value(const Mat3& m) {
  return oracle::least_singular_value(m);
}

Mat3 turned_by(const Vec3& v, const Mat3& q) {
  return Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix() * q;
}

Mat3 jacobian(const RotationProblem& p, const Mat3& q) {
  Mat3 j;
  for (std::size_t i = 0; i < 3; ++i) j.row(static_cast<Eigen::Index>(i)) = (q * p.w[i]).cross(p.d[i]);
  return j;
}

}  // namespace

TEST_SUITE("polish_rotation") {
  TEST_CASE("from within a third of the smallest singular value the nearby solution is reached, half turns too") {
    Random random(321);
    for (int n = 0; n < 5000; ++n) {
      const Mat3 q = n % 3 == 0 ? Eigen::AngleAxisd(pi, random.unit()).toRotationMatrix() : random.rotation();
      const RotationProblem p = solved_by(q, random_directions(random), random_directions(random));
      const double sigma = smallest_singular_value(jacobian(p, q));
      const auto s = polish_rotation(p, turned_by(0.33 * sigma * random.unit(), q));
      CHECK(s.converged());
      CHECK(apart(s.rotation, q) <= 16.0 * eps / sigma);
      CHECK(residual(p, s.rotation) <= 8.0 * eps);
      CHECK(std::abs(residual(p, s.rotation) - s.residual()) <= 4.0 * eps);
      CHECK(orthogonality_error(s.rotation) <= 2e-15);
      CHECK(s.rotation.determinant() > 0.0);
    }
  }

  TEST_CASE("convergence is quadratic") {
    Random random(322);
    for (int n = 0; n < 300; ++n) {
      const Mat3 q = random.rotation();
      const RotationProblem p = solved_by(q, random_directions(random), random_directions(random));
      const double sigma = smallest_singular_value(jacobian(p, q));
      if (sigma < 0.1) continue;
      const Mat3 start = turned_by(1e-3 * random.unit(), q);
      CHECK(apart(polish_rotation(p, start, 1).rotation, q) <= 1e-6 / sigma);
      CHECK(apart(polish_rotation(p, start, 3).rotation, q) <= 16.0 * eps / sigma);
    }
  }

  TEST_CASE("the Jacobian is the derivative of the equations by a rotation in base axes") {
    Random random(323);
    for (int n = 0; n < 100; ++n) {
      const RotationProblem p = solved_by(random.rotation(), random_directions(random), random_directions(random));
      const auto s = polish_rotation(p, random.rotation());
      constexpr double h = 1e-5;
      for (int k = 0; k < 3; ++k) {
        const Vec3 plus = solved_by(turned_by(h * Vec3::Unit(k), s.rotation), p.d, p.w).c;
        const Vec3 minus = solved_by(turned_by(-h * Vec3::Unit(k), s.rotation), p.d, p.w).c;
        CHECK(((plus - minus) / (2.0 * h) - rows_of(s.at.row).col(k)).norm() <= 1e-9);
      }
    }
  }

  TEST_CASE("from any start: a solution, or a residual that shows there is none; always a rotation") {
    Random random(324);
    int reached = 0;
    for (int n = 0; n < 3000; ++n) {
      const RotationProblem p = solved_by(random.rotation(), random_directions(random), random_directions(random));
      const Mat3 start = random.rotation();
      const auto s = polish_rotation(p, start);
      CHECK(orthogonality_error(s.rotation) <= 2e-15);
      CHECK(std::abs(residual(p, s.rotation) - s.residual()) <= 4.0 * eps);
      CHECK(s.converged() == (s.residual() <= 1e-13));
      CHECK((solved_by(s.rotation, p.d, p.w).c - p.c).norm() <=
            (solved_by(start, p.d, p.w).c - p.c).norm() + 4.0 * eps);
      reached += s.converged() ? 1 : 0;
      CHECK(apart(polish_rotation(p, start, 1).rotation, start) <= 0.5);
    }
    CHECK(reached > 2200);  // the rest stop at local minima of |f|
  }

  TEST_CASE("double roots: the residual reaches rounding, from near the root and from a singular J") {
    Random random(325);
    int missed = 0;
    for (int n = 0; n < 4000; ++n) {
      const Mat3 q = random.rotation();
      const Triple d = random_directions(random);
      Vec3 axis;
      const RotationProblem p = solved_by(q, d, with_double_root(random, q, d, random_directions(random), axis));
      const auto s = polish_rotation(p, turned_by(random.log_uniform(1e-6, 1e-2) * random.unit(), q));
      missed += s.residual() <= 64.0 * eps ? 0 : 1;
      // J is singular at q; the solutions of this problem are elsewhere.
      RotationProblem moved = p;
      moved.c += 1e-4 * random.unit();
      const auto other = polish_rotation(moved, q);
      CHECK(orthogonality_error(other.rotation) <= 2e-15);
      CHECK((solved_by(other.rotation, moved.d, moved.w).c - moved.c).norm() <= 1e-4 + 4.0 * eps);
    }
    CHECK(missed <= 4);  // nearly triple roots, from distant starts
  }

  TEST_CASE("all three legs through O: J = 0 at a root of multiplicity eight") {
    Random random(326);
    for (int n = 0; n < 300; ++n) {
      const Mat3 q = random.rotation();
      const Triple d = random_directions(random);
      RotationProblem p = solved_by(q, d, turned(q.transpose(), d));
      p.c.setOnes();
      const auto s = polish_rotation(p, turned_by(1e-2 * random.unit(), q));
      CHECK(s.converged());
      CHECK(apart(s.rotation, q) <= 1e-6);
      CHECK(polish_rotation(p, q).converged());  // J = 0 at the start, already a solution
    }
  }

  TEST_CASE("no solution: not converged from any start; no steps: the start; NaN: not converged") {
    Random random(327);
    for (int n = 0; n < 100; ++n) {
      const Mat3 start = random.rotation();
      RotationProblem p = solved_by(random.rotation(), random_directions(random), random_directions(random));
      CHECK(apart(polish_rotation(p, start, 0).rotation, start) <= 4.0 * eps);
      p.c[1] = 1.01;  // more than the product of two unit vectors
      const auto s = polish_rotation(p, start);
      CHECK((!s.converged() && s.residual() >= 0.001));
      CHECK(orthogonality_error(s.rotation) <= 2e-15);
      p.c[1] = not_a_number;
      CHECK(!polish_rotation(p, start).converged());
      p.c[1] = 0.0;
      CHECK(!polish_rotation(p, Mat3::Constant(not_a_number)).converged());
    }
  }
}
