#include "internal_point.hpp"

namespace ninedof {

ScaledRotationProblem rotation_problem(const Geometry& g, const InternalPoints& at, const Vec3& external_lengths) {
  ScaledRotationProblem p;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Vec3 d = g.base_external()[i] - at.s, w = g.platform_external()[i] - at.o;
    const double d2 = d.squaredNorm(), w2 = w.squaredNorm(), l = external_lengths[k];
    const double dn = p.base_distance[k] = std::sqrt(d2), wn = p.platform_distance[k] = std::sqrt(w2);
    p.unit.d[i] = d / dn;
    p.unit.w[i] = w / wn;
    // (dn - wn)^2 - l^2 in factors: near a stretched or folded leg nothing cancels.
    const double difference = dn - wn;
    p.unit.c[k] = 1.0 + 0.5 * (difference - l) * (difference + l) / (dn * wn);
  }
  return p;
}

}  // namespace ninedof
