#include "proof/optimum/axis_domain.hpp"

#include <algorithm>
#include <tuple>

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
}

void require_finite(const char* name, const Interval& x) {
  require(x.hi > 0.0 && x.hi < infinity, name, format_interval(x.lo, x.hi),
          "a positive and finite upper bound for a proof");
}

/// What the characteristic length is, and the unit of the lengths: not above it, if anything is known of it.
Interval read_length(const StudyLength& given, AxisDomain& d) {
  if (given.choice == StudyLength::Choice::number) return given.value;
  if (given.choice == StudyLength::Choice::free && given.bounds.low == given.bounds.high) return given.bounds.low;
  d.scale = {1.0, infinity};
  if (given.choice == StudyLength::Choice::free) {
    d.scale.hi = (Interval(given.bounds.high) / given.bounds.low).hi;
    return given.bounds.low;
  }
  if (given.kind != LengthKind::optimal) d.chart.length = given.kind;
  // The legs together are at least three times zp and three times the way from plate to plate by O.
  const double least_mean = (2.0 * Interval(d.zp.lo) / 3.0).lo;
  if (given.kind == LengthKind::mean_leg) return least_mean;
  d.scale.lo = 0.0;
  return 1.0;
}

void read_variables(const Problem& study, AxisDomain& d) {
  const auto v = [&](std::size_t k) { return of(study.variables[k]); };
  Interval angle;
  if (study.family == "hexagonal") {
    d.chart.dimension = hexagonal_coordinates;
    d.base_external = d.base_internal = hexagon_radius(v(0), v(1));
    d.platform_external = d.platform_internal = hexagon_radius(v(2), v(3));
    d.zp = v(4);
    d.zs = v(5);
    angle = v(6) + hexagon_angle(v(0), v(1)) - hexagon_angle(v(2), v(3));
  } else {
    d.base_external = v(0);
    d.base_internal = v(1);
    d.platform_external = v(3);
    d.platform_internal = v(5);
    d.zp = v(7);
    d.zs = v(8);
    angle = v(4);
    d.chart.slopes = !(d.base_internal.lo > 0.0 && d.platform_internal.lo > 0.0);
    for (const auto& [name, x] :
         {std::pair("base_internal_radius", d.base_internal), {"platform_internal_radius", d.platform_internal}})
      require_finite(name, x);
  }
  d.cosine = cos(angle);
  require_finite("zp", d.zp);
  if (!(d.zp.lo > 0.0)) {
    const bool of_kind = study.characteristic_length.choice == StudyLength::Choice::kind;
    require(!of_kind && !d.chart.slopes, "zp", format_interval(d.zp.lo, d.zp.hi),
            of_kind ? "a positive lower bound for a proof, or a number as the characteristic length"
                    : "a positive lower bound for a proof, or one of both radii of internal joints");
  }
  for (const auto& [name, x] : {std::pair("base", d.base_external), {"platform", d.platform_external}})
    require(x.hi < infinity, name, "an infinite upper bound", "finite bounds of its joints for a proof");
  const Interval length = read_length(study.characteristic_length, d);
  for (Interval* x : {&d.base_external, &d.base_internal, &d.platform_external, &d.platform_internal, &d.zp, &d.zs})
    *x = {std::max((*x / length).lo, 0.0), (*x / length).hi};
}

void read_limits(const Problem& study, AxisDomain& d, std::vector<std::string>& left_out) {
  d.share = {0.0, 1.0};
  d.radius_ratio = anything;
  for (const Limit& limit : study.limits) {
    const Interval range{std::max(limit.low, 0.0), limit.high};
    const LimitRow& row = limit_row(limit.name);
    if (row.design == &zs_fraction_row) {
      d.share = both(d.share, range);
    } else if (row.design == &radius_ratio_row) {
      d.radius_ratio = both(d.radius_ratio, range);
    } else if (row.spread == &leg_ratio_row) {
      if (limit.high < infinity)
        d.limits.log_leg_ratio = std::min(d.limits.log_leg_ratio, log(Interval(limit.high)).hi);
      if (limit.low > 1.0) left_out.push_back(limit.label() + ".min");
    } else {
      left_out.push_back(limit.label());
    }
  }
  if (study.objective.neutral_condition_limit < infinity || study.objective.condition_limit < infinity)
    left_out.emplace_back("condition_number");
}

