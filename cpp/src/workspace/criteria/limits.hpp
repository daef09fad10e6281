#pragma once
/// The criteria of a workspace with their rows, and the numbers of what may end it: indices into limit_names(), which
/// has the legs, the items of the other criteria in the order of their table, the region, the box and the search for O.

#include <vector>

#include "limits/table.hpp"
#include "ninedof/workspace/workspace.hpp"

namespace ninedof {

/// A limit at a pose, or of the condition number, which no row of a pose is about.
struct PoseCriterion {
  const LimitRow* row;
  double low, high;  ///< infinite where that side is open
  LimitOptions options;
  int name;  ///< number of its first item
};

/// All criteria but the limits of the legs, in the order of their table.
std::vector<PoseCriterion> criteria_besides_legs(const WorkspaceCriteria& criteria);

/// Whether poses also have to be connected with home.
bool asks_for_connection(const WorkspaceCriteria& criteria);

namespace limit {

constexpr int leg_low = 0, leg_high = 9;
inline int count() {
  return static_cast<int>(limit_names().size());
}
inline int region() {
  return count() - 3;
}
inline int box() {
  return count() - 2;
}
inline int internal_point() {
  return count() - 1;
}

}  // namespace limit
}  // namespace ninedof
