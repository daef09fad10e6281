#include "ninedof/optimize/optimize.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"
#include "optimize/verdict.hpp"

namespace ninedof {
namespace {

/// Relative difference of objectives by which a design that is no optimum puts the best optimum in doubt.
constexpr double worth_saying = 1e-6;

double next_size(const std::vector<double>& sizes, double cap) {
  return *std::upper_bound(sizes.begin(), sizes.end(), cap);
}

/// The leader with what stands on the cap moved to the next one.
Eigen::VectorXd stretched(const Prepared& p, const Leader& l, double next) {
  Eigen::VectorXd x = l.best.variables;
  for (int k = 0; k < p.coordinates.size(); ++k) {
    double& value = x[p.coordinates.variable(k)];
    const bool sized = p.coordinates.info(k).kind != VariableKind::angle && !p.coordinates.info(k).ours;
    if (sized && std::abs(std::abs(value) - l.cap) <= 1e-3 * l.cap) value *= next / l.cap;
  }
  return x;
}

Result interrupted(Result result) {
  result.status = Status::stopped;
  result.interrupted = true;
  result.reason = "interrupted after " + std::to_string(result.starts_done) + " starts; " +
                  (result.candidates.empty() ? "no design yet" : "the best so far is returned");
  return result;
}

}  // namespace

Result optimize(const Problem& problem, const Settings& settings, const Control& control) {
  problem.validate();
  settings.validate();
  for (const Eigen::VectorXd& x : settings.warm) require_full("warm", problem, x);
  Result result;
  if (judge_order(problem, result)) return result;
  const std::vector<double> sizes = caps(problem);
  const int starts_a_round = start_count(Prepared(problem, sizes.front()), settings);
  Progress progress(control, starts_a_round * static_cast<int>(sizes.size()));
  std::vector<Leader> leaders;
  std::optional<Candidate> unsettled;  // the best design allowed, optimum or not
  std::vector<Eigen::VectorXd> further;
  for (const double cap : sizes) {
    const Prepared p(problem, cap);
    const Round round = run_round(p, cap, further, settings, control, progress);
    result.evaluations += round.evaluations;
    result.starts_done += round.done;
    result.stopped_early += round.stopped_early;
    std::vector<Candidate> candidates = distinct(p, round);
    if (!candidates.empty()) {
      leaders.push_back(leader(p, cap, candidates.front()));
      const bool better =
          result.candidates.empty() || candidates.front().objective <= result.candidates.front().objective;
      if (better) {
        result.candidates = std::move(candidates);
        result.followed = round.done - round.stopped_early;
      }
      // A larger size must not do worse for want of luck: the best so far starts there too, as it is and stretched.
      further = {leaders.back().best.variables};
      if (cap < sizes.back()) further.push_back(stretched(p, leaders.back(), next_size(sizes, cap)));
    }
    if (std::optional<Candidate> best = best_allowed(round))
      if (!unsettled || best->objective < unsettled->objective) unsettled = std::move(best);
    if (control.stop.stop_requested()) {
      if (result.candidates.empty() && unsettled) result.candidates.push_back(*std::move(unsettled));
      return interrupted(std::move(result));
    }
    if (cap == sizes.back() && leaders.empty()) explain_failure(p, round, settings, control, result);
  }
  if (control.stop.stop_requested()) return interrupted(std::move(result));
  if (leaders.empty()) return result;
  result.status = Status::optimal;
  result.reason = "feasible and stationary by our own checks";
  judge_unbounded(problem, leaders, result);
  if (result.status == Status::optimal && unsettled &&
      unsettled->objective < result.candidates.front().objective * (1.0 - worth_saying)) {
    result.status = Status::stopped;
    result.reason =
        "a better design than every optimum found is allowed, but is no optimum itself: the objective may still fall "
        "from there, or have no least value; look at which variables stand next to a bound";
    result.candidates.insert(result.candidates.begin(), *std::move(unsettled));
  }
  return result;
}

Trace trace(const Problem& problem, const Eigen::VectorXd& start, Formulation formulation, const Settings& settings) {
  problem.validate();
  settings.validate();
  const Prepared p(problem, caps(problem).back());
  require_full("start", problem, start);
  Trace out;
  const auto observe = [&](double log_objective, double violation) {
    const double last = out.best.empty() ? infinity : out.best.back();
    const double now = violation <= clearly_allowed ? std::exp(log_objective) : last;
    out.best.push_back(std::min(last, now));
  };
  out.end =
      minimise(p, p.coordinates.coordinates(start), formulation, Effort{settings.max_evaluations}, {}, observe).end;
  return out;
}

Eigen::MatrixXd starts(const Problem& problem, const Settings& settings) {
  problem.validate();
  settings.validate();
  const Prepared p(problem, caps(problem).back());
  Eigen::MatrixXd out(static_cast<Eigen::Index>(problem.names().size()), settings.starts);
  for (int k = 0; k < settings.starts; ++k) out.col(k) = p.coordinates.variables(p.coordinates.start(k, settings.seed));
  return out;
}

}  // namespace ninedof
