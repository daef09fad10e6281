#include "workspace/criteria/pairs.hpp"

#include "math/numbers.hpp"
#include "ninedof/robot/points.hpp"

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
  const Points at = points(g, c);
  const auto from = [&](int leg) { return at[static_cast<std::size_t>(leg_ends(leg).from)]; };
  const auto to = [&](int leg) { return at[static_cast<std::size_t>(leg_ends(leg).to)]; };
  Closest out{infinity, -1};
  for (int item = 0; item < leg_pairs; ++item) {
    if (exempt[static_cast<std::size_t>(item)]) continue;
    const auto [one, two] = leg_pair(item);
    const double distance = nearest(from(one), to(one), from(two), to(two)).apart.norm();
    if (distance < out.distance) out = {distance, item};
  }
  return out;
}

}  // namespace ninedof
