#pragma once
/// Numbers of what may end a workspace, as indices into limit_names(): the items of the criteria in the order of their
/// table, then the region, the box and the search for O.

#include "limits/table.hpp"
#include "robot/leg_pairs.hpp"

namespace ninedof::limit {

/// How many names the items of a criterion have.
constexpr int names_of(WorkspaceItems items) {
  switch (items) {
    case WorkspaceItems::none: return 0;
    case WorkspaceItems::leg_sides: return 18;
    case WorkspaceItems::base_legs:
    case WorkspaceItems::platform_legs: return 6;
    case WorkspaceItems::pairs_of_legs: return leg_pairs;
    case WorkspaceItems::itself: return 1;
    case WorkspaceItems::determinants: return 3;
  }
  return 0;
}

/// How many margins they have at a pose: a leg has one for both sides, and only the closest pair of legs has one.
constexpr int margins_of(WorkspaceItems items) {
  return items == WorkspaceItems::leg_sides ? 9 : items == WorkspaceItems::pairs_of_legs ? 1 : names_of(items);
}

/// The sum of `count` over the criteria before one; over all of them for "".
consteval int sum_before(int (*count)(WorkspaceItems), std::string_view criterion = "") {
  int sum = 0;
  for (const LimitRow& row : limit_rows) {
    if (row.info.name == criterion) return sum;
    sum += count(row.info.items);
  }
  if (!criterion.empty()) throw "no such criterion";
  return sum;
}

constexpr int leg_low = sum_before(names_of, "leg_limits"), leg_high = leg_low + 9;
constexpr int base_cone = sum_before(names_of, "base_cone"), platform_cone = sum_before(names_of, "platform_cone");
constexpr int clearance = sum_before(names_of, "leg_clearance");
constexpr int condition_number = sum_before(names_of, "condition_number");
constexpr int determinants = sum_before(names_of, "singularity_free");
constexpr int region = sum_before(names_of), box = region + 1, internal_point = region + 2, count = region + 3;

}  // namespace ninedof::limit
