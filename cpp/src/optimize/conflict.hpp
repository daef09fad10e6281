#pragma once
/// Which limits and bounds exclude each other where no design satisfies all.

#include <string_view>

#include "optimize/search_round.hpp"

namespace ninedof {

/// Where the reason is about poses; a study over a region says which.
inline constexpr std::string_view in_these_poses = "in these poses";

struct Conflict {
  std::vector<std::string> causes;  ///< names of limits and variables, each once
  std::vector<int> poses;           ///< of the objective, where the nearest design violates them
  std::string reason;               ///< a sentence
  Eigen::VectorXd allowed;          ///< full variables of a design that satisfies all, if one was found after all
  long evaluations = 0;
};

/// Limits and bounds of `problem` that no design found satisfies together, while for each of them there is a design
/// that satisfies all the others named; and how far each would have to give. `ends` are designs of a search that
/// failed. On a stop, nothing.
Conflict find_conflict(const Problem& problem, const std::vector<Eigen::VectorXd>& ends, const Settings& settings,
                       const Control& control);

}  // namespace ninedof
