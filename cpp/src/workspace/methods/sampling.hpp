#pragma once
/// Workspaces from points alone: a grid of cells judged by their centres, and shifted low-discrepancy samples.

#include "workspace/criteria/limits_at_points.hpp"

namespace ninedof {

void map_by_grid(const LimitsAtPoints& margins, const WorkspaceSettings& settings, bool first_piece_alone,
                 const Control& control, WorkspaceMap& map);
void map_by_sample(const LimitsAtPoints& margins, const WorkspaceSettings& settings, const Control& control,
                   WorkspaceMap& map);

}  // namespace ninedof
