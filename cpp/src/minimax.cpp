#include "minimax.hpp"

#include <cmath>

#include "active_set.hpp"
#include "polish.hpp"
#include "slsqp.hpp"

namespace ninedof {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int restarts = 3;

/// Margins and the order of zs and zp.
Eigen::Index constraint_count(const Prepared& p) {
  return static_cast<Eigen::Index>(p.margins.size()) + 1;
}

/// An Nlp over the free coordinates and `extra` unbounded ones.
Nlp blank(const Prepared& p, int extra, Eigen::Index constraints) {
  Nlp nlp;
  const int n = p.coordinates.size();
  nlp.variables = n + extra;
  nlp.constraints = constraints;
  nlp.low.setConstant(n + extra, -infinity);
  nlp.high.setConstant(n + extra, infinity);
  nlp.low.head(n) = p.coordinates.low();
  nlp.high.head(n) = p.coordinates.high();
  return nlp;
}

/// Writes the design's own constraints as c <= 0 from row `row` on.
void write_constraints(const Prepared& p, const Look& l, const Eigen::VectorXd& y, Eigen::Index row, Nlp::Values& out) {
  const int n = p.coordinates.size();
  for (const Margin& m : p.margins) {
    const Margin::Form& f = m.governing(l.point);
    out.c[row] = -(f.constant + f.coefficients.dot(l.point.value));
    out.c_gradient.row(row++).head(n) = -(f.coefficients.transpose() * l.gradient);
  }
  out.c[row] = -p.coordinates.order_margin(y.head(n));
  out.c_gradient.row(row).head(n) = -p.coordinates.order().gradient.transpose();
}

/// Objective alpha - beta over (y, alpha, beta); maxima <= alpha, minima >= beta.
void fill_minimax(const Prepared& p, const Look& l, const Eigen::VectorXd& y, Nlp::Values& out) {
  const int n = p.coordinates.size();
  out.f = y[n] - y[n + 1];
  out.f_gradient.setZero();
  out.f_gradient[n] = 1.0;
  out.f_gradient[n + 1] = -1.0;
  Eigen::Index row = 0;
  for (const int k : {log_axial_max, log_transverse_max}) {
    out.c[row] = l.point.value[k] - y[n];
    out.c_gradient.row(row).head(n) = l.gradient.row(k);
    out.c_gradient(row++, n) = -1.0;
  }
  for (const int k : {log_axial_min, log_transverse_min}) {
    out.c[row] = y[n + 1] - l.point.value[k];
    out.c_gradient.row(row).head(n) = -l.gradient.row(k);
    out.c_gradient(row++, n + 1) = 1.0;
  }
  write_constraints(p, l, y, row, out);
}

/// Objective log kappa, with the gradient of the branch that rules.
void fill_plain(const Prepared& p, const Look& l, const Eigen::VectorXd& y, Nlp::Values& out) {
  const Extremes rule = l.point.extremes();
  out.f = l.point.value[rule.max] - l.point.value[rule.min];
  out.f_gradient = (l.gradient.row(rule.max) - l.gradient.row(rule.min)).transpose();
  write_constraints(p, l, y, 0, out);
}

/// Whether `next` is the better point to stand on: a regular design before a singular one, allowed before not allowed, then
/// the lower condition number, then, of two equal ones, the more nearly stationary.
bool improves(const Candidate& next, const Candidate& now) {
  if (next.regular() != now.regular()) return next.regular();
  if (next.feasible() != now.feasible()) return next.feasible();
  if (!next.feasible()) return next.constraint_violation < now.constraint_violation;
  if (std::abs(next.condition_number - now.condition_number) > 1e-10 * now.condition_number)
    return next.condition_number < now.condition_number;
  return next.optimality_residual < now.optimality_residual;
}

}  // namespace

