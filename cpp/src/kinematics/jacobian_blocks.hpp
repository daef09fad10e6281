#pragma once
/// J' in blocks of three columns (eqs. 28 and 36), for J' itself and for its time derivative (docs/theory/velocity.md).

#include "kinematics/closure.hpp"
#include "ninedof/math/types.hpp"

namespace ninedof {

/// sdot = S rdot,  h = V qdot,  omega = W udot,  where h = sdot - v_O is the velocity of O relative to the platform.
struct JacobianBlocks {
  Mat3 S, V;
  Mat39 W;
};

/// X with rows x_i, and the inverses of Z, Y and N0 with rows z_i, y_i and n_i. NaN where one is singular.
struct ClosureMatrices {
  explicit ClosureMatrices(const ClosureSolver& solver);
  Mat3 X, Z_inverse, Y_inverse, N0_inverse;
};

/// S = Z^-1 diag(r),  V = Y^-1 diag(q),  W = N0^-1 [diag(l), X V, -X S].
JacobianBlocks jacobian_blocks(const Closure& legs, const ClosureMatrices& m);

/// [l_c W; [0, -V, S] + y x W], since the twist is (l_c omega, pdot) with pdot = sdot - h + y x omega.
Mat69 assembled(const JacobianBlocks& blocks, const Vec3& y, double characteristic_length);

/// All NaN unless every entry is finite.
Mat69 all_or_nothing(const Mat69& m);

}  // namespace ninedof
