#include "ninedof/conditioning/conditioning.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "conditioning/null_space.hpp"
#include "math/linear/svd6.hpp"
#include "math/numbers.hpp"
#include "math/rows_of.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {

Mat6 conditioning_matrix(const Geometry& g, const Configuration& c, double characteristic_length) {
  require_length("characteristic_length", characteristic_length);
  const double inverse_lc = 1.0 / characteristic_length;
  const Legs k = legs(g, c);
  Mat6 e;  // rows of A, then rows of E
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    e.row(row) << (k.u[i].cross(k.e[i]) * inverse_lc).transpose(), k.e[i].transpose();
    e.row(row + 3) << (k.u_tilde[i].cross(k.e_tilde[i]) * inverse_lc).transpose(), k.e_tilde[i].transpose();
  }
  return conditioning_rows(e, rows_of(k.e_tilde), rows_of(k.e_hat));
}

namespace {

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
  if (sigma.hasNaN()) return not_a_number;
  if (sigma[5] == 0.0) return infinity;
  return norm == Norm::two ? sigma[0] / sigma[5] : sigma.norm() * sigma.cwiseInverse().norm();
}

double reciprocal_condition_number(const Geometry& g, const Configuration& c, double characteristic_length, Norm norm) {
  return 1.0 / condition_number(g, c, characteristic_length, norm);
}

double manipulability(const Geometry& g, const Configuration& c, double characteristic_length) {
  return manipulability(singular_values(g, c, characteristic_length));
}

double manipulability(const Vec6& singular_values) {
  return singular_values.prod();
}

double isotropy_residual(const Geometry& g, const Configuration& c, double characteristic_length) {
  return isotropy_residual(singular_values(g, c, characteristic_length));
}

double isotropy_residual(const Vec6& sigma) {
  if (sigma.hasNaN()) return not_a_number;
  if (std::isinf(sigma[0])) return infinity;
  const Vec6 lambda = (sigma / sigma[0]).cwiseAbs2();  // eigenvalues of J' J'^T, the largest scaled to 1
  const double mean = lambda.mean();
  return (lambda.array() - mean).matrix().norm() / (mean * std::sqrt(6.0));
}

}  // namespace ninedof
