#include "ninedof/optimize/trace.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/verdict.hpp"

namespace ninedof {

Trace trace(const Problem& problem, const Eigen::VectorXd& start, Formulation formulation, const Settings& settings,
            const std::stop_token& stop) {
  problem.validate();
  settings.validate();
  const PreparedProblem p(problem, size_limits(problem).back());
  require_full("start", problem, start);
  Trace out;
  const auto observe = [&](double log_objective, double violation) {
    const double last = out.best.empty() ? infinity : out.best.back();
    const double now = violation <= clearly_feasible ? std::exp(log_objective) : last;
    out.best.push_back(std::min(last, now));
  };
  const RunSettings run_settings{settings.max_evaluations};
  out.end = run_from_start(p, p.coordinates.coordinates(start), formulation, run_settings, stop, observe).end;
  if (stop.stop_requested()) throw Stopped{};
  return out;
}

}  // namespace ninedof
