#include "workspace/requirements.hpp"

#include <cmath>
#include <numbers>

#include "ninedof/math/error.hpp"
#include "ninedof/math/length_range.hpp"
#include "ninedof/math/rotation.hpp"

namespace ninedof {
namespace {

using std::numbers::pi;

void require_domain(const WorkspaceDomain& d) {
  if (d.rotations.empty()) throw InvalidArgument("rotations", "none", "at least one");
  for (const Mat3& q : d.rotations) require_rotation("rotation", q);
  if (d.archetype != Archetype::orientation) {
    for (int k = 0; k < 3; ++k)
      if (!(std::isfinite(d.low[k]) && std::isfinite(d.high[k]) && d.low[k] < d.high[k]))
        throw InvalidArgument(std::string("box (") + "xyz"[k] + ")", format_interval(d.low[k], d.high[k]),
                              "finite low < high");
    return;
  }
  if (!d.position.allFinite())
    throw InvalidArgument("position", "a coordinate that is not finite", "three finite numbers");
  const OrientationRegion& r = d.region;
  if (!(r.angle > 0.0 && r.angle <= pi))
    throw InvalidArgument("region (angle)", format_number(r.angle), "radians in (0, pi]");
  if (r.chart == OrientationRegion::Chart::tilt_torsion &&
      !(std::isfinite(r.torsion_low) && r.torsion_low < r.torsion_high &&
        r.torsion_high - r.torsion_low <= 2.0 * pi + 1e-12))
    throw InvalidArgument("region (torsion)", format_interval(r.torsion_low, r.torsion_high),
                          "low < high, at most 2 pi apart");
}

void require_cone(const char* name, const std::optional<ConeLimit>& cone) {
  if (!cone) return;
  if (!(cone->angle > 0.0 && cone->angle <= pi))
    throw InvalidArgument(name, format_number(cone->angle), "radians in (0, pi]");
  if (!cone->axis.allFinite())
    throw InvalidArgument(std::string(name) + " axis", "numbers that are not finite", "a direction");
}

void require_criteria(const WorkspaceCriteria& c) {
  require_length("characteristic_length", c.characteristic_length);
  if (c.legs) {
    InternalPointProblem limits;
    limits.limits = *c.legs;
    validate(limits);
  }
  require_cone("base_cone", c.base_cone);
  require_cone("platform_cone", c.platform_cone);
  if (c.leg_clearance) require_positive("leg_clearance", *c.leg_clearance);
  if (c.condition_number && !(*c.condition_number >= 1.0))
    throw InvalidArgument("condition_number", format_number(*c.condition_number), "at least 1");
}

}  // namespace

void require_question(const WorkspaceDomain& domain, const InternalPointRule& rule, const WorkspaceCriteria& criteria,
                      const std::optional<Configuration>& home) {
  require_domain(domain);
  require_criteria(criteria);
  if (!rule.point.allFinite() || !std::isfinite(rule.fraction))
    throw InvalidArgument("internal_point", "a number that is not finite", "finite numbers");
  if (home) validate(*home);
}

}  // namespace ninedof
