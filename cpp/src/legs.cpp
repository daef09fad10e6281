#include "ninedof/legs.hpp"

namespace ninedof {
namespace {

/// Length of `leg`, and its direction (zero for a leg of zero length).
double split(const Vec3& leg, Vec3& direction) {
  const double length = leg.norm();
  if (length == 0.0) {
    direction.setZero();
  } else {
    direction = leg / length;
  }
  return length;
}

}  // namespace

Legs legs(const Geometry& g, const Configuration& c) {
  Legs out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out.u[i] = c.rotation * g.platform_external()[i];
    out.u_tilde[i] = c.rotation * g.platform_internal()[i];
    out.l[k] = split(c.position + out.u[i] - g.base_external()[i], out.e[i]);                    // (11)
    out.q[k] = split(c.internal_point - c.position - out.u_tilde[i], out.e_tilde[i]);            // (13)
    out.r[k] = split(c.internal_point - g.base_internal()[i], out.e_hat[i]);                     // (12)
  }
  return out;
}

Vec9 leg_lengths(const Geometry& g, const Configuration& c) {
  const Legs k = legs(g, c);
  Vec9 out;
  out << k.l, k.q, k.r;
  return out;
}

}  // namespace ninedof
