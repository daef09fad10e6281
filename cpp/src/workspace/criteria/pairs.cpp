#include "workspace/criteria/pairs.hpp"

#include "math/numbers.hpp"

namespace ninedof {

std::array<bool, leg_pairs> pairs_sharing_a_joint(const Geometry& g) {
  const Points at = points(g, {Vec3::Zero(), Mat3::Identity(), Vec3::Zero()});  // joints in the frames of their bodies
  std::array<bool, leg_pairs> out{};
  for (int pair = 0; pair < leg_pairs; ++pair) out[at_index(pair)] = share_joint(std::span(at).first<12>(), pair);
  return out;
}

Closest closest_legs(const Points& at, const std::array<bool, leg_pairs>& exempt) {
  Closest out{infinity, -1};
  for (int pair = 0; pair < leg_pairs; ++pair) {
    if (exempt[at_index(pair)]) continue;
    const double distance = nearest(at, pair).apart.norm();
    if (distance < out.distance) out = {distance, pair};
  }
  return out;
}

}  // namespace ninedof
