#pragma once
/// First-order kinematics, eqs. (24)-(36): F t = G udot with t = [l_c omega; pdot], udot = [ldot; qdot; rdot].
///
/// With a characteristic length l_c the twist must carry l_c omega (eqs. 27 and 29 as printed leave it out).
/// rdot belongs to sdot through B, qdot to sdot - pdot through C.

#include "ninedof/configuration.hpp"
#include "ninedof/geometry.hpp"
#include "ninedof/types.hpp"

namespace ninedof {

/// The matrices of eqs. (30)-(35) by name. Angular columns of A, D, E, F are divided by l_c.
struct VelocityMatrices {
  Mat36 A;  ///< external legs: rows [u_i x e_i / l_c, e_i]  (30)
  Mat3 B;   ///< lower internal unit vectors  (31)
  Mat3 C;   ///< upper internal unit vectors  (32)
  Mat3 D;   ///< rows u~_i x e~_i / l_c  (33)
  Mat36 E;  ///< [D C]  (35b)
  Mat6 F;   ///< [A; E]  (35a)
  Mat69 G;  ///< [1 0 0; 0 -1 C B^-1]  (35a); its last block is NaN where det B = 0
};

/// Throws InvalidArgument unless the characteristic length is finite and positive.
VelocityMatrices velocity_matrices(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// J' = F^-1 G of eq. (36), 6x9, in closed form: three 3x3 inverses, no 6x6 one. Rows (l_c omega, pdot), columns (l, q, r).
/// Every entry is NaN where F or B is exactly singular: the matrix does not exist there.
Mat69 jacobian(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// Velocity of the platform and of O: rad/time and length/time, base frame.
struct Velocity {
  Vec3 omega, pdot, sdot;
};

/// Leg rates -> velocity. NaN in whatever the leg rates do not determine at a singular configuration.
Velocity forward_velocity(const Geometry& g, const Configuration& c, const Vec9& leg_rates);

/// Velocity -> leg rates, eqs. (24)-(26). Always defined, but for a leg of zero length (its rate is given as 0).
Vec9 inverse_velocity(const Geometry& g, const Configuration& c, const Velocity& v);

}  // namespace ninedof
