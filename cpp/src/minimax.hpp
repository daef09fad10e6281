#pragma once
/// One run of the minimax problem from one start, and our own judgement of a point.

#include "coordinates.hpp"

namespace ninedof {

/// A problem made ready: coordinates and margins worked out once, shared by all starts.
struct Prepared {
  Prepared(const Problem& problem, double cap);

  Problem problem;
  const DesignFamily* family;
  std::vector<Margin> margins;
  Coordinates coordinates;
};

/// Condition number, violation, stationarity and active names at a point, from the design's own quantities.
Candidate judge(const Prepared& p, const Eigen::VectorXd& x);


struct Run {
  Candidate end;
  long evaluations = 0;
};

/// SLSQP on the smooth minimax problem, restarted warm until our own checks pass or nothing improves.
Run minimise(const Prepared& p, const Eigen::VectorXd& start, Formulation formulation, int max_evaluations,
             const std::stop_token& stop, const std::function<void(const DesignPoint&, double violation)>& observer = {});

/// Least achievable violation from one start: minimise t with every margin >= -t. Returns the point and its judgement.
Run least_violation(const Prepared& p, const Eigen::VectorXd& start, int max_evaluations, const std::stop_token& stop);

}  // namespace ninedof
