#pragma once
/// J' in blocks of three columns, as eqs. (28) and (36) build it: for itself and for its time derivative.

#include "kinematics/closure.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

/// sdot = S rdot,  h = T qdot,  omega = W udot,  where h = sdot - v_O is the velocity of O against the platform.
struct JacobianBlocks {
  Mat3 S, T;
  Mat39 W;
};

/// Rows x_i, and the inverses of the matrices with rows z_i, y_i, n_i. NaN where one is singular.
struct ClosureMatrices {
  explicit ClosureMatrices(const ClosureSolver& solver);
  Mat3 X, Z_inverse, Y_inverse, N_inverse;
};

/// S = Z^-1 R,  T = Y^-1 Q,  W = N^-1 [L, X T, -X S], with the lengths in the diagonal matrices L, Q, R.
JacobianBlocks jacobian_blocks(const Closure& legs, const ClosureMatrices& m);

/// [l_c W; [0, -T, S] + y x W], since the twist is (l_c omega, pdot) with pdot = sdot - h + y x omega.
Mat69 assembled(const JacobianBlocks& blocks, const Vec3& y, double characteristic_length);

/// NaN throughout unless every entry is finite: a matrix of which a part does not exist is none.
Mat69 all_or_nothing(const Mat69& m);

}  // namespace ninedof
