#pragma once
/// The table of limits: constraints of designs, and criteria of workspaces. One row each: study files, messages,
/// Python, the names of what limits a workspace, and every loop over limits are made from it.

#include <span>
#include <string_view>

#include "limits/design_row.hpp"
#include "limits/margins.hpp"
#include "limits/pose_row.hpp"
#include "ninedof/limits/limits.hpp"
#include "ninedof/limits/spread_row.hpp"

namespace ninedof {

struct LimitRow {
  ConstraintInfo info;
  SolverMargin solver = SolverMargin::logarithm;
  // One of these; none for a criterion of workspaces that is no constraint of designs.
  const PoseRow* pose = nullptr;      ///< a limit at every pose
  const DesignRow* design = nullptr;  ///< of the design alone
  const SpreadRow* spread = nullptr;  ///< over all poses together

  bool is_constraint() const { return pose != nullptr || design != nullptr || spread != nullptr; }
  /// Workspaces have limits of every leg in place of those of lengths.
  bool is_criterion() const { return pose != nullptr ? pose->first_leg < 0 : !is_constraint(); }
  bool on_the_way() const { return pose != nullptr && pose->on_the_way; }
};

/// The criterion of workspaces that gives every leg a range of lengths of its own.
inline constexpr const char* leg_limits_name = "leg_limits";

/// The table, in the order in which limits are listed.
std::span<const LimitRow> limit_rows();

/// The row of a constraint; throws InvalidArgument for another name.
const LimitRow& limit_row(std::string_view name);

/// The row of a limit that has a value at every pose; throws InvalidArgument for `argument` of another name.
const PoseRow& pose_row(const char* argument, std::string_view name);

/// The limit of the lengths of all nine legs.
const LimitRow& leg_length_limit();

/// The limit of the angles at all six joints of a body.
const LimitRow& joint_cone_limit(bool platform);

}  // namespace ninedof
