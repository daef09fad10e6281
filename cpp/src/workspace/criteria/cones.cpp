#include "workspace/criteria/cones.hpp"

#include <Eigen/Geometry>
#include <cmath>

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
  std::array<Vec3, 6> out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 external = c.position + c.rotation * g_.platform_external()[i] - g_.base_external()[i];
    out[i] = platform_ ? Vec3(-external) : external;
    out[i + 3] = c.internal_point -
                 (platform_ ? Vec3(c.position + c.rotation * g_.platform_internal()[i]) : g_.base_internal()[i]);
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
