#pragma once
/// A workspace that is asked for, for every way to answer it.

#include <optional>

#include "ninedof/workspace/workspace.hpp"

namespace ninedof::python {

struct WorkspaceQuestion {
  Geometry geometry;
  WorkspaceDomain domain;
  InternalPointRule rule;
  WorkspaceCriteria criteria;
  std::optional<Configuration> home;
};

}  // namespace ninedof::python
