#include "optimize/minimax/subproblem.hpp"

#include <algorithm>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

/// All rows are selected where there are no more than this.
constexpr std::size_t few_rows = 150;
/// Rows this far below their level and margins this large, as logarithms of ratios, are not selected at first.
constexpr double far_below = 0.2, large_margin = 0.1;
/// Once a row that was not selected is violated, all rows this near are added, so many times at most.
constexpr double near_active = 0.05;
constexpr int selections = 8;

/// An Nlp over the free coordinates and `extra` unbounded ones, without its functions.
Nlp bounded_nlp(const PreparedProblem& p, int extra, std::size_t constraints) {
  Nlp nlp;
  const int n = p.coordinates.size();
  nlp.variables = n + extra;
  nlp.constraints = static_cast<Eigen::Index>(constraints);
  nlp.low.setConstant(n + extra, -infinity);
  nlp.high.setConstant(n + extra, infinity);
  nlp.low.head(n) = p.coordinates.low();
  nlp.high.head(n) = p.coordinates.high();
  return nlp;
}

/// Writes margins and the order of zs and zp as c <= 0 from row `row` on.
void write_constraints(const PreparedProblem& p, const DesignEvaluation& design, const std::vector<int>& margins,
                       const Eigen::VectorXd& y, Eigen::Index row, Nlp::Values& out) {
  const int n = p.coordinates.size();
  for (const int k : margins) {
    out.c[row] = -design.margins[k];
    out.c_gradient.row(row++).head(n) = -design.margin_gradient.row(k);
  }
  out.c[row] = -p.coordinates.order_margin(y.head(n));
  out.c_gradient.row(row).head(n) = -p.coordinates.order().gradient.transpose();
}

std::vector<int> all_of(std::size_t count) {
  std::vector<int> out(count);
  for (std::size_t k = 0; k < count; ++k) out[k] = static_cast<int>(k);
  return out;
}

}  // namespace

Eigen::VectorXd objective_gradient(const PreparedProblem& p, const DesignEvaluation& design,
                                   const Eigen::VectorXd& slopes) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(p.coordinates.size());
  std::vector<bool> done(at_index(p.levels), false);
  for (const RowLevel& u : p.row_levels) {
    if (done[at_index(u.level)] || design.objective_rows[u.row] < design.levels[u.level]) continue;
    out += slopes[u.level] * design.row_gradient.row(u.row).transpose();
    done[at_index(u.level)] = true;
  }
  return out;
}

void Subproblem::select_rows() {
  selection_.row_levels.clear();
  selection_.margins.clear();
  if (p_.row_levels.size() + p_.margins.size() <= few_rows) {
    selection_.row_levels = all_of(p_.row_levels.size());
    selection_.margins = all_of(p_.margins.size());
    return;
  }
  for (std::size_t k = 0; k < p_.row_levels.size(); ++k)
    if (design_.objective_rows[p_.row_levels[k].row] >= design_.levels[p_.row_levels[k].level] - far_below)
      selection_.row_levels.push_back(static_cast<int>(k));
  for (Eigen::Index k = 0; k < design_.margins.size(); ++k)
    if (design_.margins[k] <= large_margin) selection_.margins.push_back(static_cast<int>(k));
}

bool Subproblem::add_violated() {
  const auto has = [](const std::vector<int>& list, int k) { return std::ranges::binary_search(list, k); };
  std::vector<int> row_levels, margins;
  bool violated = false;
  for (std::size_t k = 0; k < p_.row_levels.size(); ++k) {
    const double above = design_.objective_rows[p_.row_levels[k].row] - design_.levels[p_.row_levels[k].level];
    if (above >= -near_active && !has(selection_.row_levels, static_cast<int>(k))) {
      row_levels.push_back(static_cast<int>(k));
      violated |= above >= -clearly_feasible;  // it is the largest: the level of the selected rows was below it
    }
  }
  for (Eigen::Index k = 0; k < design_.margins.size(); ++k)
    if (design_.margins[k] <= near_active && !has(selection_.margins, static_cast<int>(k))) {
      margins.push_back(static_cast<int>(k));
      violated |= design_.margins[k] < -clearly_feasible;
    }
  if (!violated) return false;
  selection_.row_levels.insert(selection_.row_levels.end(), row_levels.begin(), row_levels.end());
  selection_.margins.insert(selection_.margins.end(), margins.begin(), margins.end());
  std::ranges::sort(selection_.row_levels);
  std::ranges::sort(selection_.margins);
  return true;
}

