#include "singularity/three_blocks.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "math/linear/negligible.hpp"
#include "math/rows_of.hpp"
#include "ninedof/robot/legs.hpp"

namespace ninedof {

ThreeBlocks three_blocks(const Geometry& g, const Configuration& c) {
  const Legs k = legs(g, c);
  const Vec3 y = c.internal_point - c.position;
  Triple turning;
  for (std::size_t i = 0; i < 3; ++i) turning[i] = (k.u[i] - y).cross(k.e[i]);
  return {rows_of(k.e_hat), rows_of(k.e_tilde), rows_of(turning)};
}

bool regular(const Mat3& block) {
  if (!block.allFinite()) return false;
  const Vec3 sigma = block.jacobiSvd().singularValues();
  return sigma[2] > negligible * sigma[0];
}

std::array<int, 3> sides(const ThreeBlocks& blocks) {
  const auto side = [](const Mat3& m) { return !regular(m) ? 0 : m.determinant() > 0.0 ? 1 : -1; };
  return {side(blocks.b), side(blocks.c), side(blocks.m)};
}

}  // namespace ninedof
