#pragma once
/// The poses at which limits exclude each other.

#include "ninedof/optimize/optimize.hpp"

namespace ninedof {

/// Where `result` says that limits exclude each other, its reason names the poses, and `poses`, those of the problem
/// behind the first `listed` ones, keeps these alone.
void name_conflict(Result& result, std::size_t listed, std::vector<Pose>& poses);

}  // namespace ninedof
