#pragma once
/// What a careful person would write with plain Eigen, straight from the paper: assemble eqs. (30)-(35), invert F, take
/// the singular values of the 6x9 matrix J'. Fixed sizes, no allocation. Shares nothing with the library but its input
/// structs. Velocities and accelerations are in baseline_motion.hpp.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace bench::plain {

using ninedof::Configuration;
using ninedof::Geometry;
using ninedof::Mat3;
using ninedof::Mat6;
using ninedof::Mat69;
using ninedof::Vec6;
using ninedof::Vec9;

/// l1 l2 l3 q1 q2 q3 r1 r2 r3, eqs. (11)-(13).
inline Vec9 leg_lengths(const Geometry& g, const Configuration& c) {
  Vec9 lengths;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    lengths[k] = (c.position + c.rotation * g.platform_external()[i] - g.base_external()[i]).norm();
    lengths[k + 3] = (c.internal_point - c.position - c.rotation * g.platform_internal()[i]).norm();
    lengths[k + 6] = (c.internal_point - g.base_internal()[i]).norm();
  }
  return lengths;
}

/// J' = F^-1 G, eq. (36).
inline Mat69 jacobian(const Geometry& g, const Configuration& c, double characteristic_length) {
  Mat3 b_matrix, c_matrix;
  Mat6 f;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const ninedof::Vec3 u = c.rotation * g.platform_external()[i];
    const ninedof::Vec3 u_tilde = c.rotation * g.platform_internal()[i];
    const ninedof::Vec3 e = (c.position + u - g.base_external()[i]).normalized();
    const ninedof::Vec3 e_tilde = (c.internal_point - c.position - u_tilde).normalized();
    const ninedof::Vec3 e_hat = (c.internal_point - g.base_internal()[i]).normalized();
    f.row(row) << u.cross(e).transpose() / characteristic_length, e.transpose();
    f.row(row + 3) << u_tilde.cross(e_tilde).transpose() / characteristic_length, e_tilde.transpose();
    b_matrix.row(row) = e_hat;
    c_matrix.row(row) = e_tilde;
  }
  Mat69 g_matrix = Mat69::Zero();
  g_matrix.block<3, 3>(0, 0).setIdentity();
  g_matrix.block<3, 3>(3, 3) = -Mat3::Identity();
  g_matrix.block<3, 3>(3, 6) = c_matrix * b_matrix.inverse();
  return f.inverse() * g_matrix;
}

/// Descending.
inline Vec6 singular_values(const Geometry& g, const Configuration& c, double characteristic_length) {
  return Eigen::JacobiSVD<Mat69>(plain::jacobian(g, c, characteristic_length)).singularValues();
}

inline double condition_number(const Geometry& g, const Configuration& c, double characteristic_length) {
  const Vec6 sigma = plain::singular_values(g, c, characteristic_length);
  return sigma[0] / sigma[5];
}

/// The cheaper way that squares the condition number, and with it the rounding: eigenvalues of J' J'^T.
inline double squared_condition_number(const Geometry& g, const Configuration& c, double characteristic_length) {
  const Mat69 j = plain::jacobian(g, c, characteristic_length);
  const Vec6 lambda = Eigen::SelfAdjointEigenSolver<Mat6>(j * j.transpose(), Eigen::EigenvaluesOnly).eigenvalues();
  return std::sqrt(lambda[5] / lambda[0]);
}

/// Central differences of `function` of N variables: 2 N evaluations, and half the digits.
template <std::size_t N, class Function>
std::array<double, N> gradient(const Function& function, const std::array<double, N>& at) {
  std::array<double, N> out, x = at;
  for (std::size_t k = 0; k < N; ++k) {
    const double step = 1e-6 * std::max(1.0, std::abs(at[k]));
    x[k] = at[k] + step;
    const double ahead = function(x);
    x[k] = at[k] - step;
    out[k] = (ahead - function(x)) / (2.0 * step);
    x[k] = at[k];
  }
  return out;
}

}  // namespace bench::plain
