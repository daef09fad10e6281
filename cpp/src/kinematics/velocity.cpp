#include "ninedof/kinematics/velocity.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "kinematics/closure.hpp"
#include "kinematics/jacobian_blocks.hpp"
#include "math/linear/least_squares.hpp"
#include "math/numbers.hpp"
#include "math/rows_of.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

Mat3 row_cross(const Triple& a, const Triple& b) {
  return rows_of({a[0].cross(b[0]), a[1].cross(b[1]), a[2].cross(b[2])});
}

/// All NaN where the matrix is exactly singular.
Mat3 inverse_or_nan(const Mat3& m) {
  const Mat3 inverse = m.inverse();
  return inverse.allFinite() ? inverse : Mat3::Constant(not_a_number);
}

}  // namespace

VelocityMatrices velocity_matrices(const Geometry& g, const Configuration& c, double characteristic_length) {
  require_length("characteristic_length", characteristic_length);
  const Legs k = legs(g, c);
  VelocityMatrices v;
  v.A << row_cross(k.u, k.e) / characteristic_length, rows_of(k.e);
  v.B = rows_of(k.e_hat);
  v.C = rows_of(k.e_tilde);
  v.D = row_cross(k.u_tilde, k.e_tilde) / characteristic_length;
  v.E << v.D, v.C;
  v.F << v.A, v.E;
  v.G.setZero();
  v.G.topLeftCorner<3, 3>().setIdentity();
  v.G.block<3, 3>(3, 3) = -Mat3::Identity();
  v.G.block<3, 3>(3, 6) = v.C * inverse_or_nan(v.B);
  return v;
}

Mat69 jacobian(const Geometry& g, const Configuration& c, double characteristic_length) {
  require_length("characteristic_length", characteristic_length);
  const ClosureSolver solver(g, c);
  const JacobianBlocks blocks = jacobian_blocks(solver.legs, ClosureMatrices(solver));
  return all_or_nothing(assembled(blocks, vec3(solver.legs.y), characteristic_length));
}

Velocity forward_velocity(const Geometry& g, const Configuration& c, const Vec9& leg_rates) {
  const ClosureSolver solver(g, c);
  const ClosureSolver::Solution v = solver.velocity(leg_rates);
  return {vec3(v.angular), vec3(v.at_o + cross(solver.legs.y, v.angular)), vec3(v.o)};
}

Vec9 inverse_velocity(const Geometry& g, const Configuration& c, const Velocity& v) {
  const Legs k = legs(g, c);
  Vec9 rates;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    rates[row] = k.e[i].dot(v.pdot + v.omega.cross(k.u[i]));                          // (24)
    rates[row + 3] = k.e_tilde[i].dot(v.sdot - v.pdot - v.omega.cross(k.u_tilde[i]));  // (26)
    rates[row + 6] = k.e_hat[i].dot(v.sdot);                                           // (25)
  }
  return rates;
}

Mat93 null_motion(const Geometry& g, const Configuration& c) {
  const Legs k = legs(g, c);
  Mat93 rates;
  rates << Mat3::Zero(), rows_of(k.e_tilde), rows_of(k.e_hat);
  return rates;
}

Vec3 internal_velocity(const Geometry& g, const Configuration& c, const Vec3& omega, const Vec3& pdot,
                       const Vec9& weights) {
  for (const double weight : weights) require_positive("weights", weight);
  const Legs k = legs(g, c);
  // Least squares: the six internal rates [C; B] sdot - [E t; 0], each times the root of its weight. Rows are sorted by
  // weight, the largest first: then every row stays accurate relative to its size, however different the weights are.
  std::array<Eigen::Index, 6> order{3, 4, 5, 6, 7, 8};
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return weights[a] != weights[b] ? weights[a] > weights[b] : a < b; });
  Eigen::Matrix<double, 6, 3> rows;
  Vec6 wanted;
  for (Eigen::Index row = 0; row < 6; ++row) {
    const Eigen::Index leg = order[at_index(row)];
    const auto i = at_index(leg % 3);
    const double root = std::sqrt(weights[leg] / weights[order[0]]);
    const bool upper = leg < 6;
    rows.row(row) = root * (upper ? k.e_tilde : k.e_hat)[i];
    wanted[row] = upper ? rows.row(row).dot(pdot + omega.cross(k.u_tilde[i])) : 0.0;
  }
  if (!rows.allFinite() || !wanted.allFinite()) return Vec3::Constant(not_a_number);
  return least_norm(rows, wanted);
}

}  // namespace ninedof
