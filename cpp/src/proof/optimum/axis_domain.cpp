#include "proof/optimum/axis_domain.hpp"

#include "limits/rows.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof::proof {
namespace {

constexpr Interval anything{0.0, infinity};

bool apart(const Interval& a, const Interval& b) {
  return a.hi < b.lo || b.hi < a.lo;
}
Interval both(const Interval& a, const Interval& b) {
  const Interval out{std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
  if (out.lo > out.hi)
    throw InvalidArgument("study", "limits that no design keeps", "limits that can be kept together");
  return out;
}

/// The same of what lemma 9 leaves: if nothing, no condition number is below the target.
Interval left_of(const Interval& a, const Interval& b, bool& empty) {
  const Interval out{std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
  if (out.lo <= out.hi) return out;
  empty = true;
  return a;
}

Interval of(const Bounds& b) {
  return Interval::between(b.low, b.high);
}

/// Distance of the joints of a hexagon from its middle: R^2 = (s1^2 + s1 s2 + s2^2) / 3, growing with both sides.
Interval hexagon_radius(const Interval& s1, const Interval& s2) {
  return sqrt((square(s1) + s1 * s2 + square(s2)) / 3.0);
}

/// Angle of its joint 1 below the x axis, from 30 to 90 degrees, growing with s2 / s1.
Interval hexagon_angle(const Interval& s1, const Interval& s2) {
  const auto at = [](const Interval& a, const Interval& b) { return atan((a + 2.0 * b) / (sqrt(Interval(3.0)) * a)); };
  const Interval third = atan(1.0 / sqrt(Interval(3.0))), right = 3.0 * third;
  return {s1.hi > 0.0 ? at(s1.hi, s2.lo).lo : right.lo, s2.hi > 0.0 ? at(s1.lo, s2.hi).hi : third.hi};
}

void require(bool condition, const char* argument, const std::string& got, const char* expected) {
  if (!condition) throw InvalidArgument(argument, got, expected);
}

void require_theory(const Problem& study) {
  require(study.family == "hexagonal" || study.family == "symmetric", "family", study.family,
          "\"hexagonal\" or \"symmetric\" for a proof");
  const Objective& o = study.objective;
  require(o.index == Index::condition_number, "objective", "another index", "the condition number for a proof");
  require(o.poses.empty(), "objective", std::to_string(o.poses.size()) + " poses",
          "the neutral pose alone for a proof");
  require(study.characteristic_length.choice == StudyLength::Choice::number, "characteristic_length", "no number",
          "a number for a proof");
}

/// Names and bounds of the lengths that must be positive and finite, so that the domain is bounded in logarithms.
void require_positive_finite(const char* name, const Interval& x) {
  require(x.lo > 0.0 && x.hi < infinity, name, format_interval(x.lo, x.hi), "positive and finite bounds for a proof");
}

void read_variables(const Problem& study, AxisDomain& d) {
  const auto v = [&](std::size_t k) { return of(study.variables[k]); };
  Interval angle;
  if (study.family == "hexagonal") {
    d.dimension = hexagonal_coordinates;
    d.base_external = d.base_internal = hexagon_radius(v(0), v(1));
    d.platform_external = d.platform_internal = hexagon_radius(v(2), v(3));
    d.zp = v(4);
    d.zs = v(5);
    angle = v(6) + hexagon_angle(v(0), v(1)) - hexagon_angle(v(2), v(3));
  } else {
    d.dimension = coordinates;
    d.base_external = v(0);
    d.base_internal = v(1);
    d.platform_external = v(3);
    d.platform_internal = v(5);
    d.zp = v(7);
    d.zs = v(8);
    angle = v(4);
    for (const auto& [name, x] :
         {std::pair("base_internal_radius", d.base_internal), {"platform_internal_radius", d.platform_internal}})
      require_positive_finite(name, x);
  }
  d.cosine = cos(angle);
  require_positive_finite("zp", d.zp);
  for (const auto& [name, x] : {std::pair("base", d.base_external), {"platform", d.platform_external}})
    require(x.hi < infinity, name, "an infinite upper bound", "finite bounds of its joints for a proof");
  const Interval length(study.characteristic_length.value);
  for (Interval* x : {&d.base_external, &d.base_internal, &d.platform_external, &d.platform_internal, &d.zp, &d.zs})
    *x = {std::max((*x / length).lo, 0.0), (*x / length).hi};
}

void read_limits(const Problem& study, AxisDomain& d, std::vector<std::string>& left_out) {
  d.share = {0.0, 1.0};
  d.radius_ratio = anything;
  d.log_leg_ratio = infinity;
  for (const Limit& limit : study.limits) {
    const Interval range{std::max(limit.low, 0.0), limit.high};
    const LimitRow& row = limit_row(limit.name);
    if (row.design == &zs_fraction_row) {
      d.share = both(d.share, range);
    } else if (row.design == &radius_ratio_row) {
      d.radius_ratio = both(d.radius_ratio, range);
    } else if (row.spread == &leg_ratio_row) {
      if (limit.high < infinity) d.log_leg_ratio = std::min(d.log_leg_ratio, log(Interval(limit.high)).hi);
      if (limit.low > 1.0) left_out.push_back(limit.label() + ".min");
    } else {
      left_out.push_back(limit.label());
    }
  }
  if (study.objective.neutral_condition_limit < infinity || study.objective.condition_limit < infinity)
    left_out.emplace_back("condition_number");
}

}  // namespace

AxisDomain axis_domain(const Problem& study, double target, std::vector<std::string>& left_out) {
  require_theory(study);
  AxisDomain d;
  read_variables(study, d);
  read_limits(study, d, left_out);

  const bool hexagonal = d.dimension == hexagonal_coordinates;
  Interval t = both(d.share, d.zs / d.zp);
  if (hexagonal) both(d.base_external / d.platform_external, d.radius_ratio);

  // Lemma 9: kappa >= f0 / g0 >= zp / (R U) and kappa >= f0 / w0 >= max(z (1 + o), y (1 + 1/o)) / sqrt(N): outside
  // these bounds there is no condition number below the target.
  const Interval least_area = d.zp.lo / Interval(target);  // of R U
  Interval& U = d.box[at_size];
  U = left_of(d.platform_external, {(least_area / d.base_external.hi).lo, infinity}, d.empty);
  const Interval R = left_of(d.base_external, {(least_area / U.hi).lo, infinity}, d.empty);
  d.box[at_upper] = hexagonal ? Interval(1.0) : d.platform_internal / U;
  d.box[at_ratio] = R / U;
  const double most_ratio =
      d.radius_ratio.hi < infinity ? (d.radius_ratio * std::max(1.0, d.box[at_upper].hi)).hi : infinity;
  const double least_ratio = hexagonal ? d.radius_ratio.lo : 0.0;
  d.box[at_ratio] = left_of(d.box[at_ratio], {least_ratio, most_ratio}, d.empty);
  d.box[at_lower] = hexagonal ? d.box[at_ratio] : d.base_internal / U;
  d.box[at_height] = d.zp / U;
  // Lemma 9 again: sin theta >= zp / (R U kappa), and tan(theta / 2) lies from sin(theta) / 2 to 2 / sin(theta).
  const double least_sine = (least_area / (Interval(R.hi) * U.hi)).lo;
  const auto half_tangent = [](double c) { return sqrt((1.0 - Interval(c)) / (1.0 + Interval(c))); };
  d.box[at_angle] = left_of(
      {half_tangent(std::min(d.cosine.hi, 1.0)).lo, d.cosine.lo > -1.0 ? half_tangent(d.cosine.lo).hi : infinity},
      least_sine > 0.0 ? Interval(0.5 * least_sine, (2.0 / Interval(least_sine)).hi) : Interval(0.0, infinity),
      d.empty);

  const Interval longest = sqrt(square(1.0 + Interval(d.box[at_ratio].hi)) + square(Interval(d.box[at_height].hi)));
  const Interval room = target * longest;
  const Interval least_share = 1.0 / (room / d.box[at_lower].lo), least_rest = 1.0 / (room / d.box[at_upper].lo);
  t = left_of(t, {least_share.lo, (1.0 - Interval(least_rest.lo)).hi}, d.empty);
  d.box[at_share] = {(Interval(t.lo) / (1.0 - Interval(t.lo))).lo, (Interval(t.hi) / (1.0 - Interval(t.hi))).hi};
  return d;
}

bool AxisDomain::excludes(const Box& b) const {
  const Interval &U = b[at_size], &x = b[at_ratio], &y = b[at_lower], &z = b[at_upper];
  const Interval height = U * b[at_height], t = 1.0 / (1.0 + 1.0 / b[at_share]);
  if (apart(U * x, base_external) || apart(height, zp) || apart(height * t, zs) || apart(t, share)) return true;
  if (dimension == hexagonal_coordinates) return false;
  if (apart(U * y, base_internal) || apart(U * z, platform_internal)) return true;
  return apart(max(x, y) / max(Interval(1.0), z), radius_ratio);
}

bool AxisDomain::contains(const Box& b) const {
  const auto inside = [](const Interval& x, const Interval& of) { return of.lo <= x.lo && x.hi <= of.hi; };
  const Interval &U = b[at_size], &x = b[at_ratio], &y = b[at_lower], &z = b[at_upper];
  const Interval height = U * b[at_height], t = 1.0 / (1.0 + 1.0 / b[at_share]);
  if (!inside(U, platform_external) || !inside(U * x, base_external) || !inside(height, zp) ||
      !inside(height * t, zs) || !inside(t, share) || !inside(axis_pieces(b).cosine, cosine))
    return false;
  if (!inside(max(x, y) / max(Interval(1.0), z), radius_ratio)) return false;
  if (dimension != hexagonal_coordinates && !(inside(U * y, base_internal) && inside(U * z, platform_internal)))
    return false;
  const Values v = axis_values(axis_pieces(b));
  const double longest = std::max({v[external_leg].hi, v[upper_leg].hi, v[lower_leg].hi});
  const double shortest = std::min({v[external_leg].lo, v[upper_leg].lo, v[lower_leg].lo});
  return longest - shortest <= log_leg_ratio;
}

}  // namespace ninedof::proof
