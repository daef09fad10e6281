#pragma once
/// The designs that a study of the family "symmetric_nonplanar" allows, as limits and a box of the coordinates.

#include <string>

#include "ninedof/problem/problem.hpp"
#include "proof/nonplanar/line_design.hpp"

namespace ninedof::proof {

/// Limits that are left out are named. Throws InvalidArgument where the theory does not reach the study.
LineLimits line_limits(const Problem& study, std::vector<std::string>& left_out);

/// Contains every design that keeps the limits with a condition number below `target`, up to mirror images; where an
/// end exceeds the other there is none.
LineBox line_box(const LineLimits& limits, double target);

}  // namespace ninedof::proof
