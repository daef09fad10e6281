#include "optimize/minimax/minimax.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "optimize/polish/active_set.hpp"
#include "optimize/polish/polish.hpp"

namespace ninedof {
namespace {

/// Smoothings of singular values that meet, in logarithms, one after the other.
constexpr std::array smoothings{3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4};

/// Tolerances of SLSQP: the last digits are Newton's work where it takes, and its own where not.
constexpr double loose = 1e-10, tight = 1e-13;

/// Whether `next` is the better point to stand on: a regular design before a singular one, allowed before not allowed, then
/// the lower condition number, then, of two equal ones, the more nearly stationary.
bool improves(const Candidate& next, const Candidate& now) {
  if (next.regular() != now.regular()) return next.regular();
  if (next.feasible() != now.feasible()) return next.feasible();
  if (!next.feasible()) return next.constraint_violation < now.constraint_violation;
  if (std::abs(next.objective - now.objective) > 1e-10 * now.objective) return next.objective < now.objective;
  return next.optimality_residual < now.optimality_residual;
}

/// Beyond it a condition number is rounding away from a singular design.
constexpr double largest_condition = 1e14;

double worst(const std::vector<double>& conditions) {
  return *std::ranges::max_element(conditions);
}

/// Whether Newton's method has something to hold on to.
bool nearly_stationary(const Prepared& p, const Eigen::VectorXd& y) {
  Look l;
  look(p, y, l);
  return stationarity(p, l, active_set(p, l, y, Contact::near)).residual < 1e-2;
}

}  // namespace

Candidate judge(const Prepared& p, const Eigen::VectorXd& without_auxiliary) {
  const Eigen::VectorXd y = p.with_auxiliary(without_auxiliary);
  Look l;
  look(p, y, l);
  const ActiveSet active = active_set(p, l, y);
  Stationarity s = stationarity(p, l, active);
  Candidate out;
  out.variables = p.without_auxiliary(l.view.x);
  out.objective = std::exp(l.log_objective);
  out.condition_number = neutral_condition(p, l);
  out.conditions = conditions(p, l);
  out.characteristic_length = l.view.characteristic_length;
  const bool by_poses = p.problem.objective.index != Index::six_legged;
  out.singular = !(out.objective < largest_condition) || (by_poses && !(worst(out.conditions) < largest_condition));
  out.constraint_violation = violation(p, l, y);
  out.optimality_residual = s.residual;
  out.prices = std::move(s.prices);
  out.active = names(p, active);
  return out;
}

Run minimise(const Prepared& p, const Eigen::VectorXd& start, Formulation formulation, const Effort& effort,
             const std::stop_token& stop, const Observer& observer) {
  Eigen::VectorXd y = p.with_auxiliary(start);
  Run run{judge(p, y)};
  if (p.coordinates.size() == 0) return run;
  const bool minimax = formulation == Formulation::minimax;
  Subproblem subproblem(p, formulation, stop, observer);
  const auto settled = [&] { return run.end.feasible() && run.end.stationary(); };
  const auto take = [&](const Eigen::VectorXd& next) {
    const Candidate judged = judge(p, next);
    if (!improves(judged, run.end)) return false;
    run.end = judged;
    y = p.with_auxiliary(next);
    return true;
  };
  const auto solve = [&](const Eigen::VectorXd& from, double smoothing, double tolerance) {
    Eigen::VectorXd end = subproblem.solve(from, smoothing, tolerance, effort.max_evaluations);
    run.evaluations = subproblem.evaluations();
    return end;
  };

  Eigen::VectorXd from = y;
  for (int attempt = 0; attempt <= effort.restarts && !stop.stop_requested(); ++attempt) {
    bool better = take(solve(from, 0.0, attempt == 0 && minimax && effort.polished ? loose : tight));
    if (subproblem.seen() != y) better |= take(subproblem.seen());
    if (!minimax) return run;
    if (effort.polished && run.end.feasible() && nearly_stationary(p, y)) take(polish(p, y));
    if (settled()) break;
    if (effort.polished && p.kinked() && run.end.feasible()) {
      // Singular values that meet, off the axis, have a kink that no row describes: solved smoothed, less and less, and then
      // exactly with those that come together held together.
      Eigen::VectorXd smoothed = y;
      for (const double epsilon : smoothings) {
        if (stop.stop_requested()) break;
        smoothed = solve(smoothed, epsilon, tight);
        take(smoothed);
      }
      take(polish(p, smoothed, smoothings.back()));
      if (settled()) break;
    }
    // SLSQP sometimes gives up where it stands: once in a thousand starts. A little way towards another start it goes on;
    // bounds and the order of zs and zp are linear here, so they hold on that way.
    from = better ? y : Eigen::VectorXd(0.9 * y + 0.1 * p.coordinates.start(attempt, 0));
  }
  return run;
}

Violation least_violation(const Prepared& p, const Eigen::VectorXd& start, int max_evaluations,
                          const std::stop_token& stop) {
  Violation out;
  const Eigen::VectorXd y =
      p.with_auxiliary(least_violation_point(p, p.with_auxiliary(start), max_evaluations, stop, out.evaluations));
  out.end = judge(p, y);
  Look l;
  look(p, y, l);
  out.causes = conflict(p, l, y);
  return out;
}

}  // namespace ninedof
