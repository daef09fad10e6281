#include "proof/nonplanar/line_domain.hpp"

#include <numbers>

#include "limits/rows.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof::proof {
namespace {

constexpr Interval unlimited{-infinity, infinity};

Interval cut(const Interval& a, const Interval& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

void require_line_theory(const Problem& study) {
  const auto require = [](bool condition, const char* argument, const char* got, const char* expected) {
    if (!condition) throw InvalidArgument(argument, got, expected);
  };
  const Objective& o = study.objective;
  require(o.index == Index::condition_number, "objective", "another index", "the condition number for a proof");
  require(o.poses.empty(), "objective", "poses", "the neutral pose alone for a proof");
  require(study.tool.position.isZero(0.0) && !study.tool.turned(), "tool", "one", "none for a proof");
  require(study.characteristic_length.choice == StudyLength::Choice::number, "characteristic_length", "no number",
          "a number for a proof");
}

/// One limit of a study; false where it is left out.
bool read_limit(const Limit& limit, double length, LineLimits& out) {
  const Interval range{limit.low > 0.0 ? limit.low : -infinity, limit.high};
  const auto in_lengths = [&](double x) { return std::isfinite(x) ? Interval(x) / length : Interval(x); };
  const LimitRow& row = limit_row(limit.name);
  if (row.design == &zs_fraction_row) {
    out.share = cut(out.share, range);
  } else if (row.design == &radius_ratio_row) {
    out.radius_ratio = cut(out.radius_ratio, range);
  } else if (row.spread == &leg_ratio_row) {
    out.leg_ratio = std::min(out.leg_ratio, limit.high);
    return !(limit.low > 1.0);
  } else if (row.design == &height_row) {
    out.zp = cut(out.zp, {in_lengths(range.lo).lo, in_lengths(range.hi).hi});
  } else if (row.design == &footprint_row) {
    for (const std::size_t base : {0, 1})
      out.radius[base].hi = std::min(out.radius[base].hi, in_lengths(limit.high).hi);
    return !(limit.low > 0.0);
  } else if (row.design == &joint_height_row) {
    if (limit.of == Unit::radius) out.joint_height_in_radius = std::min(out.joint_height_in_radius, limit.high);
    else out.joint_height = std::min(out.joint_height, in_lengths(limit.high).hi);
  } else if (row.pose != nullptr && row.pose->first_leg >= 0) {
    std::array<Interval, 3>& of = limit.of == Unit::zp ? out.length_in_zp : out.length;
    const Interval lengths = limit.of == Unit::zp ? range : Interval(in_lengths(range.lo).lo, in_lengths(range.hi).hi);
    const int first = row.pose->first_leg;
    for (int leg = first; leg < first + row.pose->items; leg += 3)  // one of each kind: they have one length
      of[at_index(leg / 3)] = cut(of[at_index(leg / 3)], lengths);
  } else {
    return false;
  }
  return true;
}

}  // namespace

LineLimits line_limits(const Problem& study, std::vector<std::string>& left_out) {
  require_line_theory(study);
  const double length = study.characteristic_length.value;
  const std::vector<VariableInfo>& names = design_family(study.family).variables();
  // In characteristic lengths. Sizes may begin at 0: slopes of legs are coordinates of their own.
  const auto range = [&](std::size_t k) {
    const Interval x = Interval::between(study.variables[k].low, study.variables[k].high);
    if (!std::isfinite(x.lo) || !std::isfinite(x.hi))
      throw InvalidArgument(names[k].name, format_interval(x.lo, x.hi), "finite bounds for a proof");
    return x / length;
  };
  LineLimits out;
  out.radius = {range(0), range(1), range(3), range(5)};
  out.zp = range(7);
  out.zs = range(8);
  out.height = {range(9), range(10), range(11), range(12)};
  out.length.fill(unlimited);
  out.length_in_zp.fill(unlimited);
  constexpr std::size_t angle = 4;  // between the first external joints; those of internal joints act on no limit here
  if (study.variables[angle].high - study.variables[angle].low < 2.0 * std::numbers::pi)
    left_out.push_back(names[angle].name);
  for (const Limit& limit : study.limits)
    if (!read_limit(limit, length, out)) {
      const LimitRow& row = limit_row(limit.name);
      const bool low = row.spread == &leg_ratio_row || row.design == &footprint_row;  // their high side counts
      left_out.push_back(limit.label() + (low ? ".min" : ""));
    }
  if (study.objective.neutral_condition_limit < infinity || study.objective.condition_limit < infinity)
    left_out.emplace_back("condition_number");
  return out;
}

LineBox line_box(const LineLimits& limits, double target) {
  const Interval K(target), root3 = sqrt(Interval(3.0)), most_flat = root3 * K;
  const double arm = (1.0 / most_flat).lo;  // delta cos epsilon is more
  LineBox box;
  box[line::distance] = cut({arm, (1.5 * K).hi}, {0.0, std::min(limits.radius[0].hi, limits.radius[2].hi)});
  const double moment = (sqrt(Interval(1.5)) * K).hi;
  box[line::moment] = {-moment, moment};
  const double least_cosine = std::min((Interval(arm) / box[line::distance].hi).lo, 1.0);
  box[line::elevation] = {0.0, std::min(acos(Interval(least_cosine)).hi, 0.5 * std::numbers::pi)};
  box[line::height] = limits.zp;
  box[line::drop] = cut(limits.zp - limits.zs, limits.zp * (1.0 - limits.share));
  box[line::drop].lo = std::max(box[line::drop].lo, 0.0);
  const double least_flat = (1.0 / (K * sqrt(1.5 * (1.0 + square(Interval(box[line::drop].hi)))))).lo;
  box[line::upper] = box[line::lower] = {least_flat, most_flat.hi};
  for (const auto& [at, k] : {std::pair(line::base, 0U), {line::platform, 2U}})
    box[at] = {-limits.radius[k].hi, limits.radius[k].hi};
  for (const auto& [at, k] : {std::pair(line::lower_up, 1U), {line::upper_up, 3U}})
    box[at] = limits.radius[k] / Interval(least_flat, most_flat.hi);
  return box;
}

}  // namespace ninedof::proof
