#include "kinematics/closure.hpp"

#include "ninedof/math/xyz.hpp"

namespace ninedof {

void mend_short_vectors(const Geometry& g, const Configuration& c, Closure& k) {
  const Vec3 &p = c.position, &s = c.internal_point;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 upper = exact_leg(s, p, c.rotation, g.platform_internal()[i]);
    const Vec3 lower = lower_leg(c, g.base_internal()[i]);
    k.x[i] = xyz(Vec3(-exact_leg(g.base_external()[i], p, c.rotation, g.platform_external()[i])));
    k.w[i] = xyz(Vec3(-exact_leg(s, p, c.rotation, g.platform_external()[i])));
    k.internal[i] = {Lanes(lower[0], upper[0]), Lanes(lower[1], upper[1]), Lanes(lower[2], upper[2])};
    k.internal_length[i] = Lanes(lower.stableNorm(), upper.stableNorm());
  }
}

}  // namespace ninedof
