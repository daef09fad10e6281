/// least_squares.hpp by what defines its solutions: the residual is orthogonal to the columns, and a solution of least
/// norm to the null space.

#include "math/linear/least_squares.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

Eigen::MatrixXd matrix(Random& random, Eigen::Index rows, Eigen::Index cols, Eigen::Index rank) {
  const auto normal = [&random] { return random.normal(); };
  const Eigen::MatrixXd left = Eigen::MatrixXd::NullaryExpr(rows, rank, normal);
  return left * Eigen::MatrixXd::NullaryExpr(rank, cols, normal);
}

double largest_entry(const Eigen::MatrixXd& a) {
  return a.size() == 0 ? 0.0 : a.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_SUITE("least_squares") {
  TEST_CASE("any shape and rank: normal equations, least norm, and both for the transposed matrix") {
    Random random(71);
    for (Eigen::Index rows = 1; rows <= 12; ++rows)
      for (Eigen::Index cols = 1; cols <= 12; ++cols)
        for (Eigen::Index rank = 1; rank <= std::min(rows, cols); rank += 3) {
          CAPTURE(rows);
          CAPTURE(cols);
          CAPTURE(rank);
          const Eigen::MatrixXd a = matrix(random, rows, cols, rank), known = matrix(random, rows, 1, 1);
          const double tolerance = 1e-10 * (1.0 + largest_entry(a)) * (1.0 + largest_entry(known));
          const Eigen::VectorXd any = least_squares(a, known), least = least_norm(a, known);
          CHECK(largest_entry(a.transpose() * (a * any - known)) < tolerance * (1.0 + largest_entry(any)));
          CHECK(largest_entry(a.transpose() * (a * least - known)) < tolerance * (1.0 + largest_entry(least)));
          // Of least norm: A^T y for some y, so that projecting on the rows changes nothing.
          CHECK(largest_entry(a.transpose() * least_norm_transposed(a, least) - least) <
                1e-9 * (1.0 + largest_entry(least)));
        }
  }

  TEST_CASE("zero matrices: the solution of least norm is zero") {
    const Eigen::VectorXd b = Eigen::VectorXd::Ones(4);
    CHECK(least_norm(Eigen::MatrixXd::Zero(4, 3), b).isZero(0.0));
    CHECK(least_norm(Eigen::Matrix<double, 6, 3>(Eigen::Matrix<double, 6, 3>::Zero()), Vec6(Vec6::Ones())).isZero(0.0));
  }

  TEST_CASE("solve_regular: the solution, or nothing for a matrix without full rank") {
    Random random(72);
    for (int k = 0; k < 100; ++k) {
      Mat9 a = random.matrix<Mat9>();
      const Vec9 x = random.matrix<Vec9>();
      const auto found = solve_regular(a, a * x, 1e-9);
      REQUIRE(found);
      CHECK(largest_entry(*found - x) < 1e-9);
      a.col(4) = a.col(7) - a.col(1);
      CHECK_FALSE(solve_regular(a, x, 1e-9));
    }
  }

  TEST_CASE("eliminate: |X y| is the least of |kept y + free z|, where `free` has lost rank too") {
    Random random(73);
    for (int k = 0; k < 100; ++k) {
      Mat93 free = random.matrix<Mat93>();
      if (k % 3 == 1) free.col(2) = free.col(0);
      if (k % 3 == 2) free.setZero();
      const Eigen::Matrix<double, 9, 6> kept = random.matrix<Eigen::Matrix<double, 9, 6>>();
      const Vec6 y = random.matrix<Vec6>();
      const Vec9 wanted = kept * y;
      const Eigen::VectorXd z = least_norm(Eigen::MatrixXd(free), Eigen::VectorXd(-wanted));
      CHECK((eliminate(free, kept) * y).norm() == doctest::Approx((wanted + free * z).norm()).epsilon(1e-11));
      const Mat6 r = triangular_factor(kept);
      CHECK(largest_entry(r.transpose() * r - kept.transpose() * kept) < 1e-12);
      CHECK(r.isUpperTriangular(0.0));
    }
  }
}