Candidate judge(const Prepared& p, const Eigen::VectorXd& y) {
  Look l;
  look(p, y, l);
  const ActiveSet active = active_set(p, l, y);
  Candidate out;
  out.variables = l.x;
  out.condition_number = std::exp(l.point.log_condition_number());
  out.constraint_violation = violation(p, l, y);
  out.optimality_residual = stationarity(p, l, active).residual;
  out.active = names(p, active);
  return out;
}

Run minimise(const Prepared& p, const Eigen::VectorXd& start, Formulation formulation, int max_evaluations,
             const std::stop_token& stop, const Observer& observer) {
  const bool minimax = formulation == Formulation::minimax;
  const int n = p.coordinates.size();
  Eigen::VectorXd y = start;
  Run run{judge(p, y)};
  if (n == 0) return run;

  // NLopt returns its own choice among the points it saw, by a measure that counts alpha and beta; we keep the allowed
  // design of least condition number.
  Eigen::VectorXd seen = y;
  double seen_log_kappa = infinity;

  Look l;
  Nlp nlp = blank(p, minimax ? 2 : 0, (minimax ? 4 : 0) + constraint_count(p));
  nlp.evaluate = [&](const Eigen::VectorXd& at, Nlp::Values& out) {
    look(p, at.head(n), l);
    ++run.evaluations;
    minimax ? fill_minimax(p, l, at, out) : fill_plain(p, l, at, out);
    const double violated = violation(p, l, at.head(n));
    if (violated <= clearly_allowed && l.log_max() - l.log_min() < seen_log_kappa) {
      seen = at.head(n);
      seen_log_kappa = l.log_max() - l.log_min();
    }
    if (observer) observer(l.point, violated);
    return !stop.stop_requested();
  };
  const auto settled = [&] { return run.end.feasible() && run.end.stationary(); };
  const auto take = [&](const Eigen::VectorXd& next) {
    const Candidate judged = judge(p, next);
    if (!improves(judged, run.end)) return false;
    run.end = judged;
    y = next;
    return true;
  };

  Eigen::VectorXd from = y;
  for (int attempt = 0; attempt <= restarts && !stop.stop_requested(); ++attempt) {
    Eigen::VectorXd full(nlp.variables);
    full.head(n) = from;
    if (minimax) {
      look(p, from, l);
      full[n] = l.log_max();
      full[n + 1] = l.log_min();
    }
    bool better = take(slsqp(nlp, full, {.max_evaluations = max_evaluations}).head(n));
    better |= take(seen);
    if (!minimax) return run;
    if (run.end.feasible() && run.end.optimality_residual < 1e-2) take(polish(p, y));
    if (settled()) break;
    // SLSQP sometimes gives up where it stands: once in a thousand starts. A little way towards another start it goes on;
    // bounds and the order of zs and zp are linear here, so they hold on that way.
    from = better ? y : Eigen::VectorXd(0.9 * y + 0.1 * p.coordinates.start(attempt, 0));
  }
  return run;
}

Violation least_violation(const Prepared& p, const Eigen::VectorXd& start, int max_evaluations,
                          const std::stop_token& stop) {
  const int n = p.coordinates.size();
  Violation out;
  Look l;
  look(p, start, l);
  Eigen::VectorXd full(n + 1);
  full << start, violation(p, l, start);
  Nlp nlp = blank(p, 1, constraint_count(p));
  nlp.low[n] = 0.0;
  nlp.evaluate = [&](const Eigen::VectorXd& at, Nlp::Values& values) {
    look(p, at.head(n), l);
    ++out.evaluations;
    values.f = at[n];
    values.f_gradient.setZero();
    values.f_gradient[n] = 1.0;
    write_constraints(p, l, at, 0, values);
    values.c.array() -= at[n];
    values.c_gradient.col(n).setConstant(-1.0);
    return !stop.stop_requested();
  };
  if (n > 0) full = slsqp(nlp, full, {.max_evaluations = max_evaluations});
  const Eigen::VectorXd y = full.head(n);
  out.end = judge(p, y);
  look(p, y, l);
  out.causes = conflict(p, l, y);
  return out;
}

}  // namespace ninedof
