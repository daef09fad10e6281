#include "workspace/criteria/cones.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "ninedof/robot/points.hpp"

namespace ninedof {

Cones::Cones(const Geometry& g, const ConeLimit& limit, bool platform, const Configuration& home)
    : g_(g), angle_(limit.angle), platform_(platform) {
  if (limit.axis.isZero(0.0)) {
    axis_ = directions(home);
  } else {
    axis_.fill(limit.axis.normalized());
  }
}

std::array<Vec3, 6> Cones::directions(const Configuration& c) const {
  const Points at = points(g_, c);
  std::array<Vec3, 6> out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 external = at[point_u + i] - at[point_r + i];
    out[i] = platform_ ? Vec3(-external) : external;
    out[i + 3] = at[point_s] - at[(platform_ ? point_u_tilde : point_r_hat) + i];
  }
  if (platform_)
    for (Vec3& d : out) d = c.rotation.transpose() * d;
  return out;
}

std::array<double, 6> Cones::margins(const Configuration& c) const {
  const std::array<Vec3, 6> d = directions(c);
  std::array<double, 6> out;
  for (std::size_t k = 0; k < 6; ++k) out[k] = angle_ - std::atan2(d[k].cross(axis_[k]).norm(), d[k].dot(axis_[k]));
  return out;
}

}  // namespace ninedof
