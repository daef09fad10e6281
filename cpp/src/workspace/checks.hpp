#pragma once
/// Checks of the arguments of a workspace.

#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

/// Throws InvalidArgument naming the argument that is not valid.
void require_workspace(const WorkspaceDomain& domain, const InternalPointRule& rule, const WorkspaceCriteria& criteria,
                       const WorkspaceSettings& settings, const std::optional<Configuration>& home);

}  // namespace ninedof
