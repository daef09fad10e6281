#include "optimize/minimax/design_evaluation.hpp"

#include <algorithm>
#include <cmath>

#include "math/numbers.hpp"

namespace ninedof {
namespace {

/// The singular values compared by a margin of a limit on the condition number: log(limit) less the difference of their logarithms.
struct ConditionPair {
  int top, bottom;
};
ConditionPair condition_pair(const PoseSpectrum& s, int row) {
  const auto tops = tops_of(s.closed), bottoms = bottoms_of(s.closed);
  return {tops[at_index(row) / bottoms.size()], bottoms[at_index(row) % bottoms.size()]};
}

void evaluate_margins(const PreparedProblem& p, const RowSelection* selection, DesignEvaluation& out) {
  const auto count = static_cast<Eigen::Index>(p.margins.size());
  out.margins.resize(count);
  out.margin_gradient.resize(count, p.coordinates.size());
  const auto spectrum_of = [&](int constraint) -> const PoseSpectrum& {
    return out.spectra[at_index(-1 - constraint)];
  };
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto [constraint, row] = p.margins[at_index(k)];
    if (constraint < 0) {
      const PoseSpectrum& s = spectrum_of(constraint);
      const auto [top, bottom] = condition_pair(s, row);
      out.margins[k] = std::log(p.condition_limit(-1 - constraint)) - (s.log_sigma[top] - s.log_sigma[bottom]);
    } else out.margins[k] = p.constraints[at_index(constraint)]->margin(out.state, row);
    if (!(out.margins[k] > worst_margin)) out.margins[k] = worst_margin;
  }
  const auto differentiate = [&](Eigen::Index k) {
    const auto [constraint, row] = p.margins[at_index(k)];
    out.margin_gradient.row(k).setZero();
    if (out.margins[k] <= worst_margin) return;
    if (constraint < 0) {
      const PoseSpectrum& s = spectrum_of(constraint);
      const auto [top, bottom] = condition_pair(s, row);
      out.margin_gradient.row(k) = s.gradient.row(bottom) - s.gradient.row(top);
    } else p.constraints[at_index(constraint)]->add_gradient(out.state, row, out.margin_gradient.row(k));
  };
  if (selection == nullptr)
    for (Eigen::Index k = 0; k < count; ++k) differentiate(k);
  else
    for (const int k : selection->margins) differentiate(k);
}

}  // namespace

void evaluate_design(const PreparedProblem& p, const Eigen::VectorXd& y, DesignEvaluation& out,
                     const RowSelection* selection) {
  p.set_state(y, out.state);
  evaluate_rows(p, out, selection);
}

void evaluate_rows(const PreparedProblem& p, DesignEvaluation& out, const RowSelection* selection) {
  const Eigen::Index n = p.coordinates.size();
  const int poses = p.evaluated_poses();
  const Machine machine = p.problem.objective.index == Index::six_legged ? Machine::six_legged : Machine::nine_legged;
  out.spectra.resize(at_index(p.evaluated_spectra()));
  out.objective_rows.resize(p.rows);
  out.row_gradient.resize(p.rows, n);
  for (int k = 0; k < p.evaluated_spectra(); ++k) {
    PoseSpectrum& s = out.spectra[at_index(k)];
    const int pose = k < poses ? out.state.first_pose + k : 0;
    if (p.closed[at_index(k)]) closed_spectrum(*p.family, out.state, p.pose_specs[at_index(pose)], machine, s);
    else general_spectrum(out.state, pose, s, selection == nullptr || selection->spectra[at_index(k)]);
    if (k >= poses) continue;
    if (out.smoothing > 0.0 && p.has_kinks() && !s.closed)
      fill_soft_index(p.problem.objective.index, s, out.smoothing, p.first_row(k), out.objective_rows,
                      out.row_gradient);
    else fill_index(p.problem.objective.index, s, p.first_row(k), out.objective_rows, out.row_gradient);
  }
  out.levels.setConstant(p.levels, -infinity);
  for (const RowLevel& u : p.row_levels) out.levels[u.level] = std::max(out.levels[u.level], out.objective_rows[u.row]);
  out.log_objective = p.objective(out.levels);

  evaluate_margins(p, selection, out);
}

double order_violation(const PreparedProblem& p, const DesignEvaluation& design, const Eigen::VectorXd& y) {
  // zs < zp is strict: it has no tolerance, unlike other limits.
  if (p.coordinates.order_margin(y) >= 0.0) return 0.0;
  return std::max(1e-6, std::log(design.state.blueprint.zs / std::max(design.state.blueprint.zp, 1e-300)));
}

double violation(const PreparedProblem& p, const DesignEvaluation& design, const Eigen::VectorXd& y) {
  double worst = order_violation(p, design, y);
  for (Eigen::Index k = 0; k < design.margins.size(); ++k)
    worst = std::max(worst, -p.violation_factor(static_cast<int>(k)) * design.margins[k]);
  return worst;
}

double neutral_condition(const PreparedProblem& p, const DesignEvaluation& design) {
  PoseSpectrum s;
  if (p.family->symmetric()) closed_spectrum(*p.family, design.state, p.pose_specs.front(), Machine::nine_legged, s);
  else general_spectrum(design.state, 0, s);
  return std::exp(s.log_max() - s.log_min());
}

std::vector<double> conditions(const PreparedProblem& p, const DesignEvaluation& design) {
  if (p.problem.objective.index == Index::six_legged) return {neutral_condition(p, design)};
  std::vector<double> out;
  for (int k = 0; k < p.evaluated_poses(); ++k) {
    const PoseSpectrum& s = design.spectra[at_index(k)];
    out.push_back(std::exp(s.log_max() - s.log_min()));
  }
  return out;
}

}  // namespace ninedof
