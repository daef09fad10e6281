#pragma once
/// Velocities and accelerations as a careful person would write them with plain Eigen, straight from the paper: F and B
/// assembled and solved with partial pivoting, or all nine equations as one system. Fixed sizes, no allocation; nothing
/// shared with the library but its structs.

#include <Eigen/Dense>

#include "ninedof/kinematics/acceleration.hpp"

namespace bench::plain {

using Mat9 = Eigen::Matrix<double, 9, 9>;
using ninedof::Acceleration;
using ninedof::Configuration;
using ninedof::Geometry;
using ninedof::Mat3;
using ninedof::Mat6;
using ninedof::Mat69;
using ninedof::Vec3;
using ninedof::Vec6;
using ninedof::Vec9;
using ninedof::Velocity;

/// Leg vectors with their lengths and directions, platform joints in base axes; eqs. (11)-(13).
struct Legs {
  Legs(const Geometry& g, const Configuration& c);
  Mat3 e, e_tilde, e_hat, u, u_tilde;  // columns
  Vec3 l, q, r;
};

inline Legs::Legs(const Geometry& g, const Configuration& c) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto n = static_cast<Eigen::Index>(i);
    u.col(n) = c.rotation * g.platform_external()[i];
    u_tilde.col(n) = c.rotation * g.platform_internal()[i];
    e.col(n) = c.position + u.col(n) - g.base_external()[i];
    e_tilde.col(n) = c.internal_point - c.position - u_tilde.col(n);
    e_hat.col(n) = c.internal_point - g.base_internal()[i];
    l[n] = e.col(n).norm();
    q[n] = e_tilde.col(n).norm();
    r[n] = e_hat.col(n).norm();
    e.col(n) /= l[n];
    e_tilde.col(n) /= q[n];
    e_hat.col(n) /= r[n];
  }
}

/// F and G of eqs. (30)-(35) without the characteristic length, and B.
struct Systems {
  Mat6 f;
  Mat3 b;
};

inline Systems systems(const Legs& k) {
  Systems s;
  for (Eigen::Index n = 0; n < 3; ++n) {
    s.f.row(n) << k.u.col(n).cross(k.e.col(n)).transpose(), k.e.col(n).transpose();
    s.f.row(n + 3) << k.u_tilde.col(n).cross(k.e_tilde.col(n)).transpose(), k.e_tilde.col(n).transpose();
  }
  s.b = k.e_hat.transpose();
  return s;
}

/// The two systems solved for given right sides: sdot from eq. (28), then the twist from F t = [l; C sdot - q].
struct Factors {
  explicit Factors(const Legs& k) : s(systems(k)), f(s.f), b(s.b), c(k.e_tilde.transpose()) {}
  Vec9 solve(const Vec9& right) const {
    const Vec3 internal = b.solve(right.tail<3>());
    Vec6 sides;
    sides << right.head<3>(), c * internal - right.segment<3>(3);
    Vec9 out;
    out << f.solve(sides), internal;
    return out;
  }
  Systems s;
  Eigen::PartialPivLU<Mat6> f;
  Eigen::PartialPivLU<Mat3> b;
  Mat3 c;
};

/// The same as one system: udot = H (omega, pdot, sdot).
inline Mat9 rates(const Legs& k) {
  Mat9 h = Mat9::Zero();
  for (Eigen::Index n = 0; n < 3; ++n) {
    h.row(n).head<6>() << k.u.col(n).cross(k.e.col(n)).transpose(), k.e.col(n).transpose();
    h.row(n + 3) << -k.u_tilde.col(n).cross(k.e_tilde.col(n)).transpose(), -k.e_tilde.col(n).transpose(),
        k.e_tilde.col(n).transpose();
    h.row(n + 6).tail<3>() = k.e_hat.col(n);
  }
  return h;
}
/// Condition number of that matrix: how much of an answer rounding may take.
inline double conditioning(const Geometry& g, const Configuration& c) {
  const Vec9 sigma = Eigen::JacobiSVD<Mat9>(rates(Legs(g, c))).singularValues();
  return sigma[0] / sigma[8];
}

struct NineFactors {
  explicit NineFactors(const Legs& k) : lu(rates(k)) {}
  Vec9 solve(const Vec9& right) const { return lu.solve(right); }
  Eigen::PartialPivLU<Mat9> lu;
};

