#include "workspace/criteria/cones.hpp"

#include "robot/joint_cones.hpp"

namespace ninedof {

Cones::Cones(const ConeLimit& limit, bool platform, const Points& home, const Mat3& rotation)
    : angle_(limit.angle), platform_(platform) {
  if (limit.axis.isZero(0.0)) axis_ = directions(home, rotation);
  else axis_.fill(limit.axis.normalized());
}

std::array<Vec3, 6> Cones::directions(const Points& at, const Mat3& rotation) const {
  std::array<Vec3, 6> out;
  for (int k = 0; k < legs_at_body; ++k) {
    Vec3& d = out[at_index(k)];
    d = leg_from_joint(at, platform_, k);
    if (platform_) d = rotation.transpose() * d;
  }
  return out;
}

std::array<double, 6> Cones::margins(const Points& at, const Mat3& rotation) const {
  const std::array<Vec3, 6> d = directions(at, rotation);
  std::array<double, 6> out;
  for (std::size_t k = 0; k < 6; ++k) out[k] = angle_ - cone_angle(d[k], axis_[k]);
  return out;
}

}  // namespace ninedof
