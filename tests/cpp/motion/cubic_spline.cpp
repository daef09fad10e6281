/// cubic_spline.hpp against what defines a spline: every piece is a cubic polynomial, recovered here from four of its
/// points, and their values and derivatives meet at the knots.

#include "motion/cubic_spline.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

std::vector<double> uneven(Random& random, int n) {
  std::vector<double> out{random.uniform(-3.0, 3.0)};
  while (static_cast<int>(out.size()) < n) out.push_back(out.back() + random.uniform(0.1, 1.0));
  return out;
}

/// Derivatives of order 0 to 3 (columns) at both ends of a piece.
struct Piece {
  Eigen::Matrix<double, 3, 4> begin, end;
};

Piece piece(const std::vector<double>& x, const std::vector<Vec3>& y, bool periodic, std::size_t k) {
  const double h = x[k + 1] - x[k];
  const Eigen::Vector4d at(0.125, 0.375, 0.625, 0.875);
  std::vector<double> inside;
  for (const double u : at) inside.push_back(x[k] + u * h);
  const std::vector<Vec3> values = cubic_spline(x, y, inside, periodic);
  Eigen::Matrix4d powers;
  Eigen::Matrix<double, 4, 3> right;
  for (Eigen::Index j = 0; j < 4; ++j) {
    powers.row(j) << 1.0, at[j], at[j] * at[j], at[j] * at[j] * at[j];
    right.row(j) = values[static_cast<std::size_t>(j)].transpose();
  }
  const Eigen::Matrix<double, 3, 4> c = powers.lu().solve(right).transpose();
  Piece out;
  out.begin << c.col(0), c.col(1) / h, 2.0 * c.col(2) / (h * h), 6.0 * c.col(3) / (h * h * h);
  out.end << c.rowwise().sum(), (c.col(1) + 2.0 * c.col(2) + 3.0 * c.col(3)) / h,
      (2.0 * c.col(2) + 6.0 * c.col(3)) / (h * h), out.begin.col(3);
  return out;
}

bool meet(const Piece& before, const Piece& after, int orders) {
  const Eigen::Matrix<double, 3, 4> difference = before.end - after.begin;
  const double size = 1.0 + before.end.cwiseAbs().maxCoeff();
  return difference.leftCols(orders).cwiseAbs().maxCoeff() < 1e-9 * size;
}

}  // namespace

TEST_SUITE("cubic_spline") {
  TEST_CASE("pieces meet with two derivatives at every knot and with three where a knot is none") {
    Random random(311);
    for (int n = 0; n < 40; ++n)
      for (const bool periodic : {false, true}) {
        const std::vector<double> x = uneven(random, 4 + n % 9);
        std::vector<Vec3> y;
        for (std::size_t k = 0; k < x.size(); ++k) y.push_back(random.matrix<Vec3>());
        if (periodic) y.back() = y.front();
        std::vector<Piece> pieces;
        for (std::size_t k = 0; k + 1 < x.size(); ++k) {
          pieces.push_back(piece(x, y, periodic, k));
          CHECK((pieces[k].begin.col(0) - y[k]).norm() < 1e-11);
          CHECK((pieces[k].end.col(0) - y[k + 1]).norm() < 1e-11);
        }
        for (std::size_t k = 0; k + 1 < pieces.size(); ++k) CHECK(meet(pieces[k], pieces[k + 1], 3));
        if (periodic) CHECK(meet(pieces.back(), pieces.front(), 3));
        else CHECK((meet(pieces[0], pieces[1], 4) && meet(pieces[pieces.size() - 2], pieces.back(), 4)));
      }
  }

  TEST_CASE("a cubic polynomial is its own spline, beyond the ends too") {
    Random random(312);
    const Vec3 a = random.matrix<Vec3>(), b = random.matrix<Vec3>(), c = random.matrix<Vec3>(),
               d = random.matrix<Vec3>();
    const auto cubic = [&](double t) { return Vec3(a + t * (b + t * (c + t * d))); };
    const std::vector<double> x = uneven(random, 8);
    std::vector<Vec3> y;
    for (const double t : x) y.push_back(cubic(t));
    std::vector<double> at;
    for (int k = 0; k < 50; ++k) at.push_back(random.uniform(x.front() - 0.5, x.back() + 0.5));
    const std::vector<Vec3> found = cubic_spline(x, y, at, false);
    for (std::size_t k = 0; k < at.size(); ++k) CHECK((found[k] - cubic(at[k])).norm() < 1e-10);
  }
}