template <class Solver>
Velocity forward_velocity(const Geometry& g, const Configuration& c, const Vec9& leg_rates) {
  const Vec9 v = Solver(Legs(g, c)).solve(leg_rates);
  return {v.head<3>(), v.segment<3>(3), v.tail<3>()};
}

/// uddot = H (alpha, pddot, sddot) + b, with b from the joints' centripetal accelerations and the turning of the legs.
template <class Solver>
Acceleration forward_acceleration(const Geometry& g, const Configuration& c, const Vec9& leg_rates,
                                  const Vec9& leg_accelerations) {
  const Legs k(g, c);
  const Solver solver(k);
  const Vec9 v = solver.solve(leg_rates);
  const Vec3 omega = v.head<3>(), pdot = v.segment<3>(3), sdot = v.tail<3>();
  const auto turning = [](const Vec3& speed, double rate, double length) {
    return (speed.squaredNorm() - rate * rate) / length;
  };
  Vec9 right = leg_accelerations;
  for (Eigen::Index n = 0; n < 3; ++n) {
    const Vec3 u_dot = omega.cross(k.u.col(n)), u_tilde_dot = omega.cross(k.u_tilde.col(n));
    right[n] -= k.e.col(n).dot(omega.cross(u_dot)) + turning(pdot + u_dot, leg_rates[n], k.l[n]);
    right[n + 3] +=
        k.e_tilde.col(n).dot(omega.cross(u_tilde_dot)) - turning(sdot - pdot - u_tilde_dot, leg_rates[n + 3], k.q[n]);
    right[n + 6] -= turning(sdot, leg_rates[n + 6], k.r[n]);
  }
  const Vec9 a = solver.solve(right);
  return {a.head<3>(), a.segment<3>(3), a.tail<3>()};
}

/// F^-1 (Gdot - Fdot J'), with d/dt(C B^-1) = (Cdot - C B^-1 Bdot) B^-1.
inline Mat69 jacobian_rate(const Geometry& g, const Configuration& c, const Velocity& v, double characteristic_length) {
  const Legs k(g, c);
  const Systems s = systems(k);
  const auto direction_dot = [](const Vec3& e, double length, const Vec3& speed) {
    return Vec3((speed - e.dot(speed) * e) / length);
  };
  Mat6 f_dot;
  Mat3 b_dot, c_dot;
  for (Eigen::Index n = 0; n < 3; ++n) {
    const Vec3 e = k.e.col(n), e_tilde = k.e_tilde.col(n), u = k.u.col(n), u_tilde = k.u_tilde.col(n);
    const Vec3 u_dot = v.omega.cross(u), u_tilde_dot = v.omega.cross(u_tilde);
    const Vec3 e_dot = direction_dot(e, k.l[n], v.pdot + u_dot);
    const Vec3 e_tilde_dot = direction_dot(e_tilde, k.q[n], v.sdot - v.pdot - u_tilde_dot);
    f_dot.row(n) << (u_dot.cross(e) + u.cross(e_dot)).transpose(), e_dot.transpose();
    f_dot.row(n + 3) << (u_tilde_dot.cross(e_tilde) + u_tilde.cross(e_tilde_dot)).transpose(), e_tilde_dot.transpose();
    b_dot.row(n) = direction_dot(k.e_hat.col(n), k.r[n], v.sdot);
    c_dot.row(n) = e_tilde_dot;
  }
  const Mat3 b_inverse = s.b.inverse(), c_b = k.e_tilde.transpose() * b_inverse;
  Mat69 g_matrix = Mat69::Zero(), g_dot = Mat69::Zero();
  g_matrix.block<3, 3>(0, 0).setIdentity();
  g_matrix.block<3, 3>(3, 3) = -Mat3::Identity();
  g_matrix.block<3, 3>(3, 6) = c_b;
  g_dot.block<3, 3>(3, 6) = (c_dot - c_b * b_dot) * b_inverse;
  const Mat6 f_inverse = s.f.inverse();
  const Mat69 j = f_inverse * g_matrix;
  Mat69 out = f_inverse * (g_dot - f_dot * j);
  out.topRows<3>() *= characteristic_length;
  return out;
}

}  // namespace bench::plain
