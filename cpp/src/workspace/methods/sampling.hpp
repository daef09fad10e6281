#pragma once
/// Workspaces from points alone: a grid of cells judged by their centres, and shifted low-discrepancy samples.

#include "workspace/criteria/pose_margins.hpp"

namespace ninedof {

void map_by_grid(const Margins& margins, const WorkspaceSettings& settings, bool first_piece_alone,
                 const Control& control, WorkspaceMap& map);
void map_by_sample(const Margins& margins, const WorkspaceSettings& settings, const Control& control,
                   WorkspaceMap& map);

}  // namespace ninedof
