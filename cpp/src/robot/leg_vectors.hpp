#pragma once
/// The nine legs as vectors: where p + Q u - r is formed for numbers of type double.
///
/// The closed form on the axis (conditioning/symmetric.hpp) and the batch kernels (batch/kernels/poses.hpp) form the same
/// vectors over their own number types. points.hpp starts from the joints as points in the base frame, with respect to
/// which it differentiates: s - (p + Q u~) there and (s - p) - Q u~ here differ by rounding.

#include "ninedof/math/types.hpp"
#include "ninedof/robot/configuration.hpp"
#include "ninedof/robot/geometry.hpp"

namespace ninedof {

struct LegVectors {
  Vec3 y;             ///< s - p: O seen from p
  Triple u, u_tilde;  ///< Q u_i and Q u~_i
  Triple external;    ///< p + Q u_i - r_i   (11)
  Triple lower;       ///< s - r^_i          (12)
  Triple upper;       ///< s - p - Q u~_i    (13)
};

EIGEN_ALWAYS_INLINE LegVectors leg_vectors(const Geometry& g, const Configuration& c) {
  LegVectors v;
  v.y = c.internal_point - c.position;
  for (std::size_t i = 0; i < 3; ++i) {
    v.u[i] = c.rotation * g.platform_external()[i];
    v.u_tilde[i] = c.rotation * g.platform_internal()[i];
    v.external[i] = c.position + v.u[i] - g.base_external()[i];
    v.lower[i] = c.internal_point - g.base_internal()[i];
    v.upper[i] = v.y - v.u_tilde[i];
  }
  return v;
}

}  // namespace ninedof
