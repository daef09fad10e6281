#include "workspace/criteria/pairs.hpp"

#include <limits>

namespace ninedof {

std::array<bool, leg_pairs> pairs_sharing_a_joint(const Geometry& g) {
  std::array<Vec3, 12> joint;
  for (std::size_t i = 0; i < 3; ++i) {
    joint[point_r + i] = g.base_external()[i];
    joint[point_r_hat + i] = g.base_internal()[i];
    joint[point_u + i] = g.platform_external()[i];
    joint[point_u_tilde + i] = g.platform_internal()[i];
  }
  std::array<bool, leg_pairs> out{};
  for (int pair = 0; pair < leg_pairs; ++pair) out[static_cast<std::size_t>(pair)] = share_joint(joint, pair);
  return out;
}

Closest closest_legs(const Points& at, const std::array<bool, leg_pairs>& exempt) {
  Closest out{std::numeric_limits<double>::infinity(), -1};
  for (int pair = 0; pair < leg_pairs; ++pair) {
    if (exempt[static_cast<std::size_t>(pair)]) continue;
    const double distance = nearest(at, pair).apart.norm();
    if (distance < out.distance) out = {distance, pair};
  }
  return out;
}

}  // namespace ninedof
