#include "ninedof/optimize/optimize.hpp"

#include <algorithm>
#include <cmath>

#include "math/slsqp.hpp"
#include "math/time_limit.hpp"
#include "ninedof/math/error.hpp"
#include "optimize/verdict.hpp"

namespace ninedof {
namespace {

/// The best design of a round with variables at the size limit moved to the next one.
Eigen::VectorXd stretched(const PreparedProblem& p, const RoundBest& round, double next) {
  Eigen::VectorXd x = round.best.variables;
  for (int k = 0; k < p.coordinates.size(); ++k) {
    double& value = x[p.coordinates.variable(k)];
    const bool sized = p.coordinates.info(k).kind != VariableKind::angle && !p.coordinates.info(k).internal_bounds;
    if (sized && std::abs(std::abs(value) - round.size_limit) <= 1e-3 * round.size_limit)
      value *= next / round.size_limit;
  }
  return x;
}

/// Stopped by the caller or by the clock.
Result ended(Result result, bool interrupted) {
  result.status = Status::stopped;
  result.interrupted = interrupted;
  result.reason = interrupted ? "interrupted after " : "out of time after ";
  result.reason += std::to_string(result.starts_done);
  result.reason += result.candidates.empty() ? " starts; no design yet" : " starts; the best so far is returned";
  return result;
}

}  // namespace

std::string solver_version() {
  return slsqp_version();
}

void Settings::validate() const {
  const int least = warm.empty() ? 1 : 0;
  if (starts < least) throw InvalidArgument("starts", std::to_string(starts), "at least " + std::to_string(least));
  if (!(time_limit > 0.0)) throw InvalidArgument("time_limit", format_number(time_limit), "seconds, more than 0");
  if (max_evaluations < 1) throw InvalidArgument("max_evaluations", std::to_string(max_evaluations), "at least 1");
}

Result optimize(const Problem& problem, const Settings& settings, const Control& caller) {
  problem.validate();
  settings.validate();
  const TimeLimit limit(settings.time_limit, caller.stop);
  const Control control{limit.stop(), caller.progress};
  for (const Eigen::VectorXd& x : settings.warm) require_full("warm", problem, x);
  Result result;
  if (detect_impossible_heights(problem, result)) return result;
  const std::vector<double> sizes = size_limits(problem);
  const int starts_a_round = start_count(PreparedProblem(problem, sizes.front()), settings);
  Progress progress(control, starts_a_round * static_cast<int>(sizes.size()));
  std::vector<RoundBest> round_bests;
  std::optional<Candidate> best_design;  // feasible, stationary or not
  std::vector<Eigen::VectorXd> further;
  for (const double size_limit : sizes) {
    const PreparedProblem p(problem, size_limit);
    SearchRound round;
    std::vector<Candidate> candidates;
    for (bool more = true; more;) {
      run_batch(p, size_limit, further, settings, control, progress, round);
      candidates = distinct_candidates(p, round);
      const bool at_limit = !candidates.empty() && round_best(p, size_limit, candidates.front()).at_size_limit;
      more = p.coordinates.size() > 0 && settings.starts > 1 && round.batches < Settings::most_batches && !at_limit &&
             starts_disagree(round, candidates) && !control.stop.stop_requested();
      if (more) progress.expect(settings.starts);
    }
    result.evaluations += round.evaluations;
    result.starts_done += round.done;
    result.runs_abandoned += round.runs_abandoned;
    if (!candidates.empty()) {
      round_bests.push_back(round_best(p, size_limit, candidates.front()));
      const bool better =
          result.candidates.empty() || candidates.front().objective <= result.candidates.front().objective;
      if (better) {
        discount_warm(p, round, candidates);
        result.candidates = std::move(candidates);
        result.runs_completed = std::max(0, round.done - round.runs_abandoned - round.warm);
      }
      // A larger size limit must not give a worse result by chance: the best design starts there too, also stretched.
      further = {round_bests.back().best.variables};
      if (size_limit < sizes.back())
        further.push_back(stretched(p, round_bests.back(), *std::ranges::upper_bound(sizes, size_limit)));
    }
    if (std::optional<Candidate> best = best_feasible(round))
      if (!best_design || best->objective < best_design->objective) best_design = std::move(best);
    if (control.stop.stop_requested()) {
      if (result.candidates.empty() && best_design) result.candidates.push_back(*std::move(best_design));
      return ended(std::move(result), caller.stop.stop_requested());
    }
    if (size_limit == sizes.back() && round_bests.empty()) explain_failure(p, round, settings, control, result);
  }
  if (control.stop.stop_requested()) return ended(std::move(result), caller.stop.stop_requested());
  if (round_bests.empty()) return result;
  result.status = Status::optimal;
  result.reason = "feasible and stationary by our own checks";
  detect_unbounded(problem, round_bests, result);
  if (result.status == Status::optimal && best_design &&
      best_design->objective < result.candidates.front().objective * (1.0 - noticeable_gain)) {
    result.status = Status::stopped;
    result.reason =
        "a better design than every optimum found is allowed, but is no optimum itself: the objective may still fall "
        "from there, or have no least value; look at which variables stand next to a bound";
    result.candidates.insert(result.candidates.begin(), *std::move(best_design));
  }
  return result;
}

Eigen::MatrixXd starts(const Problem& problem, const Settings& settings, const std::stop_token& stop) {
  problem.validate();
  settings.validate();
  const PreparedProblem p(problem, size_limits(problem).back());
  Eigen::MatrixXd out(static_cast<Eigen::Index>(problem.names().size()), settings.starts);
  for (int k = 0; k < settings.starts; ++k) {
    if (stop.stop_requested()) throw Stopped{};
    out.col(k) = p.without_auxiliary(p.coordinates.variables(p.coordinates.start(k, settings.seed)));
  }
  return out;
}

}  // namespace ninedof
