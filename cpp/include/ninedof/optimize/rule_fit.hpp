#pragma once
/// A rule for O that is nearly as good as O placed anew at every pose of a region.

#include <functional>
#include <string>
#include <vector>

#include "ninedof/optimize/region_placement.hpp"
#include "ninedof/proof/machine.hpp"

namespace ninedof {

/// A design, and what O has to reach at every pose of its region.
struct RuleTask {
  PosedRobot machine;         ///< with a region, without a rule
  Problem problem;            ///< without poses of its own: its index and its limits
  Eigen::VectorXd variables;  ///< of the machine, a full set of the problem
  PlacementGoal goal;         ///< of O placed anew, with ranges where limits compare poses
  std::vector<Vec3> known;    ///< shifts of O in zp that are good at some poses
};

struct RuleSettings {
  int threads = 0;  ///< 0: one per processor
  std::function<void(const std::string&)> phase;  ///< called on this thread with words for what begins
};

/// Fits a polynomial of the lowest degree that is good, and mends it where proofs of its limits fail.
///
/// Polynomials of rising degree are fitted to the best O of sampled poses. Then the worst of the index and of all
/// limits over these poses is lowered: it is smoothed, and Gauss-Newton steps go down with less and less smoothing.
/// Poses join where `limits_over_poses` and `worst_condition` meet what is worst by the rule. The rule does not depend
/// on the number of threads, as long as each of these proofs ends within seconds. Nothing of the rule is proved: proofs
/// take it as PosedRobot::rule. Throws InvalidArgument for a task that does not fit, Stopped on a stop.
PointRule fit_rule(const RuleTask& task, const RuleSettings& settings = {}, const Control& control = {});

}  // namespace ninedof
