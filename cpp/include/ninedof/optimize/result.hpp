#pragma once
/// What an optimization returns: its status and the distinct local optima found.

#include <Eigen/Core>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace ninedof {

/// How an optimization ended.
enum class Status {
  optimal,     ///< feasible and stationary by independent checks of the point
  unbounded,   ///< the objective keeps falling as the named variables grow; there is no optimum
  infeasible,  ///< no design found satisfies the named limits and bounds together
  stopped,     ///< interrupted, or no start passed the checks; the best point found is returned as such
};

/// The word for a status: "optimal", "unbounded", "infeasible", "stopped".
const char* to_string(Status status);

/// A local optimum and the results of its checks.
struct Candidate {
  Eigen::VectorXd variables;  ///< a full set, see Problem::names
  double objective = std::numeric_limits<double>::infinity();
  double condition_number = std::numeric_limits<double>::infinity();  ///< at the neutral configuration, 2-norm
  std::vector<double> conditions;                                     ///< at each evaluated pose, 2-norm
  double characteristic_length = 1.0;
  double optimality_residual = std::numeric_limits<double>::infinity();   ///< see Stationarity in active_set.hpp
  double constraint_violation = std::numeric_limits<double>::infinity();  ///< largest negative margin; 0 if none
  std::vector<std::string> active;                                        ///< active bounds and constraints, by name
  /// Shadow prices: per cent by which the objective falls, to first order, when a limit or bound is relaxed by one per
  /// cent. Only of what is active; a bound at zero has none.
  std::map<std::string, double> prices;
  bool singular = true;  ///< at some evaluated pose
  int reached = 0;  ///< starts, warm ones aside, that ended at this objective

  bool feasible() const { return constraint_violation <= 1e-8; }
  bool regular() const { return !singular; }
  bool stationary() const { return optimality_residual <= 1e-6; }
};

struct Result {
  Status status = Status::stopped;
  std::string reason;  ///< one sentence
  std::vector<std::string> causes;  ///< variables or constraints behind `unbounded` or `infeasible`
  std::vector<int> cause_poses;  ///< of `infeasible`: the poses of the objective that exclude each other with these
  std::vector<Candidate>
      candidates;  ///< distinct local optima, up to relabelling, best first; empty if nothing acceptable was found
  long evaluations = 0;  ///< designs evaluated by SLSQP, over all starts and rounds
  int starts_done = 0;
  int runs_abandoned = 0;  ///< starts given up after a short run that promised little
  int runs_completed = 0;  ///< starts, warm ones aside, run to their end in the round that found the best design
  bool interrupted = false;  ///< by Control::stop
};

}  // namespace ninedof
