#pragma once
/// The 9x9 matrix from the velocities of platform and O to all nine leg rates.

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

/// H, 9x9: udot = H x with x = (l_c omega, pdot, sdot), eqs. (24)-(26).
///
///     [ldot]   [ A   0 ]
///     [qdot] = [-E   C ] x,    det H = -det F det B.
///     [rdot]   [ 0   B ]
///
/// The row of a leg of zero length is zero. Throws InvalidArgument unless the length is finite and positive.
Mat9 rate_matrix(const Geometry& g, const Configuration& c, double characteristic_length = 1.0);

}  // namespace ninedof
