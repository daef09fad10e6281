/// svd6.hpp against Eigen's two-sided Jacobi method (other rotations, other order, in extended precision) and against
/// matrices built from known singular values.

#include "math/linear/svd6.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

#include "support/oracle.hpp"
#include "support/support.hpp"

using namespace ninedof;
using namespace support;

namespace {

oracle::Matrix orthogonal(Random& random) {
  return oracle::left_singular_vectors(oracle::wide(random.matrix<Mat6>()));
}

/// U diag(sigma) V^T in extended precision, rounded once.
Mat6 with_singular_values(Random& random, const Vec6& sigma) {
  const oracle::Matrix u = orthogonal(random) * oracle::Vector(oracle::wide(sigma)).asDiagonal();
  return oracle::rounded(oracle::product(u, orthogonal(random).transpose()));
}

Vec6 by_eigen(const Mat6& m) {
  return oracle::rounded(oracle::singular_values(oracle::wide(m)));
}

/// Largest error as a fraction of the largest singular value.
double error(const Vec6& got, const Vec6& expected) {
  return matrix_error(got, expected);
}

bool descending(const Vec6& sigma) {
  return std::is_sorted(sigma.begin(), sigma.end(), std::greater<>());
}

Vec6 sorted(Vec6 v) {
  std::sort(v.begin(), v.end(), std::greater<>());
  return v;
}

}  // namespace

