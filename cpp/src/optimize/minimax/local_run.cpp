#include "optimize/minimax/local_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "optimize/polish/active_set.hpp"

namespace ninedof {
namespace {

/// Decreasing smoothings of singular values that meet, in logarithms.
constexpr std::array smoothings{3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4};

/// Tolerances of SLSQP, with Newton's method after it and without.
constexpr double loose = 1e-10, tight = 1e-13;

/// Relative difference of objectives that is not worth an optimum: what lies below it by less is only next to one.
constexpr double next_to = 1e-8;

/// What the violation that is tolerated may have gained, in the logarithm of the objective: much, where a limit is
/// dear.
double bought(const Candidate& c) {
  double price = 0.0;
  for (const auto& [name, of] : c.prices) price = std::max(price, of);
  return price * c.constraint_violation;
}
constexpr double bought_at_most = 1e-9;

/// Whether `next` is the better point: regular before singular, feasible before infeasible, then the lower objective
/// with what violation bought counted twice, then, of two equal ones, the more nearly stationary.
bool improves(const Candidate& next, const Candidate& now) {
  if (next.regular() != now.regular()) return next.regular();
  if (next.feasible() != now.feasible()) return next.feasible();
  if (!next.feasible()) return next.constraint_violation < now.constraint_violation;
  const double gain = std::log(now.objective / next.objective) + 2.0 * (bought(now) - bought(next));
  if (next.stationary() != now.stationary() && std::abs(gain) <= next_to) return next.stationary();
  if (std::abs(gain) > 1e-10) return gain > 0.0;
  return next.optimality_residual < now.optimality_residual;
}

/// Pieces of the problem that one start goes on to, and the least gain, in the logarithm of the objective, that counts.
constexpr int most_pieces = 12;
constexpr double least_gain = 1e-10;

/// Larger condition numbers differ from a singular design by rounding only.
constexpr double largest_condition = 1e14;

/// Newton's method can start below this residual.
constexpr double nearly_stationary = 1e-2;
/// Smoothed singular values that coincide in the limit are within this many smoothings of the extreme one; without
/// smoothing, those that another solver left equal are within `left_equal`.
constexpr double group_width = 7.0, left_equal = 1e-5;
constexpr int most_additions = 4;  // of what Newton's method came to violate

ActiveSet active_near(const PreparedProblem& p, const Eigen::VectorXd& y, Contact contact, double smoothing,
                      DesignEvaluation& design) {
  design.state.length_joint = p.pieces(y).front();
  design.smoothing = smoothing;
  return evaluate_active(p, y, contact, design);
}

/// The point after Newton's method, or `y` where it cannot start.
Eigen::VectorXd polished(const PreparedProblem& p, const Eigen::VectorXd& y) {
  DesignEvaluation design;
  const ActiveSet active = active_near(p, y, Contact::near, 0.0, design);
  return stationarity(p, design, active).residual < nearly_stationary ? polish(p, y, active) : y;
}

/// Adds to an active set what is violated at `y`; whether that is anything.
bool add_violated(const PreparedProblem& p, const Eigen::VectorXd& y, ActiveSet& active) {
  DesignEvaluation design;
  const ActiveSet there = active_near(p, y, Contact::near, 0.0, design);
  Eigen::VectorXd level = Eigen::VectorXd::Constant(p.levels, -infinity);
  const auto value = [&](int k) { return design.objective_rows[p.row_levels[at_index(k)].row]; };
  for (const int k : active.row_levels) {
    double& top = level[p.row_levels[at_index(k)].level];
    top = std::max(top, value(k));
  }
  const std::size_t before = active.row_levels.size() + active.margins.size();
  const auto add = [](std::vector<int>& list, int k) {
    if (std::ranges::find(list, k) == list.end()) list.push_back(k);
  };
  for (const int k : there.row_levels)
    if (value(k) > level[p.row_levels[at_index(k)].level] + clearly_feasible) add(active.row_levels, k);
  for (const int k : there.margins)
    if (design.margins[k] < -clearly_feasible) add(active.margins, k);
  return active.row_levels.size() + active.margins.size() > before;
}

/// The same from a design of another solver, such as a warm start. What carries no weight may move until it violates.
Eigen::VectorXd polished_support(const PreparedProblem& p, const Eigen::VectorXd& y, Contact contact) {
  DesignEvaluation design;
  const ActiveSet active = active_near(p, y, contact, 0.0, design);
  const Stationarity found = stationarity(p, design, active);
  if (!(found.residual < nearly_stationary)) return y;
  ActiveSet support = found.support;
  Eigen::VectorXd end = polish(p, y, support, left_equal);
  for (int k = 0; k < most_additions && add_violated(p, end, support); ++k) end = polish(p, end, support, left_equal);
  return end;
}

/// The same from a solution of the problem with smoothed singular values.
Eigen::VectorXd polished_smoothed(const PreparedProblem& p, const Eigen::VectorXd& y, double smoothing) {
  DesignEvaluation design;
  return polish(p, y, active_near(p, y, Contact::near, smoothing, design), group_width * smoothing);
}

}  // namespace

Candidate candidate_at(const PreparedProblem& p, const Eigen::VectorXd& at) {
  const Eigen::VectorXd y = p.with_auxiliary(at);
  const std::vector<int> pieces = p.pieces(y);
  DesignEvaluation design;
  design.state.length_joint = pieces.front();
  const ActiveSet active = evaluate_active(p, y, Contact::exact, design);
  Stationarity s = stationarity(p, design, active);
  Candidate out;
  out.variables = p.without_auxiliary(design.state.x);
  out.objective = std::exp(design.log_objective);
  out.condition_number = neutral_condition(p, design);
  out.conditions = conditions(p, design);
  out.characteristic_length = design.state.characteristic_length;
  const bool by_poses = p.problem.objective.index != Index::six_legged;
  out.singular = !(out.objective < largest_condition) ||
                 (by_poses && !(*std::ranges::max_element(out.conditions) < largest_condition));
  out.constraint_violation = violation(p, design, y);
  out.optimality_residual = s.residual;
  out.prices = std::move(s.prices);
  out.active = names(p, active);
  // A minimum where pieces meet is one of each. Relaxing a limit gains what it gains in the best of them.
  for (std::size_t k = 1; k < pieces.size(); ++k) {
    design.state.length_joint = pieces[k];
    const ActiveSet there = evaluate_active(p, y, Contact::exact, design);
    const Stationarity other = stationarity(p, design, there);
    out.optimality_residual = std::max(out.optimality_residual, other.residual);
    for (const auto& [name, price] : other.prices) out.prices[name] = std::max(out.prices[name], price);
  }
  return out;
}

/// Continues `solve` where pieces of the problem meet: `solve(from, piece)` is the end of one piece.
template <class Solve>
Eigen::VectorXd solve_all_pieces(const PreparedProblem& p, const Eigen::VectorXd& from, double smoothing,
                                 const Solve& solve) {
  const auto value = [&](const Eigen::VectorXd& y) {
    DesignEvaluation design;
    design.smoothing = smoothing;
    const RowSelection none = selection_of(p);
    evaluate_design(p, y, design, &none);
    return violation(p, design, y) > clearly_feasible ? infinity : design.log_objective;
  };
  std::vector<int> tried{p.pieces(from).front()};  // since the objective fell
  Eigen::VectorXd end = solve(from, tried.front());
  for (int k = 0; k < most_pieces && !p.length_joints.empty(); ++k) {
    const std::vector<int> meeting = p.pieces(end);
    const auto next = std::ranges::find_if(meeting, [&](int j) { return std::ranges::find(tried, j) == tried.end(); });
    if (next == meeting.end()) break;
    const Eigen::VectorXd further = solve(end, *next);
    if (value(further) < value(end) - least_gain) {
      end = further;
      tried.clear();
    }
    tried.push_back(*next);
  }
  return end;
}

LocalRun run_from_start(const PreparedProblem& p, const Eigen::VectorXd& start, Formulation formulation,
                        const RunSettings& run_settings, const std::stop_token& stop, const Observer& observer) {
  Eigen::VectorXd y = p.with_auxiliary(start);
  LocalRun run{candidate_at(p, y)};
  if (p.coordinates.size() == 0) return run;
  const bool minimax = formulation == Formulation::minimax;
  Subproblem subproblem(p, formulation, stop, observer);
  const auto settled = [&] { return run.end.feasible() && run.end.stationary() && bought(run.end) <= bought_at_most; };
  const auto take = [&](const Eigen::VectorXd& next) {
    const Candidate found = candidate_at(p, next);
    if (!improves(found, run.end)) return false;
    run.end = found;
    y = p.with_auxiliary(next);
    return true;
  };
  const auto solve = [&](const Eigen::VectorXd& from, double smoothing, double tolerance) {
    const auto in_piece = [&](const Eigen::VectorXd& at, int piece) {
      return subproblem.solve(at, piece, smoothing, tolerance, run_settings.max_evaluations);
    };
    Eigen::VectorXd end = solve_all_pieces(p, from, smoothing, in_piece);
    run.evaluations = subproblem.evaluations();
    return end;
  };

  if (minimax && run_settings.polish) {
    for (const Contact contact : {Contact::wide, Contact::near}) {
      take(polished_support(p, y, contact));
      if (settled()) return run;
    }
  }
  Eigen::VectorXd from = y, smoothed_from = Eigen::VectorXd::Constant(y.size(), std::nan(""));
  for (int attempt = 0; attempt <= run_settings.restarts && !stop.stop_requested(); ++attempt) {
    bool better = take(solve(from, 0.0, attempt == 0 && minimax && run_settings.polish ? loose : tight));
    if (subproblem.best_seen() != y) better |= take(subproblem.best_seen());
    if (!minimax || stop.stop_requested()) return run;
    if (run_settings.polish && run.end.feasible()) take(polished(p, y));
    if (settled()) break;
    if (run_settings.polish && p.has_kinks() && run.end.feasible() && smoothed_from != y) {
      // Where singular values meet off the axis, the index has a kink that no row describes. Solve with decreasing
      // smoothing, then polish with the singular values that coincide held equal. Where the first of them moves
      // nothing, it is no kink that stops SLSQP.
      smoothed_from = y;
      Eigen::VectorXd smoothed = y;
      for (const double epsilon : smoothings) {
        if (stop.stop_requested()) break;
        smoothed = solve(smoothed, epsilon, tight);
        take(smoothed);
        if (smoothed == smoothed_from) break;
      }
      take(polished_smoothed(p, smoothed, smoothings.back()));
      if (settled()) break;
    }
    // SLSQP stops at its start about once in a thousand runs. Continue a little way towards another start; bounds and
    // zs < zp are linear in y, so they hold there.
    from = better ? y : Eigen::VectorXd(0.9 * y + 0.1 * p.coordinates.start(attempt, 0));
  }
  return run;
}

}  // namespace ninedof
