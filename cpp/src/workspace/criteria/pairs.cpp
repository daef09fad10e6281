#include "workspace/criteria/pairs.hpp"

#include "math/numbers.hpp"

namespace ninedof {

std::array<bool, leg_pairs> pairs_sharing_a_joint(const Geometry& g) {
  std::array<bool, leg_pairs> out{};
  for (int item = 0; item < leg_pairs; ++item) {
    const auto [one, two] = leg_pair(item);
    const auto a = static_cast<std::size_t>(one), b = static_cast<std::size_t>(two);
    const bool below = two < 3    ? joints_coincide(g.base_external()[a], g.base_external()[b])
                       : two >= 6 ? joints_coincide(g.base_external()[a], g.base_internal()[b - 6])
                                  : false;
    const bool above = two < 3   ? joints_coincide(g.platform_external()[a], g.platform_external()[b])
                       : two < 6 ? joints_coincide(g.platform_external()[a], g.platform_internal()[b - 3])
                                 : false;
    out[static_cast<std::size_t>(item)] = below || above;
  }
  return out;
}

Closest closest_legs(const Geometry& g, const Configuration& c, const std::array<bool, leg_pairs>& exempt) {
  std::array<Vec3, 9> from, to;
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = g.base_external()[i];
    to[i] = c.position + c.rotation * g.platform_external()[i];
    from[i + 3] = c.position + c.rotation * g.platform_internal()[i];
    from[i + 6] = g.base_internal()[i];
    to[i + 3] = to[i + 6] = c.internal_point;
  }
  Closest out{infinity, -1};
  for (int item = 0; item < leg_pairs; ++item) {
    if (exempt[static_cast<std::size_t>(item)]) continue;
    const auto [one, two] = leg_pair(item);
    const auto a = static_cast<std::size_t>(one), b = static_cast<std::size_t>(two);
    const double distance = nearest(from[a], to[a], from[b], to[b]).apart.norm();
    if (distance < out.distance) out = {distance, item};
  }
  return out;
}

}  // namespace ninedof
