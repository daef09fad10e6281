#pragma once
/// What a workspace must be asked for.

#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

/// Throws InvalidArgument naming the argument that makes no sense.
void require_workspace(const WorkspaceDomain& domain, const InternalPointRule& rule, const WorkspaceCriteria& criteria,
                       const WorkspaceSettings& settings, const std::optional<Configuration>& home);

}  // namespace ninedof
