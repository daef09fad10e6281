/// Lookups in the table of limits, and the checks of a limit against its row.
/// Declared in ninedof/limits/limits.hpp.

#include <algorithm>
#include <cmath>

#include "limits/table.hpp"
#include "math/numbers.hpp"
#include "ninedof/math/error.hpp"

namespace ninedof {
namespace {

/// The rows that `keep` accepts.
template <class Keep>
std::vector<ConstraintInfo> rows_where(const Keep& keep) {
  std::vector<ConstraintInfo> out;
  for (const LimitRow& row : limit_rows())
    if (keep(row)) out.push_back(row.info);
  return out;
}

}  // namespace

const LimitRow& limit_row(std::string_view name) {
  for (const LimitRow& row : limit_rows())
    if (row.is_constraint() && name == row.info.name) return row;
  std::string names;
  for (const LimitRow& row : limit_rows())
    if (row.is_constraint()) names += (names.empty() ? "\"" : ", \"") + std::string(row.info.name) + "\"";
  throw InvalidArgument("constraints", "\"" + std::string(name) + "\"", "one of " + names);
}

const PoseRow& pose_row(const char* argument, std::string_view name) {
  const LimitRow& row = limit_row(name);
  if (row.pose == nullptr)
    throw InvalidArgument(argument, "\"" + std::string(name) + "\"", "a limit that has a value at every pose");
  return *row.pose;
}

const LimitRow& leg_length_limit() {
  const auto of_all_legs = [](const LimitRow& row) {
    return row.pose != nullptr && row.pose->first_leg == 0 && row.pose->items == 9;
  };
  return *std::ranges::find_if(limit_rows(), of_all_legs);
}

const LimitRow& joint_cone_limit(bool platform) {
  const auto of_all_joints = [&](const LimitRow& row) {
    return row.pose != nullptr && row.pose->cone_body == static_cast<int>(platform) && row.pose->items == legs_at_body;
  };
  return *std::ranges::find_if(limit_rows(), of_all_joints);
}

const char* leg_name(int leg) {
  return std::array{"l1", "l2", "l3", "q1", "q2", "q3", "r1", "r2", "r3"}[at_index(leg)];
}

std::string Limit::label() const {
  return at == LimitAt::neutral ? name + " at neutral" : name;
}

void Limit::validate() const {
  const ConstraintInfo& row = limit_row(name).info;
  const std::string text = format_interval(low, high), label = this->label();
  if (std::isnan(low) || std::isnan(high) || low > high || low == infinity)
    throw InvalidArgument(label, text, "low <= high, low finite or open");
  if (high <= 0.0) throw InvalidArgument(label, text, "low <= high, low finite and high > 0");
  const bool open_low = row.kind == LimitKind::sign ? std::isinf(low) : low <= 0.0;
  if (row.sides == LimitSides::only_high && !open_low)
    throw InvalidArgument(label, text, "only a greatest value (max)");
  if (row.sides == LimitSides::only_low && high < infinity)
    throw InvalidArgument(label, text, "only a least value (min)");
  if (row.kind == LimitKind::angle && high < infinity && high > 3.15)
    throw InvalidArgument(label, text, "angles up to 180 degrees, in radians");
  if (of != Unit::length && of != row.of)
    throw InvalidArgument(label, std::string("of = \"") + to_string(of) + "\"",
                          std::string("of = \"length\"") +
                              (row.of == Unit::length ? "" : std::string(" or \"") + to_string(row.of) + "\""));
  if (!axis.allFinite() || (!axis.isZero(0.0) && row.kind != LimitKind::angle))
    throw InvalidArgument(label, "an axis",
                          row.kind == LimitKind::angle ? "three finite numbers" : "none: only cones have one");
  if (*row.needs != '\0' && duty == nullptr) throw InvalidArgument(label, "no duty", std::string("its ") + row.needs);
  if (steps < 1 || steps > most_steps)
    throw InvalidArgument(label, std::to_string(steps) + " steps", "1 to " + std::to_string(most_steps));
  if (at != LimitAt::neutral) return;
  if (row.compares_poses)
    throw InvalidArgument(name + ".at", "\"neutral\"", "\"poses\": the limit is about differences between poses");
  if (row.kind == LimitKind::angle && axis.isZero(0.0))
    throw InvalidArgument(name + ".axis at neutral", "none",
                          "an axis: the angle of a leg from its own neutral direction is zero there");
}

std::vector<ConstraintInfo> constraint_table() {
  return rows_where([](const LimitRow& row) { return row.is_constraint(); });
}

std::vector<ConstraintInfo> criterion_table() {
  return rows_where([](const LimitRow& row) { return row.is_criterion(); });
}

const char* to_string(LimitKind kind) {
  switch (kind) {
    case LimitKind::ratio: return "ratio";
    case LimitKind::length: return "length";
    case LimitKind::angle: return "angle";
    case LimitKind::sign: return "sign";
    case LimitKind::number: return "number";
    case LimitKind::rate: return "rate";
    case LimitKind::power: return "power";
  }
  return "";
}

LimitKind limit_kind_from(const std::string& word) {
  using enum LimitKind;
  for (const LimitKind kind : {ratio, length, angle, sign, number, rate, power})
    if (word == to_string(kind)) return kind;
  throw InvalidArgument("kind", "\"" + word + "\"", "that of a limit, as \"length\"");
}

const char* to_string(Unit unit) {
  switch (unit) {
    case Unit::length: return "length";
    case Unit::zp: return "zp";
    case Unit::radius: return "radius";
  }
  return "";
}

}  // namespace ninedof
