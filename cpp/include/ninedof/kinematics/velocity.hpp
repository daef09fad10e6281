#pragma once
/// First-order kinematics, eqs. (24)-(36): F t = G udot with t = [l_c omega; pdot], udot = [ldot; qdot; rdot].
///
/// Nine leg rates move six coordinates of the platform and three of O: a given velocity of the platform leaves three
/// free.
///
/// With a characteristic length l_c the twist must contain l_c omega (eqs. 27 and 29 as printed omit l_c).
/// Derivations: docs/theory/velocity.md.

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

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

/// J' = F^-1 G of eq. (36), 6x9, in closed form: three 3x3 inverses and no 6x6 inverse. Rows (l_c omega, pdot), columns
/// (l, q, r). Lengths may range from 1e-100 to 1e100. All entries are NaN where F or B is exactly singular: the matrix
/// does not exist there.
Mat69 jacobian(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

/// Velocity of the platform and of O: rad/time and length/time, base frame.
struct Velocity {
  Vec3 omega, pdot, sdot;
};

/// Leg rates -> velocity. At a singular configuration the components that the leg rates do not determine are NaN.
Velocity forward_velocity(const Geometry& g, const Configuration& c, const Vec9& leg_rates);

/// Velocity -> leg rates, eqs. (24)-(26). Always defined; the rate of a leg of zero length is set to 0.
Vec9 inverse_velocity(const Geometry& g, const Configuration& c, const Velocity& v);

/// The redundancy, 9x3: the leg rates of the three null motions, in which O moves with unit velocity along x, y, z of
/// the base while the platform is at rest. ldot = 0, qdot = C, rdot = B. Of rank 3 unless B and C have a common null
/// direction.
Mat93 null_motion(const Geometry& g, const Configuration& c);

/// The sdot that minimizes the weighted sum of squared leg rates while the platform moves with omega and pdot:
/// (B^T Wr B + C^T Wq C)^-1 C^T Wq C v_O. With all weights one, the leg rates are J'^+ t.
///
/// Computed by orthogonal transformations of [C; B], without normal equations, so that no digits are lost. Finite if
/// only B or only C is singular. If both have a common null direction, the leg rates do not depend on sdot along it,
/// and the shortest sdot is returned. Weights are in the order of the legs. Those of the external legs have no effect,
/// because sdot does not move them; a weight below 1e-30 of the largest has none either. Throws InvalidArgument unless
/// every weight is finite and positive.
Vec3 internal_velocity(const Geometry& g, const Configuration& c, const Vec3& omega, const Vec3& pdot,
                       const Vec9& weights = Vec9::Ones());

}  // namespace ninedof