/// Lemma 9, of a study whose zp begins at 0: no design below the target has a smaller one.
double least_height(const AxisDomain& d, double target) {
  const Interval K(target), M(std::max(d.base_external.hi, d.platform_external.hi));
  const Interval &R = d.base_internal, &U = d.platform_internal;
  const Interval leg = d.chart.hexagonal() ? 1.0 / K : (Interval(R.lo) + U.lo) / (K * M);  // l / (U h) is not less
  const Interval steep = d.chart.hexagonal() ? K * M : Interval(d.zp.hi) / std::min(R.lo, U.lo);
  return (leg / (K * sqrt(2.0 + square(steep)))).lo;
}

/// Lemma 9, where nothing is known of the characteristic length: the least R and U of designs below the target.
std::pair<double, double> least_radii(const AxisDomain& d, double target) {
  const Interval K(target), zp(d.zp.lo), R = d.base_external, U = d.platform_external;
  const auto leg = [&](double height) { return sqrt(square(Interval(R.hi) + U.hi) + square(Interval(height))); };
  const double least_base = std::max(R.lo, (square(zp) / (square(K) * leg(d.zp.lo))).lo);
  double least_platform = U.lo;
  if (d.chart.hexagonal()) {
    if (d.radius_ratio.hi < infinity) least_platform = std::max(U.lo, (Interval(least_base) / d.radius_ratio.hi).lo);
  } else if (!d.chart.slopes) {
    const Interval q = Interval(d.platform_internal.lo) / (K * leg(d.zp.hi));
    const Interval steep =
        square(Interval(d.zp.hi) / d.platform_internal.lo) + square(Interval(d.zp.hi) / (q * d.base_internal.lo));
    const Interval length = zp / (K * sqrt(2.0 / square(q) + steep));  // l_c is not less
    least_platform = std::max(U.lo, (zp * length / (K * R.hi)).lo);
  }
  require(least_platform > 0.0, "characteristic_length", "one without a positive lower bound",
          "a positive lower bound of the radii of platform joints, or a number, for a proof");
  return {least_base, least_platform};
}

/// In the place of o, y and z, by lemma 9 and 9a: what they can be below the target.
void take_slopes(AxisDomain& d, double target, const Interval& U, const Interval& room, Interval t) {
  Box& b = d.box;
  const Interval eta(b[at_height].lo), moved2 = square(eta * b[at_size].hi);
  const Interval longest2 = square(1.0 + Interval(b[at_ratio].hi)) + square(eta);
  const Interval flat((sqrt(Interval(2.0)) * square(eta) / (target * sqrt(longest2 * (1.0 + moved2)))).lo, room.hi);
  if (d.limits.log_leg_ratio < infinity) {  // an internal leg is not shorter than zp / L
    const double least = (exp(Interval(-d.limits.log_leg_ratio)) / sqrt(1.0 + square(Interval(flat.hi) / eta))).lo;
    t = left_of(t, {least, (1.0 - Interval(least)).hi}, d.empty);
  }
  const auto over = [&](const Interval& radius, const Interval& part) {
    const double most = part.lo > 0.0 ? (Interval(radius.hi) / U.lo / part.lo).hi : infinity;
    return left_of({std::max((Interval(radius.lo) / U.hi / part.hi).lo, 0.0), most}, flat, d.empty);
  };
  b[at_lower] = over(d.base_internal, t);
  b[at_upper] = over(d.platform_internal, not_negative(1.0 - t));
  b[at_share] = {std::max((1.0 + t).lo, 1.0), std::min((1.0 + t).hi, 2.0)};
}

}  // namespace

