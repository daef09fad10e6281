#include "workspace/requirements.hpp"

#include <cmath>
#include <numbers>

#include "limits/table.hpp"
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

void require_limit(const Limit& limit) {
  const LimitRow& row = limit_row(limit.name);
  const char* name = row.info.name;
  if (!row.is_criterion())
    throw InvalidArgument("criteria", limit.name, "limits with a value at every pose, and `legs` for those of lengths");
  if (limit.of != Unit::length || limit.at != LimitAt::poses)
    throw InvalidArgument(name, "a fraction, or a limit at the neutral pose", "a number, at every pose");
  if (row.info.kind == LimitKind::angle && !(limit.high > 0.0 && limit.high <= pi))
    throw InvalidArgument(name, format_number(limit.high), "radians in (0, pi]");
  if (row.info.kind == LimitKind::length && row.info.sides != LimitSides::both)
    require_positive(name, row.info.sides == LimitSides::only_low ? limit.low : limit.high);
  limit.validate();
}

}  // namespace

void require_criteria(const WorkspaceCriteria& c) {
  require_length("characteristic_length", c.characteristic_length);
  if (c.legs) {
    InternalPointProblem limits;
    limits.limits = *c.legs;
    validate(limits);
  }
  for (const Limit& limit : c.limits) require_limit(limit);
  if (c.condition_number && !(*c.condition_number >= 1.0))
    throw InvalidArgument("condition_number", format_number(*c.condition_number), "at least 1");
}

void require_question(const WorkspaceDomain& domain, const InternalPointRule& rule, const WorkspaceCriteria& criteria,
                      const std::optional<Configuration>& home) {
  require_domain(domain);
  require_criteria(criteria);
  if (!rule.point.allFinite() || !std::isfinite(rule.fraction))
    throw InvalidArgument("internal_point", "a number that is not finite", "finite numbers");
  if (home) validate(*home);
}

}  // namespace ninedof
