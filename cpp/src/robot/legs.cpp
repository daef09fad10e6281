#include "ninedof/robot/legs.hpp"

#include "robot/leg_vectors.hpp"

namespace ninedof {
namespace {

/// Returns the length of `leg` and sets its direction (zero for a leg of zero length).
double split(const Vec3& leg, Vec3& direction) {
  const double length = leg.norm();
  if (length == 0.0) direction.setZero();
  else direction = leg / length;
  return length;
}

}  // namespace

Legs legs(const Geometry& g, const Configuration& c) {
  Legs out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out.u[i] = c.rotation * g.platform_external()[i];
    out.u_tilde[i] = c.rotation * g.platform_internal()[i];
    out.l[k] = split(external_leg(c, out.u[i], g.base_external()[i]), out.e[i]);
    out.q[k] = split(upper_leg(c, out.u_tilde[i]), out.e_tilde[i]);
    out.r[k] = split(lower_leg(c, g.base_internal()[i]), out.e_hat[i]);
  }
  return out;
}

Vec9 leg_lengths(const Geometry& g, const Configuration& c) {
  Vec9 out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out[k] = external_leg(c, c.rotation * g.platform_external()[i], g.base_external()[i]).norm();
    out[k + 3] = upper_leg(c, c.rotation * g.platform_internal()[i]).norm();
    out[k + 6] = lower_leg(c, g.base_internal()[i]).norm();
  }
  return out;
}

}  // namespace ninedof
