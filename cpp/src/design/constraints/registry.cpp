/// What constraints there are, and which limits and options each takes.
/// Declared in design/constraints/constraint.hpp.

#include <cmath>

#include "design/constraints/constraint.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

struct Known {
  const char* name;
  LimitKind kind;
  bool low, high;       // sides it has
  bool of_zp, of_radius;  // units it takes besides lengths
  std::unique_ptr<Constraint> (*make)(const Limit&, int, Purpose);
};

constexpr std::array known{
    Known{"radius_ratio", LimitKind::ratio, true, true, false, false, make_radius_ratio},
    Known{"leg_ratio", LimitKind::ratio, true, true, false, false, make_leg_ratio},
    Known{"stroke_ratio", LimitKind::ratio, false, true, false, false, make_stroke},
    Known{"zs_fraction", LimitKind::ratio, true, true, false, false, make_zs_fraction},
    Known{"stroke", LimitKind::length, false, true, true, false, make_stroke},
    Known{"leg_length", LimitKind::length, true, true, true, false, make_leg_length},
    Known{"external_length", LimitKind::length, true, true, true, false, make_leg_length},
    Known{"upper_length", LimitKind::length, true, true, true, false, make_leg_length},
    Known{"lower_length", LimitKind::length, true, true, true, false, make_leg_length},
    Known{"height", LimitKind::length, true, true, false, false, make_height},
    Known{"footprint", LimitKind::length, true, true, false, false, make_footprint},
    Known{"joint_height", LimitKind::length, false, true, false, true, make_joint_height},
    Known{"joint_spacing", LimitKind::length, true, false, false, true, make_joint_spacing},
    Known{"leg_clearance", LimitKind::length, true, false, true, false, make_leg_clearance},
    Known{"base_cone", LimitKind::angle, false, true, false, false, make_joint_cone},
    Known{"platform_cone", LimitKind::angle, false, true, false, false, make_joint_cone},
    Known{"singularity_free", LimitKind::sign, true, false, false, false, make_singularity_free},
};

const Known& find(const std::string& name) {
  std::string names;
  for (const Known& k : known) {
    if (name == k.name) return k;
    names += (names.empty() ? "\"" : ", \"") + std::string(k.name) + "\"";
  }
  throw InvalidArgument("constraints", "\"" + name + "\"", "one of " + names);
}

}  // namespace

void Limit::validate() const {
  const Known& k = find(name);
  const std::string text = format_interval(low, high);
  if (std::isnan(low) || std::isnan(high) || low > high || low == infinity)
    throw InvalidArgument(name, text, "low <= high, low finite or open");
  if (high <= 0.0) throw InvalidArgument(name, text, "low <= high, low finite and high > 0");
  const bool open_low = k.kind == LimitKind::sign ? std::isinf(low) : low <= 0.0;
  if (!k.low && !open_low) throw InvalidArgument(name, text, "only a greatest value (max)");
  if (!k.high && high < infinity) throw InvalidArgument(name, text, "only a least value (min)");
  if ((of == Unit::zp && !k.of_zp) || (of == Unit::radius && !k.of_radius))
    throw InvalidArgument(
        name, of == Unit::zp ? "of = \"zp\"" : "of = \"radius\"",
        std::string("of = \"length\"") + (k.of_zp ? " or \"zp\"" : "") + (k.of_radius ? " or \"radius\"" : ""));
  if (!axis.allFinite() || (!axis.isZero(0.0) && k.kind != LimitKind::angle))
    throw InvalidArgument(name, "an axis",
                          k.kind == LimitKind::angle ? "three finite numbers" : "none: only cones have one");
  if (steps < 1 || steps > 1000) throw InvalidArgument(name, std::to_string(steps) + " steps", "1 to 1000");
}

std::vector<std::string> constraint_names() {
  std::vector<std::string> names;
  for (const Known& k : known) names.emplace_back(k.name);
  return names;
}

LimitKind constraint_kind(const std::string& name) {
  return find(name).kind;
}

const char* to_string(LimitKind kind) {
  switch (kind) {
    case LimitKind::ratio: return "ratio";
    case LimitKind::length: return "length";
    case LimitKind::angle: return "angle";
    case LimitKind::sign: return "sign";
  }
  return "";
}

Unit unit_from(const std::string& word) {
  if (word == "length") return Unit::length;
  if (word == "zp") return Unit::zp;
  if (word == "radius") return Unit::radius;
  throw InvalidArgument("of", "\"" + word + "\"", "\"length\", \"zp\" or \"radius\"");
}

std::unique_ptr<Constraint> make_constraint(const Limit& limit, int poses, Purpose purpose) {
  return find(limit.name).make(limit, poses, purpose);
}

}  // namespace ninedof
