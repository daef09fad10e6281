#pragma once
/// The table of constraints and of the criteria of workspaces: one row each. Study files, messages, Python and the
/// names of what limits a workspace are made from it.

#include <array>
#include <memory>
#include <string_view>

#include "ninedof/problem/constraints.hpp"

namespace ninedof {

class Constraint;
enum class Purpose;

using MakeConstraint = std::unique_ptr<Constraint>(const Limit& limit, int poses, Purpose purpose);

MakeConstraint make_radius_ratio, make_leg_ratio, make_stroke, make_zs_fraction, make_leg_length, make_height,
    make_footprint, make_joint_height, make_joint_spacing, make_leg_clearance, make_joint_cone, make_singularity_free;

struct ConstraintRow {
  ConstraintInfo info;
  MakeConstraint* make = nullptr;  ///< null for a criterion that is no constraint of designs
};

/// Name, kind, sides; unit besides "length", option besides `of` and `at`, low side if none is given, items in a
/// workspace, whether it compares poses.
inline constexpr std::array constraint_rows = [] {
  using enum LimitKind;
  using enum LimitSides;
  using enum WorkspaceItems;
  return std::array{
      ConstraintRow{{"radius_ratio", ratio, both}, make_radius_ratio},
      ConstraintRow{{"leg_ratio", ratio, both}, make_leg_ratio},
      ConstraintRow{{"stroke_ratio", ratio, only_high, {}, "", 0.0, none, true}, make_stroke},
      ConstraintRow{{"zs_fraction", ratio, both}, make_zs_fraction},
      ConstraintRow{{"stroke", length, only_high, Unit::zp, "", 0.0, none, true}, make_stroke},
      ConstraintRow{{"leg_length", length, both, Unit::zp}, make_leg_length},
      ConstraintRow{{"external_length", length, both, Unit::zp}, make_leg_length},
      ConstraintRow{{"upper_length", length, both, Unit::zp}, make_leg_length},
      ConstraintRow{{"lower_length", length, both, Unit::zp}, make_leg_length},
      ConstraintRow{{"height", length, both}, make_height},
      ConstraintRow{{"footprint", length, both}, make_footprint},
      ConstraintRow{{"joint_height", length, only_high, Unit::radius}, make_joint_height},
      ConstraintRow{{"joint_spacing", length, only_low, Unit::radius}, make_joint_spacing},
      ConstraintRow{{"leg_limits", length, both, {}, "", 0.0, leg_sides}},
      ConstraintRow{{"base_cone", angle, only_high, {}, "axis", 0.0, base_legs}, make_joint_cone},
      ConstraintRow{{"platform_cone", angle, only_high, {}, "axis", 0.0, platform_legs}, make_joint_cone},
      ConstraintRow{{"leg_clearance", length, only_low, Unit::zp, "radius", 0.0, pairs_of_legs}, make_leg_clearance},
      ConstraintRow{{"condition_number", ratio, only_high, {}, "", 0.0, itself}},
      ConstraintRow{{"singularity_free", sign, only_low, {}, "steps", 1e-3, determinants}, make_singularity_free},
  };
}();

}  // namespace ninedof
