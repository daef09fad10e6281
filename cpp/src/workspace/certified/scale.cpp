#include "workspace/certified/scale.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include "limits/table.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/math/interval.hpp"
#include "workspace/criteria/placement.hpp"

namespace ninedof::certified {
namespace {

Vec3 times(const Vec3& v, int exponent) {
  return v.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
}
Triple times(const Triple& t, int exponent) {
  return {times(t[0], exponent), times(t[1], exponent), times(t[2], exponent)};
}

/// Forces stay, and with them masses and gravity: powers are lengths then.
bool has_lengths(const Limit& limit) {
  const ConstraintInfo& row = limit_row(limit.name).info;
  return row.kind == LimitKind::length || std::string_view(row.needs).ends_with("speeds");
}
Duty scaled(Duty duty, int exponent) {
  const auto length = [&](double x) { return std::ldexp(x, exponent); };
  for (Load& load : duty.loads) load.moment = times(load.moment, exponent);
  duty.masses.centre = times(duty.masses.centre, exponent);
  for (Vec9* centres : {&duty.masses.cylinder_centre, &duty.masses.rod_centre}) *centres = centres->unaryExpr(length);
  duty.motion.linear_speed = length(duty.motion.linear_speed);
  return duty;
}

/// Throws for a number that a double does not hold beside the size of the joints: the question would be another one.
void require_held(const char* name, double x, int exponent) {
  if (std::ldexp(std::ldexp(x, exponent), -exponent) != x)
    throw InvalidArgument(name, format_number(x), "0, or a number less far from the size of the joints");
}
void require_held(const char* name, const Vec3& v, int exponent) {
  for (const double x : v) require_held(name, x, exponent);
}
void require_held(const char* name, const Triple& t, int exponent) {
  for (const Vec3& v : t) require_held(name, v, exponent);
}

void require_held(const Question& q, int exponent) {
  require_held("base_external", q.geometry.base_external(), exponent);
  require_held("base_internal", q.geometry.base_internal(), exponent);
  require_held("platform_external", q.geometry.platform_external(), exponent);
  require_held("platform_internal", q.geometry.platform_internal(), exponent);
  for (const Vec3* end : {&q.domain.low, &q.domain.high})
    for (const double x : *end)
      if (std::isfinite(std::ldexp(x, exponent))) require_held("box", x, exponent);  // limits of legs may bound it
  require_held("internal_point", q.rule.point, exponent);
  if (q.criteria.legs)
    for (const Vec9* ends : {&q.criteria.legs->low, &q.criteria.legs->high})
      for (const double x : *ends) require_held(leg_limits_name, x, exponent);
  for (const Limit& limit : q.criteria.limits) {
    if (has_lengths(limit))
      for (const double x : {limit.low, limit.high}) require_held(limit.name.c_str(), x, exponent);
    if (limit.duty == nullptr) continue;
    require_held("speeds", limit.duty->motion.linear_speed, exponent);
    for (const Load& load : limit.duty->loads) require_held("loads", load.moment, exponent);
    require_held("masses", limit.duty->masses.centre, exponent);
    for (const Vec9* centres : {&limit.duty->masses.cylinder_centre, &limit.duty->masses.rod_centre})
      for (const double x : *centres) require_held("masses", x, exponent);
  }
  require_held("characteristic_length", q.criteria.characteristic_length, exponent);
  require_held("home", q.home.position, exponent);
  require_held("home", q.home.internal_point, exponent);
}

}  // namespace

Configuration home_or_middle(const Geometry& g, const WorkspaceDomain& domain, const InternalPointRule& rule,
                             const WorkspaceCriteria& criteria, const std::optional<Configuration>& home) {
  if (home) return *home;
  Configuration out;
  out.position = 0.5 * (domain.low + domain.high);
  if (domain.archetype == Archetype::constant_orientation) out.rotation = domain.rotations.front();
  out.internal_point = Placement(g, rule, criteria).point(out.position, out.rotation);
  return out;
}

int exponent_of(const Question& q) {
  double most = 0.0;
  for (const Triple* t : {&q.geometry.base_external(), &q.geometry.base_internal(), &q.geometry.platform_external(),
                          &q.geometry.platform_internal()})
    for (const Vec3& joint : *t) most = std::max(most, joint.cwiseAbs().maxCoeff());
  return -std::ilogb(most);
}

Question scaled(const Question& q, int exponent) {
  require_held(q, exponent);
  const Geometry& g = q.geometry;
  Question out{{times(g.base_external(), exponent), times(g.base_internal(), exponent),
                times(g.platform_external(), exponent), times(g.platform_internal(), exponent)},
               q.domain,
               q.rule,
               q.criteria,
               q.home};
  out.domain.low = times(q.domain.low, exponent);
  out.domain.high = times(q.domain.high, exponent);
  out.rule.point = times(q.rule.point, exponent);
  const auto length = [&](double x) { return std::ldexp(x, exponent); };
  if (out.criteria.legs)
    for (Vec9* ends : {&out.criteria.legs->low, &out.criteria.legs->high}) *ends = ends->unaryExpr(length);
  for (Limit& limit : out.criteria.limits) {
    if (has_lengths(limit))
      for (double* x : {&limit.low, &limit.high}) *x = length(*x);
    if (limit.duty != nullptr) limit.duty = std::make_shared<const Duty>(scaled(*limit.duty, exponent));
  }
  out.criteria.characteristic_length = length(out.criteria.characteristic_length);
  out.home.position = times(q.home.position, exponent);
  out.home.internal_point = times(q.home.internal_point, exponent);
  return out;
}

void scale_back(CertifiedWorkspace& found, int exponent) {
  for (std::vector<Vec3>* all : {&found.inner_low, &found.inner_high, &found.open_low, &found.open_high})
    for (Vec3& v : *all) v = times(v, -exponent);
  found.low = times(found.low, -exponent);
  found.high = times(found.high, -exponent);
  // A volume may leave the range of doubles, and is then rounded outward as well.
  const auto volume = [&](VolumeBounds& v) {
    if (v.low > 0.0) v.low = std::max(detail::below(std::ldexp(v.low, -3 * exponent)), 0.0);
    if (v.high > 0.0) v.high = detail::above(std::ldexp(v.high, -3 * exponent));
  };
  volume(found.volume);
  volume(found.home_volume);
  for (VolumeBounds& one : found.open_volume) volume(one);
}

}  // namespace ninedof::certified
