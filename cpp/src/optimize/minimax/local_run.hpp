#pragma once
/// One run from one start, and the independent check of a point.

#include "optimize/minimax/subproblem.hpp"

namespace ninedof {

/// Objective, violation, stationarity and active names at a point.
Candidate candidate_at(const PreparedProblem& p, const Eigen::VectorXd& y);

struct LocalRun {
  Candidate end;
  long evaluations = 0;
};

/// How long a run continues.
struct RunSettings {
  int max_evaluations = 500;  ///< of one SLSQP call
  int restarts = 3;
  bool polish = true;  ///< by Newton's method
};

/// SLSQP, restarted until the checks pass or nothing improves, then polished. `start` in solver coordinates.
LocalRun run_from_start(const PreparedProblem& p, const Eigen::VectorXd& start, Formulation formulation,
                        const RunSettings& run_settings, const std::stop_token& stop, const Observer& observer = {});

}  // namespace ninedof
