#pragma once
/// The rows of the table of limits, in its order.

#include <array>

#include "limits/table.hpp"

namespace ninedof {

extern const PoseRow leg_length_row, external_length_row, upper_length_row, lower_length_row, base_cone_row,
    platform_cone_row, base_cone_external_row, base_cone_internal_row, platform_cone_external_row,
    platform_cone_internal_row, leg_clearance_row, singularity_free_row, fault_tolerant_row, force_row, rate_row,
    power_row, external_force_row, upper_force_row, lower_force_row, external_rate_row, upper_rate_row, lower_rate_row;
extern const DesignRow radius_ratio_row, zs_fraction_row, height_row, footprint_row, joint_height_row,
    joint_spacing_row;
inline constexpr SpreadRow leg_ratio_row{true, false}, stroke_ratio_row{true, true}, stroke_row{false, true};

/// Name, kind, sides; unit besides "length", option besides `of` and `at`, low side if none is given, whether it
/// compares poses, what of a Duty it needs.
inline constexpr std::array known_limits = [] {
  using enum LimitKind;
  using enum LimitSides;
  using enum SolverMargin;
  const auto of_pose = [](const ConstraintInfo& info, SolverMargin solver, const PoseRow& row) {
    return LimitRow{info, solver, &row, nullptr, nullptr};
  };
  const auto of_design = [](const ConstraintInfo& info, SolverMargin solver, const DesignRow& row) {
    return LimitRow{info, solver, nullptr, &row, nullptr};
  };
  const auto of_poses = [](const ConstraintInfo& info, const SpreadRow& row) {
    return LimitRow{info, row.ratio ? logarithm : linear, nullptr, nullptr, &row};
  };
  return std::array{
      of_design({"radius_ratio", ratio, both}, logarithm, radius_ratio_row),
      of_poses({"leg_ratio", ratio, both}, leg_ratio_row),
      of_poses({"stroke_ratio", ratio, only_high, {}, "", 0.0, true}, stroke_ratio_row),
      of_design({"zs_fraction", ratio, both}, logarithm, zs_fraction_row),
      of_poses({"stroke", length, only_high, Unit::zp, "", 0.0, true}, stroke_row),
      of_pose({"leg_length", length, both, Unit::zp}, logarithm, leg_length_row),
      of_pose({"external_length", length, both, Unit::zp}, logarithm, external_length_row),
      of_pose({"upper_length", length, both, Unit::zp}, logarithm, upper_length_row),
      of_pose({"lower_length", length, both, Unit::zp}, logarithm, lower_length_row),
      of_design({"height", length, both}, logarithm, height_row),
      of_design({"footprint", length, both}, logarithm, footprint_row),
      of_design({"joint_height", length, only_high, Unit::radius}, linear, joint_height_row),
      of_design({"joint_spacing", length, only_low, Unit::radius}, linear, joint_spacing_row),
      LimitRow{{leg_limits_name, length, both}},
      of_pose({"base_cone", angle, only_high, {}, "axis"}, linear, base_cone_row),
      of_pose({"platform_cone", angle, only_high, {}, "axis"}, linear, platform_cone_row),
      of_pose({"base_cone_external", angle, only_high, {}, "axis"}, linear, base_cone_external_row),
      of_pose({"base_cone_internal", angle, only_high, {}, "axis"}, linear, base_cone_internal_row),
      of_pose({"platform_cone_external", angle, only_high, {}, "axis"}, linear, platform_cone_external_row),
      of_pose({"platform_cone_internal", angle, only_high, {}, "axis"}, linear, platform_cone_internal_row),
      of_pose({"leg_clearance", length, only_low, Unit::zp, "radius"}, linear, leg_clearance_row),
      LimitRow{{"condition_number", ratio, only_high}},
      of_pose({"singularity_free", sign, only_low, {}, "steps", 1e-3}, plain, singularity_free_row),
      of_pose({"fault_tolerant", ratio, only_high}, logarithm, fault_tolerant_row),
      of_pose({"force", number, only_high, {}, "", 0.0, false, "loads"}, mixed, force_row),
      of_pose({"rate", rate, only_high, {}, "", 0.0, false, "speeds"}, mixed, rate_row),
      of_pose({"power", power, only_high, {}, "", 0.0, false, "loads speeds"}, mixed, power_row),
      of_pose({"external_force", number, only_high, {}, "", 0.0, false, "loads"}, mixed, external_force_row),
      of_pose({"upper_force", number, only_high, {}, "", 0.0, false, "loads"}, mixed, upper_force_row),
      of_pose({"lower_force", number, only_high, {}, "", 0.0, false, "loads"}, mixed, lower_force_row),
      of_pose({"external_rate", rate, only_high, {}, "", 0.0, false, "speeds"}, mixed, external_rate_row),
      of_pose({"upper_rate", rate, only_high, {}, "", 0.0, false, "speeds"}, mixed, upper_rate_row),
      of_pose({"lower_rate", rate, only_high, {}, "", 0.0, false, "speeds"}, mixed, lower_rate_row),
  };
}();

}  // namespace ninedof
