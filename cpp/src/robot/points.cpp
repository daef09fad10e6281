#include "ninedof/robot/points.hpp"

namespace ninedof {

NineLegs nine_legs(const Points& at) {
  NineLegs out;
  for (int k = 0; k < 9; ++k) {
    const LegEnds ends = leg_ends(k);
    Vec3& d = out.direction[at_index(k)];
    d = at[at_index(ends.to)] - at[at_index(ends.from)];
    const double length = d.norm();
    out.length[k] = length;
    if (length > 0.0) d /= length;
  }
  return out;
}

Points points(const Geometry& g, const Configuration& c) {
  Points at;
  for (std::size_t i = 0; i < 3; ++i) {
    at[point_r + i] = g.base_external()[i];
    at[point_r_hat + i] = g.base_internal()[i];
    at[point_u + i] = c.position + c.rotation * g.platform_external()[i];
    at[point_u_tilde + i] = c.position + c.rotation * g.platform_internal()[i];
  }
  at[point_p] = c.position;
  at[point_s] = c.internal_point;
  return at;
}

PosedPoints posed_points(const Geometry& g, const Configuration& c) {
  PosedPoints out{points(g, c), {}, c.rotation};
  out.legs = nine_legs(out.at);
  return out;
}

}  // namespace ninedof
