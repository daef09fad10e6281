#include "ninedof/conditioning.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "ninedof/error.hpp"
#include "ninedof/legs.hpp"
#include "ninedof/svd6.hpp"

namespace ninedof {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Nq, the part that acts on [C; .], of an orthonormal basis [Nq Nr] of the left null space of the 6x3 matrix [C; B]:
/// the last three columns of its full Householder Q, upper half, transposed.
Mat3 null_space_part(const Triple& c, const Triple& b) {
  Eigen::Matrix<double, 6, 3> a;
  for (Eigen::Index i = 0; i < 3; ++i) {
    a.row(i) = c[static_cast<std::size_t>(i)];
    a.row(i + 3) = b[static_cast<std::size_t>(i)];
  }
  Eigen::Matrix<double, 6, 3> reflectors = Eigen::Matrix<double, 6, 3>::Zero();
  Vec3 beta = Vec3::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) {
    Vec6 v = a.col(k);
    v.head(k).setZero();
    const double squared = v.squaredNorm();
    if (squared < 1e-290) continue;  // nothing left to reflect, and the square of a trace of it would underflow
    v[k] += std::copysign(std::sqrt(squared), v[k]);
    const double scale = 2.0 / v.squaredNorm();
    for (Eigen::Index j = k + 1; j < 3; ++j) a.col(j) -= (scale * v.dot(a.col(j))) * v;
    reflectors.col(k) = v;
    beta[k] = scale;
  }
  Mat3 nq;
  for (Eigen::Index j = 0; j < 3; ++j) {
    Vec6 column = Vec6::Unit(3 + j);
    for (Eigen::Index k = 2; k >= 0; --k) column -= (beta[k] * reflectors.col(k).dot(column)) * reflectors.col(k);
    nq.row(j) = column.head<3>();
  }
  return nq;
}

}  // namespace

Mat6 conditioning_matrix(const Geometry& g, const Configuration& c, double characteristic_length) {
  require_positive("characteristic_length", characteristic_length);
  const double inverse_lc = 1.0 / characteristic_length;
  const Legs k = legs(g, c);
  Mat6 e;  // rows of A, then rows of E
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    e.row(row) << (k.u[i].cross(k.e[i]) * inverse_lc).transpose(), k.e[i].transpose();
    e.row(row + 3) << (k.u_tilde[i].cross(k.e_tilde[i]) * inverse_lc).transpose(), k.e_tilde[i].transpose();
  }
  Mat6 m;
  m.topRows<3>() = e.topRows<3>();
  m.bottomRows<3>().noalias() = null_space_part(k.e_tilde, k.e_hat).lazyProduct(e.bottomRows<3>());
  return m;
}

namespace {

/// Below this fraction of the largest, a singular value of M is rounding: double precision cannot tell the configuration
/// from a singular one, and it is called singular.
constexpr double negligible = 16.0 * std::numeric_limits<double>::epsilon();

/// Singular values of M, descending, negligible ones set to zero.
Vec6 inverse_singular_values(const Geometry& g, const Configuration& c, double characteristic_length) {
  Vec6 sigma = singular_values_6x6(conditioning_matrix(g, c, characteristic_length));
  for (Eigen::Index k = 0; k < 6; ++k)
    if (sigma[k] <= negligible * sigma[0]) sigma[k] = 0.0;
  return sigma;
}

}  // namespace

Vec6 singular_values(const Geometry& g, const Configuration& c, double characteristic_length) {
  return inverse_singular_values(g, c, characteristic_length).cwiseInverse().reverse();
}

double condition_number(const Geometry& g, const Configuration& c, double characteristic_length, Norm norm) {
  const Vec6 sigma = inverse_singular_values(g, c, characteristic_length);
  if (sigma.hasNaN()) return std::numeric_limits<double>::quiet_NaN();
  if (sigma[5] == 0.0) return infinity;
  return norm == Norm::two ? sigma[0] / sigma[5] : sigma.norm() * sigma.cwiseInverse().norm();
}

double reciprocal_condition_number(const Geometry& g, const Configuration& c, double characteristic_length, Norm norm) {
  return 1.0 / condition_number(g, c, characteristic_length, norm);
}

double manipulability(const Geometry& g, const Configuration& c, double characteristic_length) {
  return singular_values(g, c, characteristic_length).prod();
}

double isotropy_residual(const Geometry& g, const Configuration& c, double characteristic_length) {
  const Vec6 sigma = singular_values(g, c, characteristic_length);
  if (sigma.hasNaN()) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(sigma[0])) return infinity;
  const Vec6 lambda = (sigma / sigma[0]).cwiseAbs2();  // eigenvalues of J' J'^T, the largest scaled to 1
  const double mean = lambda.mean();
  return (lambda.array() - mean).matrix().norm() / (mean * std::sqrt(6.0));
}

}  // namespace ninedof
