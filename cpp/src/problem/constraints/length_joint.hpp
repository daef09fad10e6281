#pragma once
/// The kink of the characteristic length "platform_radius", the largest of several distances.
///
/// The designs where one platform joint k is the farthest are one smooth piece of the problem: l_c is the distance of
/// k, and no other distance is larger. The pieces meet where distances tie. A design there is a minimum if it is one of
/// every piece it belongs to.

#include "problem/constraints/solver_rows.hpp"

namespace ninedof {

/// Platform joints, one for each distance that differs in some of `designs`.
std::vector<int> joints_of_distinct_distance(const std::vector<DesignState>& designs);

/// No joint of `joints` is farther than DesignState::length_joint; no limit where that is -1.
std::unique_ptr<SolverRows> make_length_joint(std::vector<int> joints);

}  // namespace ninedof
