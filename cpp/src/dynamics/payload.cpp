#include "ninedof/dynamics/payload.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

double share(double per_mass, double room) {
  if (room == infinity) return 0.0;
  return room > 0.0 ? per_mass / room : infinity;
}

}  // namespace

void validate(const PayloadLimits& limits) {
  for (const Vec9* forces : {&limits.push, &limits.pull})
    for (const double force : *forces)
      if (!(force >= 0.0)) throw InvalidArgument("force", format_number(force), "numbers >= 0");
  for (const double x : limits.centre) require_finite("centre", x);
  for (const double x : limits.gravity) require_finite("gravity", x);
}

Vec18 payload_shares(const Geometry& g, const Configuration& c, const PayloadLimits& limits, const Load& without) {
  const Vec3 arm = c.rotation * limits.centre;
  const LegForces own = leg_forces(g, c, without);
  const LegForces per_mass = leg_forces(g, c, {arm.cross(limits.gravity), limits.gravity, Vec3::Zero()});
  if (!own.balanced() || !per_mass.balanced()) return Vec18::Constant(infinity);
  return payload_shares(own.forces, per_mass.forces, limits.push, limits.pull);
}

Vec18 payload_shares(const Vec9& own, const Vec9& per_mass, const Vec9& push, const Vec9& pull) {
  Vec18 out;
  const double rounding = 1e-12 * per_mass.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < 9; ++k) {
    const double by_mass = std::abs(per_mass[k]) > rounding ? per_mass[k] : 0.0;
    out[k] = share(by_mass, push[k] - own[k]);
    out[k + 9] = share(-by_mass, pull[k] + own[k]);
  }
  return out;
}

double payload_of(const Vec18& shares) {
  const double most = shares.maxCoeff();
  if (most == infinity) return not_a_number;
  return most > 0.0 ? 1.0 / most : infinity;
}

}  // namespace ninedof
