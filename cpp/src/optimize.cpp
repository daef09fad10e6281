#include "ninedof/optimize.hpp"

#include <algorithm>
#include <cmath>

#include "verdict.hpp"

namespace ninedof {

Result optimize(const Problem& problem, const Settings& settings, const Control& control) {
  problem.validate();
  settings.validate();
  Result result;
  if (judge_order(problem, result)) return result;
  const std::vector<double> sizes = caps(problem);
  const int starts_a_round = start_count(Prepared(problem, sizes.front()), settings);
  Progress progress(control, starts_a_round * static_cast<int>(sizes.size()));
  std::vector<Leader> leaders;
  for (const double cap : sizes) {
    const Prepared p(problem, cap);
    const Round round = run_round(p, settings, control, progress);
    result.evaluations += round.evaluations;
    result.starts_done += round.done;
    std::vector<Candidate> candidates = distinct(p, round);
    if (!candidates.empty()) {
      leaders.push_back(leader(p, cap, candidates.front()));
      const bool better = result.candidates.empty() ||
                          candidates.front().condition_number <= result.candidates.front().condition_number;
      if (better) result.candidates = std::move(candidates);
    }
    if (control.stop.stop_requested()) {
      result.interrupted = true;
      result.reason =
          "interrupted after " + std::to_string(result.starts_done) + " starts; the best so far is returned";
      if (result.candidates.empty())
        if (std::optional<Candidate> best = best_allowed(round)) result.candidates.push_back(*std::move(best));
      return result;
    }
    if (cap == sizes.back() && leaders.empty()) explain_failure(p, round, settings, control, result);
  }
  if (leaders.empty()) return result;
  result.status = Status::optimal;
  result.reason = "feasible and stationary by our own checks";
  judge_unbounded(problem, leaders, result);
  return result;
}

Trace trace(const Problem& problem, const Eigen::VectorXd& start, Formulation formulation, const Settings& settings) {
  problem.validate();
  settings.validate();
  const Prepared p(problem, caps(problem).back());
  if (start.size() != static_cast<Eigen::Index>(problem.variables.size()) || !start.allFinite())
    throw InvalidArgument("start", std::to_string(start.size()) + " values",
                          std::to_string(problem.variables.size()) + " finite ones, one for each variable");
  Trace out;
  const auto observe = [&](const DesignPoint& point, double violation) {
    const double last = out.best.empty() ? std::numeric_limits<double>::infinity() : out.best.back();
    const double now = violation <= clearly_allowed ? std::exp(point.log_condition_number()) : last;
    out.best.push_back(std::min(last, now));
  };
  out.end = minimise(p, p.coordinates.coordinates(start), formulation, settings.max_evaluations, {}, observe).end;
  return out;
}

Eigen::MatrixXd starts(const Problem& problem, const Settings& settings) {
  problem.validate();
  settings.validate();
  const Prepared p(problem, caps(problem).back());
  Eigen::MatrixXd out(static_cast<Eigen::Index>(problem.variables.size()), settings.starts);
  for (int k = 0; k < settings.starts; ++k) out.col(k) = p.coordinates.variables(p.coordinates.start(k, settings.seed));
  return out;
}

}  // namespace ninedof
