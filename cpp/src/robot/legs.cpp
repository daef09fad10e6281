#include "ninedof/robot/legs.hpp"

namespace ninedof {
namespace {

/// The nine legs as vectors, base frame.
struct LegVectors {
  Triple external, upper, lower;
  Triple u, u_tilde;  // Q u_i and Q u~_i
};

LegVectors leg_vectors(const Geometry& g, const Configuration& c) {
  LegVectors v;
  for (std::size_t i = 0; i < 3; ++i) {
    v.u[i] = c.rotation * g.platform_external()[i];
    v.u_tilde[i] = c.rotation * g.platform_internal()[i];
    v.external[i] = c.position + v.u[i] - g.base_external()[i];            // (11)
    v.upper[i] = c.internal_point - c.position - v.u_tilde[i];             // (13)
    v.lower[i] = c.internal_point - g.base_internal()[i];                  // (12)
  }
  return v;
}

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
  const LegVectors v = leg_vectors(g, c);
  Legs out;
  out.u = v.u;
  out.u_tilde = v.u_tilde;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out.l[k] = split(v.external[i], out.e[i]);
    out.q[k] = split(v.upper[i], out.e_tilde[i]);
    out.r[k] = split(v.lower[i], out.e_hat[i]);
  }
  return out;
}

Vec9 leg_lengths(const Geometry& g, const Configuration& c) {
  const LegVectors v = leg_vectors(g, c);
  Vec9 out;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    out[k] = v.external[i].norm();
    out[k + 3] = v.upper[i].norm();
    out[k + 6] = v.lower[i].norm();
  }
  return out;
}

}  // namespace ninedof
