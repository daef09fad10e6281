#pragma once
/// The table of limits: constraints of designs, and criteria of workspaces. One row each: study files, messages,
/// Python, the names of what limits a workspace, and every loop over limits are made from it.

#include <array>
#include <string_view>

#include "limits/design_row.hpp"
#include "limits/pose_row.hpp"
#include "ninedof/limits/limits.hpp"

namespace ninedof {

/// A limit of the longest and the shortest length of a leg over all poses, or of all legs.
struct SpreadRow {
  bool ratio;     ///< their quotient; else their difference
  bool each_leg;  ///< of every leg on its own
};

/// The margin that the optimizer works with, of a value v and a limit.
enum class SolverMargin {
  logarithm,  ///< log(high / v), log(v / low): for positive values
  linear,     ///< 1 - v / high, v / low - 1
  plain       ///< v - low
};

struct LimitRow {
  ConstraintInfo info;
  SolverMargin solver = SolverMargin::logarithm;
  // One of these; none for a criterion of workspaces that is no constraint of designs.
  const PoseRow* pose = nullptr;      ///< a limit at every pose
  const DesignRow* design = nullptr;  ///< of the design alone
  const SpreadRow* spread = nullptr;  ///< over all poses together

  bool is_constraint() const { return pose != nullptr || design != nullptr || spread != nullptr; }
};

inline constexpr SpreadRow leg_ratio_row{true, false}, stroke_ratio_row{true, true}, stroke_row{false, true};

/// Name, kind, sides; unit besides "length", option besides `of` and `at`, low side if none is given, items in a
/// workspace, whether it compares poses.
inline constexpr std::array limit_rows = [] {
  using enum LimitKind;
  using enum LimitSides;
  using enum WorkspaceItems;
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
      of_poses({"stroke_ratio", ratio, only_high, {}, "", 0.0, none, true}, stroke_ratio_row),
      of_design({"zs_fraction", ratio, both}, logarithm, zs_fraction_row),
      of_poses({"stroke", length, only_high, Unit::zp, "", 0.0, none, true}, stroke_row),
      of_pose({"leg_length", length, both, Unit::zp}, logarithm, leg_length_row),
      of_pose({"external_length", length, both, Unit::zp}, logarithm, external_length_row),
      of_pose({"upper_length", length, both, Unit::zp}, logarithm, upper_length_row),
      of_pose({"lower_length", length, both, Unit::zp}, logarithm, lower_length_row),
      of_design({"height", length, both}, logarithm, height_row),
      of_design({"footprint", length, both}, logarithm, footprint_row),
      of_design({"joint_height", length, only_high, Unit::radius}, linear, joint_height_row),
      of_design({"joint_spacing", length, only_low, Unit::radius}, linear, joint_spacing_row),
      LimitRow{{"leg_limits", length, both, {}, "", 0.0, leg_sides}},
      of_pose({"base_cone", angle, only_high, {}, "axis", 0.0, base_legs}, linear, base_cone_row),
      of_pose({"platform_cone", angle, only_high, {}, "axis", 0.0, platform_legs}, linear, platform_cone_row),
      of_pose({"leg_clearance", length, only_low, Unit::zp, "radius", 0.0, pairs_of_legs}, linear, leg_clearance_row),
      LimitRow{{"condition_number", ratio, only_high, {}, "", 0.0, itself}},
      of_pose({"singularity_free", sign, only_low, {}, "steps", 1e-3, determinants}, plain, singularity_free_row),
  };
}();

/// The row of a constraint; throws InvalidArgument for another name.
const LimitRow& limit_row(std::string_view name);

}  // namespace ninedof
