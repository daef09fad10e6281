#pragma once
/// Second-order kinematics: the time derivatives of eqs. (24)-(26) and of J' (docs/theory/velocity.md).

#include "ninedof/kinematics/velocity.hpp"
#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// Acceleration of the platform and of O: rad/time^2 and length/time^2, base frame. pddot is that of the platform
/// origin.
struct Acceleration {
  Vec3 alpha, pddot, sddot;
};

/// Leg rates and leg accelerations -> acceleration. It depends on the leg rates, because a leg that rotates contributes
/// a centripetal acceleration even if its rate is constant. At a singular configuration the components that the legs do
/// not determine are NaN, as in forward_velocity.
Acceleration forward_acceleration(const Geometry& g, const Configuration& c, const Vec9& leg_rates,
                                  const Vec9& leg_accelerations);

/// Velocity and acceleration -> leg accelerations. Always defined, except for a leg of zero length: NaN for that leg
/// only. (Its rate is set to 0; its length has a kink there, so that the second derivative does not exist.)
Vec9 inverse_acceleration(const Geometry& g, const Configuration& c, const Velocity& v, const Acceleration& a);

/// d/dt J' along the motion, 6x9, in closed form: tdot = J' uddot + (d/dt J') udot for t = [l_c omega; pdot]. Every
/// entry is NaN where J' does not exist. Throws InvalidArgument unless the characteristic length is finite and
/// positive.
Mat69 jacobian_rate(const Geometry& g, const Configuration& c, const Velocity& v, double characteristic_length = 1.0);

}  // namespace ninedof