AxisDomain axis_domain(const Problem& study, double target, std::vector<std::string>& left_out) {
  require_theory(study);
  AxisDomain d;
  read_variables(study, d);
  read_limits(study, d, left_out);

  const bool hexagonal = d.chart.hexagonal();
  both(d.share, d.zs / d.zp);
  if (!(d.zp.lo > 0.0)) d.zp = left_of(d.zp, {least_height(d, target), infinity}, d.empty);
  Interval t = left_of(d.share, d.zs / d.zp, d.empty);
  if (hexagonal) both(d.base_external / d.platform_external, d.radius_ratio);

  // Lemma 9: kappa >= f0 / g0 >= zp / (R U) and kappa >= f0 / w0 >= max(z (1 + o), y (1 + 1/o)) / sqrt(N): outside
  // these bounds there is no condition number below the target.
  const Interval least_area = d.zp.lo / Interval(target);  // of R U / l_c
  double least_base = 0.0, least_platform = (least_area / d.base_external.hi).lo;
  if (!(d.scale.lo > 0.0)) std::tie(least_base, least_platform) = least_radii(d, target);
  const Interval U = left_of(d.platform_external, {least_platform, infinity}, d.empty);
  if (d.scale.lo > 0.0) least_base = (least_area / U.hi).lo;
  const Interval R = left_of(d.base_external, {least_base, infinity}, d.empty);
  d.box[at_upper] = hexagonal ? Interval(1.0) : d.platform_internal / U;
  d.box[at_ratio] = R / U;
  const double most_ratio =
      d.radius_ratio.hi < infinity ? (d.radius_ratio * std::max(1.0, d.box[at_upper].hi)).hi : infinity;
  const double least_ratio = hexagonal ? d.radius_ratio.lo : 0.0;
  d.box[at_ratio] = left_of(d.box[at_ratio], {least_ratio, most_ratio}, d.empty);
  d.box[at_lower] = hexagonal ? d.box[at_ratio] : d.base_internal / U;
  d.box[at_height] = d.zp / U;
  d.box[at_size] = U;
  if (d.scaled()) {  // kappa >= (zp / l_c) / sqrt(N)
    const Interval farthest = sqrt(1.0 + square((Interval(R.hi) + U.hi) / d.zp.lo));
    const double most = std::min((target * farthest).hi, d.scale.lo > 0.0 ? U.hi : infinity);
    d.box[at_size] = left_of({(U.lo / Interval(d.scale.hi)).lo, most}, {(least_area / R.hi).lo, infinity}, d.empty);
  }
  // Lemma 9 again: sin theta >= zp / (R U kappa), and tan(theta / 2) lies from sin(theta) / 2 to 2 / sin(theta).
  const double least_sine = (least_area / (Interval(R.hi) * d.box[at_size].hi)).lo;
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
  if (d.chart.slopes) take_slopes(d, target, U, room, t);
  if (!d.chart.length)
    std::ranges::transform(d.size_bounds(), d.limits.size.begin(),
                           [&](const Interval& bounds) { return not_negative(bounds / d.scale); });
  if (!d.empty) settle(d.box, d.chart);
  d.empty = d.empty || d.box[at_size].lo > d.box[at_size].hi;
  return d;
}

namespace {

Interval ratio_of(const Interval& x, const Sizes& part) {
  return max(x, part[lower_size - first_size]) / max(Interval(1.0), part[upper_size - first_size]);
}

}  // namespace

bool AxisDomain::excludes(const Box& b) const {
  const Interval &U = b[at_size], &x = b[at_ratio];
  if (U.lo > U.hi) return true;
  const Sizes part = axis_sizes(b, chart), bounds = size_bounds();
  Interval size = scaled() ? platform_external : U;  // of a free l_c, what the bounds leave of it
  for (std::size_t i = 0; i < sizes_of(chart); ++i) {
    if (apart(size * part[i], bounds[i])) return true;
    if (!scaled()) continue;
    const Interval fits = bounds[i] / part[i];
    if (apart(size, fits)) return true;
    size = {std::max(size.lo, fits.lo), std::min(size.hi, fits.hi)};
  }
  if (scaled() && apart(size / U, scale)) return true;
  if (apart(axis_share(b, chart), share)) return true;
  return !chart.hexagonal() && apart(ratio_of(x, part), radius_ratio);
}

bool AxisDomain::contains(const Box& b) const {
  const auto inside = [](const Interval& x, const Interval& of) { return of.lo <= x.lo && x.hi <= of.hi; };
  const Interval& U = b[at_size];
  const AxisPieces<Interval> pieces = axis_pieces(b, chart);
  const Sizes part = axis_sizes(b, chart), bounds = size_bounds();
  const std::size_t count = sizes_of(chart);
  if (scaled()) {  // whether one U keeps all bounds
    double least = std::max(platform_external.lo, (U * scale.lo).hi);
    double most = std::min(platform_external.hi, (U * scale.hi).lo);
    for (std::size_t i = 0; i < count; ++i) {
      least = std::max(least, (Interval(bounds[i].lo) / part[i]).hi);
      most = std::min(most, (Interval(bounds[i].hi) / part[i]).lo);
    }
    if (!(least <= most)) return false;
  } else {
    if (!inside(U, platform_external)) return false;
    for (std::size_t i = 0; i < count; ++i)
      if (!inside(U * part[i], bounds[i])) return false;
  }
  if (!inside(axis_share(b, chart), share) || !inside(pieces.cosine, cosine)) return false;
  if (!inside(ratio_of(b[at_ratio], part), radius_ratio)) return false;
  const Values v = axis_values(pieces);
  const double longest = std::max({v[external_leg].hi, v[upper_leg].hi, v[lower_leg].hi});
  const double shortest = std::min({v[external_leg].lo, v[upper_leg].lo, v[lower_leg].lo});
  return longest - shortest <= limits.log_leg_ratio;
}

}  // namespace ninedof::proof
