/// jacobi_svd.hpp by what defines a singular value decomposition, at scales from 1e-200 to 1e200 and without rank.

#include "math/linear/jacobi_svd.hpp"

#include <doctest/doctest.h>

#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

using Eigen::MatrixXd;

/// One of eight kinds: general, without full rank, with equal or tiny columns, zero, or an identity.
MatrixXd sample(Random& random, Eigen::Index rows, Eigen::Index columns, int kind) {
  MatrixXd a = MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
  if (kind == 1) a.col(1) = a.col(0);
  if (kind == 2) a.setZero();
  if (kind == 3) a.setIdentity();
  if (kind == 4) a.col(0) *= 1e-300;
  if (kind == 5) a *= 1e200;
  if (kind == 6) a *= 1e-200;
  if (kind == 7) a.col(2) = a.col(1) + 1e-17 * a.col(0);
  return a;
}

double largest(const MatrixXd& a) {
  return a.cwiseAbs().maxCoeff();
}

/// a diag(b) c.
MatrixXd product(const MatrixXd& a, const Eigen::VectorXd& b, const MatrixXd& c) {
  return (a * b.asDiagonal()).lazyProduct(c);
}

MatrixXd squares_of(const MatrixXd& a) {
  return product(a.transpose(), Eigen::VectorXd::Ones(a.rows()), a);
}

void check_order_and_basis(const Eigen::VectorXd& sigma, const MatrixXd& v) {
  for (Eigen::Index k = 1; k < sigma.size(); ++k) CHECK(sigma[k] <= sigma[k - 1]);
  CHECK(sigma[sigma.size() - 1] >= 0.0);
  CHECK(largest(squares_of(v) - MatrixXd::Identity(sigma.size(), sigma.size())) < 50.0 * eps);
}

template <int N>
void check_square(Random& random, int kind) {
  const MatrixXd a = sample(random, N, N, kind);
  const Svd<N> s = jacobi_svd(Eigen::Matrix<double, N, N>(a));
  check_order_and_basis(s.sigma, s.v);
  check_order_and_basis(s.sigma, s.u);
  CHECK(largest(product(s.u, s.sigma, s.v.transpose()) - a) <= 40.0 * eps * largest(a));
  const Eigen::Index missing = kind == 2 ? N : kind == 1 || kind == 7 || kind == 4 ? 1 : 0;
  CHECK(s.rank(1e-14) == N - missing);
}

/// The columns of A V are orthogonal, and as long as the singular values.
void check_right(const MatrixXd& a, const Eigen::VectorXd& sigma, const MatrixXd& v) {
  check_order_and_basis(sigma, v);
  const double scale = largest(a) == 0.0 ? 1.0 : largest(a);
  const MatrixXd turned = product(a / scale, Eigen::VectorXd::Ones(a.cols()), v);
  const MatrixXd squares = (sigma / scale).cwiseAbs2().asDiagonal();
  CHECK(largest(squares_of(turned) - squares) < 2e3 * eps);
}

template <int Rows, int N>
void check_right(Random& random, int kind) {
  const MatrixXd a = sample(random, Rows, N, kind);
  const RightSvd<N> s = jacobi_right_svd(Eigen::Matrix<double, Rows, N>(a));
  check_right(a, s.sigma, s.v);
}

}  // namespace

TEST_SUITE("jacobi_svd") {
  TEST_CASE("square: U S V^T is the matrix, U and V are orthogonal, the rank is right") {
    Random random(61);
    for (int k = 0; k < 400; ++k) {
      CAPTURE(k);
      check_square<3>(random, k % 8);
      check_square<9>(random, k % 8);
    }
  }

  TEST_CASE("right singular vectors of square and tall matrices") {
    Random random(62);
    for (int k = 0; k < 400; ++k) {
      CAPTURE(k);
      check_right<6, 6>(random, k % 8);
      check_right<27, 9>(random, k % 8);
      check_right<9, 3>(random, k % 8);
    }
  }

  TEST_CASE("an entry that is not finite makes everything NaN") {
    for (const double value : {not_a_number, infinity}) {
      Mat3 a = Mat3::Identity();
      a(1, 2) = value;
      CHECK(all_nan(jacobi_svd(a).sigma));
      CHECK(all_nan(jacobi_svd(a).u));
      Mat93 b = Mat93::Ones();
      b(4, 0) = value;
      CHECK(all_nan(jacobi_right_svd(b).v));
    }
  }

  TEST_CASE("nearest_orthogonal: the rotation of a stretched matrix, and orthogonal for any other") {
    Random random(63);
    for (int k = 0; k < 100; ++k) {
      const Mat3 rotation = random.rotation(), stretch = random.matrix<Mat3>();
      const Mat3 found = nearest_orthogonal(rotation * (stretch.transpose() * stretch + Mat3::Identity()));
      CHECK(largest(found - rotation) < 1e-13);
    }
    CHECK(nearest_orthogonal(Eigen::MatrixXd::Zero(4, 4)).isIdentity());
  }
}
