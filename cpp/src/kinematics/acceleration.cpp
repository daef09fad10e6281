#include "ninedof/kinematics/acceleration.hpp"

#include <Eigen/Geometry>

#include "kinematics/closure.hpp"
#include "kinematics/jacobian_blocks.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "ninedof/math/rotation.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

using Solution = ClosureSolver::Solution;

/// Right sides for z_i.sddot and y_i.k from the second derivatives of z_i.z_i = r_i^2 and y_i.y_i = q_i^2. With
/// ydot_i = h + omega x y_i the terms quadratic in omega x y_i cancel against the centripetal part of yddot_i, and
///     z_i.sddot = r rddot + rdot^2 - sdot.sdot,    y_i.k = q qddot + qdot^2 - h.h - 2 h.(omega x y_i).
EIGEN_ALWAYS_INLINE Lanes internal_side(const Closure& legs, const Solution& v, const Lanes& rates,
                                        const Lanes& accelerations, std::size_t i) {
  const Xyz<Lanes>& leg = legs.internal[i];
  const Xyz<double> y = lane(leg, 1);
  const Lanes speed_squared(dot(v.o, v.o), dot(v.slip, v.slip + 2.0 * cross(v.angular, y)));
  return legs.internal_length[i] * accelerations + rates * rates - speed_squared;
}

/// Right side for n_i.alpha + x_i.a_O from the second derivative of x_i.x_i = l_i^2, with xdot_i = v_O + omega x w_i:
///     l lddot + ldot^2 - xdot.xdot - x_i.(omega x (omega x w_i))
EIGEN_ALWAYS_INLINE double external_side(const Closure& legs, const Solution& v, double rate, double acceleration,
                                         std::size_t i) {
  const Xyz<double> turning = cross(v.angular, legs.w[i]);
  const Xyz<double> moving = v.at_o + turning;
  return legs.length[i] * acceleration + rate * rate - dot(moving, moving) - dot(legs.x[i], cross(v.angular, turning));
}

}  // namespace

Acceleration forward_acceleration(const Geometry& g, const Configuration& c, const Vec9& leg_rates,
                                  const Vec9& leg_accelerations) {
  const ClosureSolver solver(g, c);
  const Closure& legs = solver.legs;
  const Solution v = solver.velocity(leg_rates);
  const auto internal = [&](std::size_t i) {
    return internal_side(legs, v, ClosureSolver::lower_upper(leg_rates, i),
                         ClosureSolver::lower_upper(leg_accelerations, i), i);
  };
  const auto external = [&](std::size_t i) {
    const auto k = static_cast<Eigen::Index>(i);
    return external_side(legs, v, leg_rates[k], leg_accelerations[k], i);
  };
  const Solution a = solver.solve({internal(0), internal(1), internal(2)}, {external(0), external(1), external(2)});
  // a_O = pddot + alpha x y + omega x (omega x y)
  const Xyz<double> pddot = a.at_o + cross(legs.y, a.angular) + cross(v.angular, cross(legs.y, v.angular));
  return {vec3(a.angular), vec3(pddot), vec3(a.o)};
}

Vec9 inverse_acceleration(const Geometry& g, const Configuration& c, const Velocity& v, const Acceleration& a) {
  const Legs k = legs(g, c);
  // A leg x = l e has lddot = e.xddot + |e x xdot|^2 / l, the last term from its turning; 0/0 at zero length.
  const auto stretch = [](const Vec3& e, double length, const Vec3& rate, const Vec3& acceleration) {
    return e.dot(acceleration) + e.cross(rate).squaredNorm() / length;
  };
  Vec9 accelerations;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Vec3 joint = v.pdot + v.omega.cross(k.u[i]), joint_tilde = v.pdot + v.omega.cross(k.u_tilde[i]);
    const auto joint_acceleration = [&](const Vec3& u) {
      return Vec3(a.pddot + a.alpha.cross(u) + v.omega.cross(v.omega.cross(u)));
    };
    accelerations[row] = stretch(k.e[i], k.l[row], joint, joint_acceleration(k.u[i]));
    accelerations[row + 3] =
        stretch(k.e_tilde[i], k.q[row], v.sdot - joint_tilde, a.sddot - joint_acceleration(k.u_tilde[i]));
    accelerations[row + 6] = stretch(k.e_hat[i], k.r[row], v.sdot, a.sddot);
  }
  return accelerations;
}

Mat69 jacobian_rate(const Geometry& g, const Configuration& c, const Velocity& v, double characteristic_length) {
  require_length("characteristic_length", characteristic_length);
  const ClosureSolver solver(g, c);
  const Closure& legs = solver.legs;
  const ClosureMatrices m(solver);
  const JacobianBlocks j = jacobian_blocks(legs, m);
  const Vec3 y = vec3(legs.y), h = v.sdot - v.pdot - v.omega.cross(y);

  Mat3 X_dot, Y_dot, N0_dot;
  Vec3 ldot, qdot, rdot;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Vec3 x = vec3(legs.x[i]), w = vec3(legs.w[i]);
    const Vec3 z = vec3(lane(legs.internal[i], 0)), y_i = vec3(lane(legs.internal[i], 1));
    const Vec3 wdot = v.omega.cross(w) - h, xdot = wdot + v.sdot, ydot = h + v.omega.cross(y_i);
    X_dot.row(row) = xdot;
    Y_dot.row(row) = ydot;
    N0_dot.row(row) = wdot.cross(x) + w.cross(xdot);
    ldot[row] = x.dot(xdot) / legs.length[i];
    qdot[row] = y_i.dot(ydot) / legs.internal_length[i][1];
    rdot[row] = z.dot(v.sdot) / legs.internal_length[i][0];
  }
  // Derivatives of Z S = diag(r), Y V = diag(q) and N0 W = [diag(l), X V, -X S]. All rows of Zdot are sdot.
  JacobianBlocks d;
  d.S = m.Z_inverse * (Mat3(rdot.asDiagonal()) - v.sdot.transpose().replicate<3, 1>() * j.S);
  d.V = m.Y_inverse * (Mat3(qdot.asDiagonal()) - Y_dot * j.V);
  Mat39 right;
  right << Mat3(ldot.asDiagonal()), X_dot * j.V + m.X * d.V, -(X_dot * j.S) - m.X * d.S;
  d.W = m.N0_inverse * (right - N0_dot * j.W);

  Mat69 rate = assembled(d, y, characteristic_length);
  rate.bottomRows<3>() += skew(v.sdot - v.pdot) * j.W;
  return all_or_nothing(rate);
}

}  // namespace ninedof
