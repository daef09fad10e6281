#pragma once
/// What a question about a workspace must be, whichever way it is answered.

#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

/// Throws InvalidArgument naming the argument that is not valid.
void require_question(const WorkspaceDomain& domain, const InternalPointRule& rule, const WorkspaceCriteria& criteria,
                      const std::optional<Configuration>& home);

/// The same for criteria alone.
void require_criteria(const WorkspaceCriteria& criteria);

}  // namespace ninedof
