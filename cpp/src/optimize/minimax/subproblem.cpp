#include "optimize/minimax/subproblem.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

/// All rows are taken where there are no more than this.
constexpr std::size_t few_rows = 150;
/// Rows of the objective this far below their level, and margins this large, are left out at first: logarithms of ratios.
constexpr double far_below = 0.2, large_margin = 0.1;
/// What joins once a row that was left out is violated, and how often that may happen.
constexpr double joins = 0.05;
constexpr int rounds = 8;

/// An Nlp over the free coordinates and `extra` unbounded ones.
Nlp blank(const Prepared& p, int extra, std::size_t constraints) {
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
void write_constraints(const Prepared& p, const Look& l, const std::vector<int>& margins, const Eigen::VectorXd& y,
                       Eigen::Index row, Nlp::Values& out) {
  const int n = p.coordinates.size();
  for (const int k : margins) {
    out.c[row] = -l.m[k];
    out.c_gradient.row(row++).head(n) = -l.m_gradient.row(k);
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

Eigen::VectorXd ruling_gradient(const Prepared& p, const Look& l, const Eigen::VectorXd& slopes) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(p.coordinates.size());
  std::vector<bool> done(static_cast<std::size_t>(p.levels), false);
  for (const Use& u : p.uses) {
    if (done[static_cast<std::size_t>(u.level)] || l.f[u.row] < l.levels[u.level]) continue;
    out += slopes[u.level] * l.f_gradient.row(u.row).transpose();
    done[static_cast<std::size_t>(u.level)] = true;
  }
  return out;
}

void Subproblem::choose(const Look& l) {
  uses_.clear();
  wanted_.margins.clear();
  if (p_.uses.size() + p_.margins.size() <= few_rows) {
    uses_ = all_of(p_.uses.size());
    wanted_.margins = all_of(p_.margins.size());
    return;
  }
  for (std::size_t k = 0; k < p_.uses.size(); ++k)
    if (l.f[p_.uses[k].row] >= l.levels[p_.uses[k].level] - far_below) uses_.push_back(static_cast<int>(k));
  for (Eigen::Index k = 0; k < l.m.size(); ++k)
    if (l.m[k] <= large_margin) wanted_.margins.push_back(static_cast<int>(k));
}

void Subproblem::note_wanted() {
  wanted_.poses.assign(static_cast<std::size_t>(std::max(p_.looked, 1)), false);
  for (const int k : uses_)
    wanted_.poses[static_cast<std::size_t>(p_.pose_of(p_.uses[static_cast<std::size_t>(k)].row))] = true;
  for (const int k : wanted_.margins) {
    const int constraint = p_.margins[static_cast<std::size_t>(k)].constraint;
    if (constraint < 0) wanted_.poses[static_cast<std::size_t>(-1 - constraint)] = true;
  }
}

bool Subproblem::add_violated(const Look& l) {
  const auto has = [](const std::vector<int>& list, int k) { return std::ranges::binary_search(list, k); };
  std::vector<int> uses, margins;
  bool violated = false;
  for (std::size_t k = 0; k < p_.uses.size(); ++k) {
    const double above = l.f[p_.uses[k].row] - l.levels[p_.uses[k].level];
    if (above >= -joins && !has(uses_, static_cast<int>(k))) {
      uses.push_back(static_cast<int>(k));
      violated |= above >= -clearly_allowed;  // it rules: the level of the rows taken was below it
    }
  }
  for (Eigen::Index k = 0; k < l.m.size(); ++k)
    if (l.m[k] <= joins && !has(wanted_.margins, static_cast<int>(k))) {
      margins.push_back(static_cast<int>(k));
      violated |= l.m[k] < -clearly_allowed;
    }
  if (!violated) return false;
  uses_.insert(uses_.end(), uses.begin(), uses.end());
  wanted_.margins.insert(wanted_.margins.end(), margins.begin(), margins.end());
  std::ranges::sort(uses_);
  std::ranges::sort(wanted_.margins);
  return true;
}

void Subproblem::fill(const Look& l, const Eigen::VectorXd& at, Nlp::Values& out) const {
  const int n = p_.coordinates.size();
  Eigen::VectorXd slopes;
  if (!minimax()) {
    // The objective itself, with the gradient of the rows that rule.
    out.f = p_.objective(l.levels, &slopes);
    out.f_gradient = ruling_gradient(p_, l, slopes);
    return write_constraints(p_, l, wanted_.margins, at, 0, out);
  }
  out.f = p_.objective(at.tail(p_.levels), &slopes);
  out.f_gradient.setZero();
  out.f_gradient.tail(p_.levels) = slopes;
  Eigen::Index row = 0;
  for (const int k : uses_) {
    const Use& u = p_.uses[static_cast<std::size_t>(k)];
    out.c[row] = l.f[u.row] - at[n + u.level];
    out.c_gradient.row(row).head(n) = l.f_gradient.row(u.row);
    out.c_gradient(row++, n + u.level) = -1.0;
  }
  write_constraints(p_, l, wanted_.margins, at, row, out);
}

Eigen::VectorXd Subproblem::run(const Eigen::VectorXd& from, double tolerance, int max_evaluations) {
  const int n = p_.coordinates.size();
  note_wanted();
  Nlp nlp = blank(p_, minimax() ? p_.levels : 0, (minimax() ? uses_.size() : 0) + wanted_.margins.size() + 1);
  nlp.evaluate = [&](const Eigen::VectorXd& at, Nlp::Values& out) {
    look(p_, at.head(n), l_, &wanted_);
    ++evaluations_;
    fill(l_, at, out);
    const double violated = violation(p_, l_, at.head(n));
    if (violated <= clearly_allowed && l_.log_objective < seen_objective_) {
      seen_ = at.head(n);
      seen_objective_ = l_.log_objective;
    }
    if (observer_) observer_(l_.log_objective, violated);
    return !stop_.stop_requested();
  };
  Eigen::VectorXd full(nlp.variables);
  full.head(n) = from;
  if (minimax()) full.tail(p_.levels) = l_.levels;
  return slsqp(nlp, full, {.tolerance = tolerance, .max_evaluations = max_evaluations}).head(n);
}

Eigen::VectorXd Subproblem::solve(const Eigen::VectorXd& from, double smoothing, double tolerance,
                                  int max_evaluations) {
  seen_ = from;
  seen_objective_ = infinity;
  l_.smoothing = smoothing;
  look(p_, from, l_);
  choose(l_);
  Eigen::VectorXd y = from;
  for (int round = 0; round < rounds; ++round) {
    y = run(y, tolerance, max_evaluations);
    if (stop_.stop_requested()) break;
    look(p_, y, l_);
    if (!add_violated(l_)) break;
  }
  return y;
}

Eigen::VectorXd least_violation_point(const Prepared& p, const Eigen::VectorXd& start, int max_evaluations,
                                      const std::stop_token& stop, long& evaluations) {
  const int n = p.coordinates.size();
  const std::vector<int> margins = all_of(p.margins.size());
  Look l;
  look(p, start, l);
  Eigen::VectorXd full(n + 1);
  full << start, violation(p, l, start);
  Nlp nlp = blank(p, 1, margins.size() + 1);
  nlp.low[n] = 0.0;
  nlp.evaluate = [&](const Eigen::VectorXd& at, Nlp::Values& values) {
    look(p, at.head(n), l);
    ++evaluations;
    values.f = at[n];
    values.f_gradient.setZero();
    values.f_gradient[n] = 1.0;
    write_constraints(p, l, margins, at, 0, values);
    values.c.array() -= at[n];
    values.c_gradient.col(n).setConstant(-1.0);
    return !stop.stop_requested();
  };
  return n > 0 ? Eigen::VectorXd(slsqp(nlp, full, {.max_evaluations = max_evaluations}).head(n)) : start;
}

}  // namespace ninedof
