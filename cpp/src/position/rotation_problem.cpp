#include "position/rotation_problem.hpp"

#include <algorithm>
#include <cmath>

#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"

namespace ninedof {

void require_leg_lengths(const Vec9& lengths) {
  for (const double length : lengths)
    if (!(length >= 0.0) || !std::isfinite(length))
      throw InvalidArgument("leg_lengths", format_number(length), "nine finite lengths >= 0");
  for (const double length : lengths) require_coordinate("leg_lengths", length);
  if (lengths.isZero(0.0)) throw InvalidArgument("leg_lengths", "nine zeros", "at least one positive length");
}

ScaledRotationProblem rotation_problem(const Geometry& g, const InternalPoints& at, const Vec3& external_lengths) {
  ScaledRotationProblem p;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Vec3 d = g.base_external()[i] - at.s, w = g.platform_external()[i] - at.o;
    const double d2 = d.squaredNorm(), w2 = w.squaredNorm(), l = external_lengths[k];
    const double dn = p.base_distance[k] = std::sqrt(d2), wn = p.platform_distance[k] = std::sqrt(w2);
    p.unit.d[i] = d / dn;
    p.unit.w[i] = w / wn;
    // (dn - wn)^2 - l^2 as a product: no cancellation if O is close to the line of the leg.
    const double difference = dn - wn;
    const double c = 1.0 + 0.5 * (difference - l) * (difference + l) / (dn * wn);
    p.unit.c[k] = std::abs(c) <= 1.0 + cosine_slack ? std::clamp(c, -1.0, 1.0) : c;
  }
  return p;
}

}  // namespace ninedof
