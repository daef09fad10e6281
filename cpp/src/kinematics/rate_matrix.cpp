#include "kinematics/rate_matrix.hpp"

#include "ninedof/kinematics/velocity.hpp"

namespace ninedof {

Mat9 rate_matrix(const Geometry& g, const Configuration& c, double characteristic_length) {
  const VelocityMatrices v = velocity_matrices(g, c, characteristic_length);
  Mat9 h = Mat9::Zero();
  h.block<3, 6>(0, 0) = v.A;
  h.block<3, 6>(3, 0) = -v.E;
  h.block<3, 3>(3, 6) = v.C;
  h.block<3, 3>(6, 6) = v.B;
  return h;
}

}  // namespace ninedof
