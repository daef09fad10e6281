#include "ninedof/robot/legs.hpp"

#include "robot/leg_vectors.hpp"

namespace ninedof {
namespace {

/// Returns the length of `leg` and sets its direction (zero for a leg of zero length).
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
