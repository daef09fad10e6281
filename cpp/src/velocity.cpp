#include "ninedof/velocity.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <limits>

#include "ninedof/error.hpp"
#include "ninedof/legs.hpp"
#include "ninedof/rotation.hpp"
#include "rows_of.hpp"

namespace ninedof {
namespace {

Mat3 row_cross(const Triple& a, const Triple& b) {
  return rows_of({a[0].cross(b[0]), a[1].cross(b[1]), a[2].cross(b[2])});
}

/// NaN throughout where m is exactly singular, never a plausible matrix.
Mat3 inverse_or_nan(const Mat3& m) {
  const Mat3 inverse = m.inverse();
  return inverse.allFinite() ? inverse : Mat3::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// What the three 3x3 solves of the forward velocity problem need. With y = s - p and v_O = pdot + omega x y:
/// B sdot = rdot,  C v_O = C sdot - qdot,  M omega = ldot - Ee v_O,  pdot = v_O + y x omega.
struct ForwardSolve {
  Vec3 y;
  Mat3 external;     ///< Ee: rows e_i
  Mat3 m_inverse;    ///< M: rows w_i x e_i, w_i from O to the platform joint
  Mat3 b_inverse, c_inverse;
};

ForwardSolve forward_solve(const Geometry& g, const Configuration& c) {
  const Legs k = legs(g, c);
  ForwardSolve f;
  f.y = c.internal_point - c.position;
  f.external = rows_of(k.e);
  f.m_inverse = inverse_or_nan(row_cross({k.u[0] - f.y, k.u[1] - f.y, k.u[2] - f.y}, k.e));
  f.b_inverse = inverse_or_nan(rows_of(k.e_hat));
  f.c_inverse = inverse_or_nan(rows_of(k.e_tilde));
  return f;
}

}  // namespace

VelocityMatrices velocity_matrices(const Geometry& g, const Configuration& c, double characteristic_length) {
  require_positive("characteristic_length", characteristic_length);
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
  require_positive("characteristic_length", characteristic_length);
  const ForwardSolve f = forward_solve(g, c);
  // omega = W udot with W = M^-1 [1, Ee C^-1, -Ee B^-1];  pdot = [0, -C^-1, B^-1] udot + y x omega.
  Eigen::Matrix<double, 3, 9> w;
  w << f.m_inverse, f.m_inverse * (f.external * f.c_inverse), -(f.m_inverse * (f.external * f.b_inverse));
  Mat69 j;
  j.topRows<3>() = characteristic_length * w;
  j.bottomRows<3>() = skew(f.y) * w;
  j.block<3, 3>(3, 3) -= f.c_inverse;
  j.block<3, 3>(3, 6) += f.b_inverse;
  if (!j.allFinite()) j.setConstant(std::numeric_limits<double>::quiet_NaN());
  return j;
}

Velocity forward_velocity(const Geometry& g, const Configuration& c, const Vec9& leg_rates) {
  const ForwardSolve f = forward_solve(g, c);
  Velocity v;
  v.sdot = f.b_inverse * leg_rates.tail<3>();
  const Vec3 at_o = v.sdot - f.c_inverse * leg_rates.segment<3>(3);
  v.omega = f.m_inverse * (leg_rates.head<3>() - f.external * at_o);
  v.pdot = at_o + f.y.cross(v.omega);
  return v;
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

}  // namespace ninedof
