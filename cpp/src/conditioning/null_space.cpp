#include "conditioning/null_space.hpp"

#include <cmath>

namespace ninedof {
namespace {

/// Three columns of the full Householder Q of [C; B], from `first` on, as rows.
Mat36 rows_of_basis(const Mat3& c, const Mat3& b, Eigen::Index first) {
  Eigen::Matrix<double, 6, 3> a;
  a << c, b;
  Eigen::Matrix<double, 6, 3> reflectors = Eigen::Matrix<double, 6, 3>::Zero();
  Vec3 beta = Vec3::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) {
    Vec6 v = a.col(k);
    v.head(k).setZero();
    const double squared = v.squaredNorm();
    if (squared < 1e-290) continue;  // zero to rounding; smaller squares would underflow
    v[k] += std::copysign(std::sqrt(squared), v[k]);
    const double scale = 2.0 / v.squaredNorm();
    for (Eigen::Index j = k + 1; j < 3; ++j) a.col(j) -= (scale * v.dot(a.col(j))) * v;
    reflectors.col(k) = v;
    beta[k] = scale;
  }
  Mat36 basis;
  for (Eigen::Index j = 0; j < 3; ++j) {
    Vec6 column = Vec6::Unit(first + j);
    for (Eigen::Index k = 2; k >= 0; --k) column -= (beta[k] * reflectors.col(k).dot(column)) * reflectors.col(k);
    basis.row(j) = column;
  }
  return basis;
}

}  // namespace

Mat36 null_space(const Mat3& c, const Mat3& b) {
  return rows_of_basis(c, b, 3);
}

Mat36 range_space(const Mat3& c, const Mat3& b) {
  return rows_of_basis(c, b, 0);
}

}  // namespace ninedof
