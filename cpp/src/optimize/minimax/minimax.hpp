#pragma once
/// One run from one start, and our own judgement of a point.

#include "optimize/minimax/subproblem.hpp"

namespace ninedof {

/// Objective, violation, stationarity and active names at a point.
Candidate judge(const Prepared& p, const Eigen::VectorXd& y);

struct Run {
  Candidate end;
  long evaluations = 0;
};

/// How far a run is taken.
struct Effort {
  int max_evaluations = 500;  ///< of one SLSQP call
  int restarts = 3;
  bool polished = true;
};

/// SLSQP, restarted warm until our own checks pass or nothing improves, then polished. `start` in solver coordinates.
Run minimise(const Prepared& p, const Eigen::VectorXd& start, Formulation formulation, const Effort& effort,
             const std::stop_token& stop, const Observer& observer = {});

/// The least violation reachable from a start, and the variables and constraints that hold it there.
struct Violation {
  Candidate end;
  std::vector<std::string> causes;
  long evaluations = 0;
};
Violation least_violation(const Prepared& p, const Eigen::VectorXd& start, int max_evaluations,
                          const std::stop_token& stop);

}  // namespace ninedof
