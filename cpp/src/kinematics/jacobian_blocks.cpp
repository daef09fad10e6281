#include "kinematics/jacobian_blocks.hpp"

#include "math/numbers.hpp"
#include "math/rows_of.hpp"
#include "ninedof/math/rotation.hpp"

namespace ninedof {

ClosureMatrices::ClosureMatrices(const ClosureSolver& solver)
    : X(rows_of({vec3(solver.legs.x[0]), vec3(solver.legs.x[1]), vec3(solver.legs.x[2])})),
      Z_inverse(solver.z_inverse()),
      Y_inverse(solver.y_inverse()),
      N0_inverse(solver.n_inverse()) {}

JacobianBlocks jacobian_blocks(const Closure& legs, const ClosureMatrices& m) {
  const auto& rq = legs.internal_length;
  JacobianBlocks b;
  b.S = m.Z_inverse * Vec3(rq[0][0], rq[1][0], rq[2][0]).asDiagonal();
  b.V = m.Y_inverse * Vec3(rq[0][1], rq[1][1], rq[2][1]).asDiagonal();
  const Vec3 l(legs.length[0], legs.length[1], legs.length[2]);
  b.W << m.N0_inverse * l.asDiagonal(), m.N0_inverse * (m.X * b.V), -(m.N0_inverse * (m.X * b.S));
  return b;
}

Mat69 assembled(const JacobianBlocks& blocks, const Vec3& y, double characteristic_length) {
  Mat69 j;
  j.topRows<3>() = characteristic_length * blocks.W;
  j.bottomRows<3>() = skew(y) * blocks.W;
  j.block<3, 3>(3, 3) -= blocks.V;
  j.block<3, 3>(3, 6) += blocks.S;
  return j;
}

Mat69 all_or_nothing(const Mat69& m) {
  return m.allFinite() ? m : Mat69::Constant(not_a_number);
}

}  // namespace ninedof
