#pragma once
/// The 9x9 matrix from the velocities of platform and O to all nine leg rates.

#include "ninedof/kinematics/velocity.hpp"

namespace ninedof {

/// H, 9x9: udot = H x with x = (l_c omega, pdot, sdot), eqs. (24)-(26).
///
///     [ldot]   [ A   0 ]
///     [qdot] = [-E   C ] x,    det H = -det F det B.
///     [rdot]   [ 0   B ]
///
/// The row of a leg of zero length is zero. Throws InvalidArgument unless the length is finite and positive.
inline Mat9 rate_matrix(const Geometry& g, const Configuration& c, double characteristic_length = 1.0) {
  const VelocityMatrices v = velocity_matrices(g, c, characteristic_length);
  Mat9 h = Mat9::Zero();
  h.block<3, 6>(0, 0) = v.A;
  h.block<3, 6>(3, 0) = -v.E;
  h.block<3, 3>(3, 6) = v.C;
  h.block<3, 3>(6, 6) = v.B;
  return h;
}

}  // namespace ninedof
