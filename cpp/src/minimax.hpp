#pragma once
/// One run from one start, and our own judgement of a point.

#include <functional>

#include "prepared.hpp"

namespace ninedof {

/// Condition number, violation, stationarity and active names at a point, from the design's own quantities.
Candidate judge(const Prepared& p, const Eigen::VectorXd& y);

/// Violation up to which a design on the way counts as allowed: well inside what Candidate::feasible grants, so that the
/// little it gains in the index is rounding.
constexpr double clearly_allowed = 1e-9;

struct Run {
  Candidate end;
  long evaluations = 0;
};

/// Called with each design a run looks at and its violation.
using Observer = std::function<void(const DesignPoint&, double)>;

/// SLSQP, restarted warm until our own checks pass or nothing improves, then polished. `start` in solver coordinates.
Run minimise(const Prepared& p, const Eigen::VectorXd& start, Formulation formulation, int max_evaluations,
             const std::stop_token& stop, const Observer& observer = {});

/// The least violation reachable from a start, and the variables and constraints that hold it there.
struct Violation {
  Candidate end;
  std::vector<std::string> causes;
  long evaluations = 0;
};

/// Minimises t >= 0 with every margin >= -t.
Violation least_violation(const Prepared& p, const Eigen::VectorXd& start, int max_evaluations,
                          const std::stop_token& stop);

}  // namespace ninedof