TEST_SUITE("svd6") {
  TEST_CASE("random matrices") {
    Random random(81);
    double worst = 0.0;
    for (int n = 0; n < 2000; ++n) {
      const Mat6 m = random.matrix<Mat6>();
      const Vec6 sigma = singular_values_6x6(m);
      CHECK(descending(sigma));
      worst = std::max(worst, error(sigma, by_eigen(m)));
    }
    CHECK(worst <= 8.0 * eps);
  }

  TEST_CASE("known singular values: clustered, equal, spread over fifteen decades") {
    Random random(82);
    for (int n = 0; n < 1000; ++n) {
      Vec6 sigma;
      switch (n % 6) {
        case 0: sigma << 1, 1, 1, 1, 1, 1; break;
        case 1: sigma << 2, 2, 2, 1, 1, 1; break;
        case 2: sigma << 3, 2, 2, 1, 1, 0.5; break;  // the pattern of threefold symmetry
        case 3: sigma << 1, 1 - 1e-9, 1 - 2e-9, 1e-9, 1e-9, 1e-10; break;
        case 4: sigma << 1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15; break;
        default: sigma = Vec6::NullaryExpr([&] { return random.log_uniform(1e-8, 1.0); }); break;
      }
      sigma = sorted(sigma);
      const Vec6 got = singular_values_6x6(with_singular_values(random, sigma));
      CAPTURE(n);
      CHECK(error(got, sigma) <= 8.0 * eps);
    }
  }

  TEST_CASE("rank deficient: the missing singular values are rounding") {
    Random random(83);
    for (int n = 0; n < 1000; ++n) {
      const int rank = n % 6;
      Mat6 m = Mat6::Zero();
      if (rank > 0) m = random.matrix<Mat6>().leftCols(rank).lazyProduct(random.matrix<Mat6>().topRows(rank));
      if (n % 4 == 1) m.col(3).setZero();
      if (n % 4 == 2) m.row(2) = m.row(4);
      if (n % 4 == 3) m.col(5) = m.col(0);
      CAPTURE(n);
      const Vec6 got = singular_values_6x6(m), expected = by_eigen(m);
      CHECK((got - expected).cwiseAbs().maxCoeff() <= 8.0 * eps * expected[0]);
    }
  }

  TEST_CASE("identity, zero, permutations, rotations, diagonals: exact or to the last bit") {
    CHECK(singular_values_6x6(Mat6::Zero()) == Vec6::Zero());
    CHECK(singular_values_6x6(Mat6::Identity()) == Vec6::Ones());
    Vec6 d;
    d << -3, 1e-300, 0, 2, 1e300, -1;
    CHECK(error(singular_values_6x6(d.asDiagonal()), sorted(d.cwiseAbs())) <= eps);
    Mat6 swapped = Mat6::Zero();
    for (int k = 0; k < 6; ++k) swapped(k, (5 * k + 2) % 6) = k % 2 == 0 ? 1.0 : -1.0;
    CHECK(singular_values_6x6(swapped) == Vec6::Ones());
    Random random(84);
    for (int n = 0; n < 200; ++n)
      CHECK(error(singular_values_6x6(oracle::rounded(orthogonal(random))), Vec6::Ones()) <= 8.0 * eps);
    CHECK(error(singular_values_6x6(Mat6::Ones()), 6.0 * Vec6::Unit(0)) <= 2.0 * eps);
  }

  TEST_CASE("orders of magnitude: the singular values scale with the matrix from 1e-300 to 1e300") {
    Random random(85);
    for (int n = 0; n < 200; ++n) {
      const Mat6 m = random.matrix<Mat6>();
      const Vec6 one = singular_values_6x6(m);
      for (const double scale : {0x1p-1000, 0x1p-500, 0x1p500, 0x1p1000})
        CHECK(error(singular_values_6x6(scale * m) / scale, one) <= 8.0 * eps);
    }
  }

  TEST_CASE("columns graded from 1e150 to 1e-150: no overflow, no NaN, the large ones correct") {
    Random random(86);
    for (int n = 0; n < 500; ++n) {
      Mat6 m = random.matrix<Mat6>();
      for (int k = 0; k < 6; ++k) {
        const double factor = random.log_uniform(1e-150, 1e150);
        if (n % 2 == 0) m.col(k) *= factor;
        else m.row(k) *= factor;
      }
      CAPTURE(n);
      const Vec6 got = singular_values_6x6(m);
      CHECK(got.allFinite());
      CHECK(got.minCoeff() >= 0.0);
      CHECK(descending(got));
      CHECK(error(got, by_eigen(m)) <= 8.0 * eps);
    }
  }

  TEST_CASE("columns graded over a few decades: small singular values with relative accuracy") {
    // Column scaling does not reduce the accuracy of one-sided rotations; checked against extended precision.
    Random random(87);
    for (int n = 0; n < 500; ++n) {
      Mat6 m = random.matrix<Mat6>();
      if (singular_values_6x6(m)[5] < 0.05) continue;  // conditioned by the scaling alone
      for (int k = 0; k < 6; ++k) m.col(k) *= std::pow(10.0, -2 * k);
      const Vec6 got = singular_values_6x6(m), expected = by_eigen(m);
      for (int k = 0; k < 6; ++k) CHECK(relative_error(got[k], expected[k]) <= 1e-12);
    }
  }

  TEST_CASE("transposition and order of rows and columns do not matter") {
    Random random(88);
    for (int n = 0; n < 200; ++n) {
      const Mat6 m = random.matrix<Mat6>();
      const Vec6 one = singular_values_6x6(m);
      CHECK(error(singular_values_6x6(m.transpose()), one) <= 8.0 * eps);
      CHECK(error(singular_values_6x6(m.rowwise().reverse()), one) <= 8.0 * eps);
      CHECK(error(singular_values_6x6(-m.colwise().reverse()), one) <= 8.0 * eps);
    }
  }

  TEST_CASE("right singular vectors: V orthogonal, A V has orthogonal columns whose lengths are the singular values") {
    Random random(89);
    for (int n = 0; n < 1000; ++n) {
      Mat6 m = random.matrix<Mat6>();
      Vec6 sigma;
      switch (n % 6) {
        case 0: break;
        case 1: m *= 0x1p600; break;
        case 2: sigma << 3, 2, 2, 1, 1, 0.5; break;
        case 3: sigma << 2, 2, 2, 1, 1, 1; break;
        case 4: sigma << 1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15; break;
        default: m.col(2) = m.col(4); break;  // rank deficient
      }
      if (n % 6 > 1 && n % 6 < 5) m = with_singular_values(random, sigma);
      CAPTURE(n);
      const RightSvd<6> svd = right_svd_6x6(m);
      CHECK(descending(svd.sigma));
      CHECK(error(svd.sigma, singular_values_6x6(m)) <= 8.0 * eps);
      CHECK((svd.v.transpose() * svd.v - Mat6::Identity()).cwiseAbs().maxCoeff() <= 16.0 * eps);
      const Mat6 image = m / svd.sigma[0] * svd.v;  // U Sigma
      const Vec6 lengths = svd.sigma / svd.sigma[0];
      CHECK((image.colwise().norm().transpose() - lengths).cwiseAbs().maxCoeff() <= 16.0 * eps);
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < i; ++j)
          CHECK(std::abs(image.col(i).dot(image.col(j))) <= 16.0 * eps * std::max(lengths[i], lengths[j]));
    }
    CHECK(right_svd_6x6(Mat6::Zero()).sigma == Vec6::Zero());
    CHECK(right_svd_6x6(Mat6::Zero()).v == Mat6::Identity());
    Mat6 bad = Mat6::Identity();
    bad(3, 1) = not_a_number;
    CHECK(all_nan(right_svd_6x6(bad).sigma));
    CHECK(all_nan(right_svd_6x6(bad).v));
  }

  TEST_CASE("NaN gives NaN, an infinite entry infinity") {
    for (int k = 0; k < 36; ++k) {
      Mat6 m = Mat6::Identity();
      m(k / 6, k % 6) = not_a_number;
      CHECK(all_nan(singular_values_6x6(m)));
      m(k / 6, k % 6) = -infinity;
      CHECK(singular_values_6x6(m).maxCoeff() == infinity);
      m((k / 6 + 1) % 6, 2) = not_a_number;
      CHECK(all_nan(singular_values_6x6(m)));
    }
  }
}
