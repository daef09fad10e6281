/// limit_names. Declared in ninedof/workspace/workspace.hpp.

#include <array>

#include "ninedof/workspace/workspace.hpp"
#include "workspace/criteria/limits.hpp"

namespace ninedof {
namespace {

/// Name of item `k` of a criterion.
std::string item_name(const ConstraintInfo& row, int k) {
  const std::string name = std::string(row.name) + " ";
  switch (row.items) {
    case WorkspaceItems::leg_sides: return std::string(leg_name(k % 9)) + (k < 9 ? " low" : " high");
    case WorkspaceItems::base_legs: return name + leg_name(k < 3 ? k : k + 3);
    case WorkspaceItems::platform_legs: return name + leg_name(k);
    case WorkspaceItems::pairs_of_legs: {
      const auto [a, b] = leg_pair(k);
      return name + leg_name(a) + " " + leg_name(b);
    }
    case WorkspaceItems::determinants: return std::array{"det N", "det B", "det C"}[at_index(k)];
    case WorkspaceItems::itself:
    case WorkspaceItems::none: break;
  }
  return row.name;
}

std::vector<std::string> all_names() {
  std::vector<std::string> out;
  for (const ConstraintInfo& row : criterion_table())
    for (int k = 0; k < limit::names_of(row.items); ++k) out.push_back(item_name(row, k));
  for (const char* name : {"region", "box", "internal_point"}) out.emplace_back(name);
  return out;
}

}  // namespace

const std::vector<std::string>& limit_names() {
  static const std::vector<std::string> names = all_names();
  return names;
}

}  // namespace ninedof