void Subproblem::fill(const Eigen::VectorXd& at, Nlp::Values& out) const {
  const int n = p_.coordinates.size();
  Eigen::VectorXd slopes;
  if (!minimax()) {
    // The objective itself, with the gradient of the largest rows.
    out.f = p_.objective(design_.levels, &slopes);
    out.f_gradient = objective_gradient(p_, design_, slopes);
    return write_constraints(p_, design_, selection_.margins, at, 0, out);
  }
  out.f = p_.objective(at.tail(p_.levels), &slopes);
  out.f_gradient.setZero();
  out.f_gradient.tail(p_.levels) = slopes;
  Eigen::Index row = 0;
  for (const int k : selection_.row_levels) {
    const RowLevel& u = p_.row_levels[at_index(k)];
    out.c[row] = design_.objective_rows[u.row] - at[n + u.level];
    out.c_gradient.row(row).head(n) = design_.row_gradient.row(u.row);
    out.c_gradient(row++, n + u.level) = -1.0;
  }
  write_constraints(p_, design_, selection_.margins, at, row, out);
}

Eigen::VectorXd Subproblem::run(const Eigen::VectorXd& from, double tolerance, int max_evaluations) {
  const int n = p_.coordinates.size();
  selection_ = selection_of(p_, std::move(selection_.row_levels), std::move(selection_.margins));
  // What is not selected matters where the selected rows are kept, and to an observer.
  selection_.alone = minimax() && !observer_;
  const auto passed = [&](int k) { return -p_.violation_factor(k) * design_.margins[k] > clearly_feasible; };
  Nlp nlp = bounded_nlp(p_, minimax() ? p_.levels : 0,
                        (minimax() ? selection_.row_levels.size() : 0) + selection_.margins.size() + 1);
  nlp.evaluate = [&](const Eigen::VectorXd& at, Nlp::Values& out) {
    evaluate_design(p_, at.head(n), design_, &selection_);
    ++evaluations_;
    fill(at, out);
    if (selection_.alone) {
      if (std::ranges::any_of(selection_.margins, passed)) return !stop_.stop_requested();
      evaluate_others(p_, design_, selection_);
    }
    const double violated = violation(p_, design_, at.head(n));
    if (violated <= clearly_feasible && design_.log_objective < best_seen_objective_) {
      best_seen_ = at.head(n);
      best_seen_objective_ = design_.log_objective;
    }
    if (observer_) observer_(design_.log_objective, violated);
    return !stop_.stop_requested();
  };
  Eigen::VectorXd full(nlp.variables);
  full.head(n) = from;
  if (minimax()) full.tail(p_.levels) = design_.levels;
  return slsqp(nlp, full, {.tolerance = tolerance, .max_evaluations = max_evaluations}).head(n);
}

Eigen::VectorXd Subproblem::solve(const Eigen::VectorXd& from, int piece, double smoothing, double tolerance,
                                  int max_evaluations) {
  best_seen_ = from;
  best_seen_objective_ = infinity;
  design_.smoothing = smoothing;
  design_.state.length_joint = piece;
  const RowSelection none = selection_of(p_);
  evaluate_design(p_, from, design_, &none);
  select_rows();
  Eigen::VectorXd y = from;
  const long end = evaluations_ + max_evaluations;
  for (int k = 0; k < selections && evaluations_ < end; ++k) {
    y = run(y, tolerance, static_cast<int>(end - evaluations_));
    if (stop_.stop_requested()) break;
    evaluate_design(p_, y, design_, &none);
    if (!add_violated()) break;
  }
  return y;
}

}  // namespace ninedof
