#pragma once
/// Second-order kinematics: the time derivatives of eqs. (24)-(26), and of J'.

#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Acceleration of the platform and of O: rad/time^2 and length/time^2, base frame. pddot is that of the platform origin.
struct Acceleration {
  Vec3 alpha, pddot, sddot;
};

/// Leg rates and leg accelerations -> acceleration. It depends on the leg rates, since a leg that turns is accelerated
/// though its length changes evenly. NaN in whatever the legs do not determine at a singular configuration, as in
/// forward_velocity.
Acceleration forward_acceleration(const Geometry& g, const Configuration& c, const Vec9& leg_rates,
                                  const Vec9& leg_accelerations);

/// Velocity and acceleration -> leg accelerations. Always defined, but for a leg of zero length: NaN for that leg alone.
/// (Its rate is given as 0; about its second derivative nothing can be said, for the length has a kink there.)
Vec9 inverse_acceleration(const Geometry& g, const Configuration& c, const Velocity& v, const Acceleration& a);

/// d/dt J' along the motion, 6x9, in closed form: with it tdot = J' uddot + Jdot' udot for t = [l_c omega; pdot].
/// Every entry is NaN where J' does not exist. Throws InvalidArgument unless the characteristic length is finite and positive.
Mat69 jacobian_rate(const Geometry& g, const Configuration& c, const Velocity& v, double characteristic_length = 1.0);

}  // namespace ninedof
