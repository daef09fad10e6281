#include "optimize/minimax/design_evaluation.hpp"

#include <algorithm>
#include <cmath>

#include "batch/spectrum_stack.hpp"
#include "math/numbers.hpp"

namespace ninedof {
namespace {

/// The singular values compared by a margin of a limit on the condition number: log(limit) less the difference of their
/// logarithms.
struct ConditionPair {
  int top, bottom;
};
ConditionPair condition_pair(const PoseSpectrum& s, int row) {
  const auto tops = tops_of(s.closed), bottoms = bottoms_of(s.closed);
  return {tops[at_index(row) / bottoms.size()], bottoms[at_index(row) % bottoms.size()]};
}

/// The pose of an evaluated spectrum, an index of DesignState::poses.
int pose_of_spectrum(const PreparedProblem& p, const DesignState& state, int spectrum) {
  return spectrum < p.evaluated_poses() ? state.first_pose + spectrum : 0;
}

/// The singular values of the chosen spectra, off the axis those of many poses at once.
template <class Chosen>
void evaluate_spectra(const PreparedProblem& p, const Chosen& chosen, bool derivatives, DesignEvaluation& out) {
  const Machine machine = p.problem.objective.index == Index::six_legged ? Machine::six_legged : Machine::nine_legged;
  std::array<int, SpectrumStack::most> poses;
  std::array<PoseSpectrum*, SpectrumStack::most> general;
  std::size_t count = 0;
  const int all = p.evaluated_spectra();
  for (int k = 0; k < all; ++k) {
    if (chosen(k)) {
      const int pose = pose_of_spectrum(p, out.state, k);
      PoseSpectrum& s = out.spectra[at_index(k)];
      if (p.closed[at_index(k)]) {
        closed_spectrum(*p.family, out.state, p.pose_specs[at_index(pose)], machine, s);
      } else {
        poses[count] = pose;
        general[count++] = &s;
      }
    }
    if (count == 0 || (count < SpectrumStack::most && k + 1 < all)) continue;
    general_spectra(out.state, {poses.data(), count}, {general.data(), count}, derivatives);
    count = 0;
  }
}

/// Singular values of one spectrum, for a row that is evaluated alone.
const PoseSpectrum& spectrum_alone(const PreparedProblem& p, int k, DesignEvaluation& out) {
  out.spectra.resize(at_index(p.evaluated_spectra()));
  evaluate_spectra(p, [&](int other) { return other == k; }, false, out);
  return out.spectra[at_index(k)];
}

/// Margins, those of a constraint together; singular values are known.
void evaluate_margins(const PreparedProblem& p, const DesignEvaluation& design, std::span<const MarginRow> rows,
                      double* out) {
  for (std::size_t k = 0, next = 0; k < rows.size(); k = next) {
    const int constraint = rows[k].constraint;
    while (next < rows.size() && rows[next].constraint == constraint) ++next;
    if (constraint >= 0) {
      p.constraints[at_index(constraint)]->margins(design.state, rows.subspan(k, next - k), out + k);
      continue;
    }
    const PoseSpectrum& s = design.spectra[at_index(-1 - constraint)];
    for (std::size_t n = k; n < next; ++n) {
      const auto [top, bottom] = condition_pair(s, rows[n].row);
      out[n] = std::log(p.condition_limit(-1 - constraint)) - (s.log_sigma[top] - s.log_sigma[bottom]);
    }
  }
  for (double& margin : std::span(out, rows.size()))
    if (!(margin > worst_margin)) margin = worst_margin;
}

void differentiate_margin(const PreparedProblem& p, int k, DesignEvaluation& out) {
  const auto [constraint, row] = p.margins[at_index(k)];
  out.margin_gradient.row(k).setZero();
  if (out.margins[k] <= worst_margin) return;
  if (constraint < 0) {
    const PoseSpectrum& s = out.spectra[at_index(-1 - constraint)];
    const auto [top, bottom] = condition_pair(s, row);
    out.margin_gradient.row(k) = s.gradient.row(bottom) - s.gradient.row(top);
  } else p.constraints[at_index(constraint)]->add_gradient(out.state, row, out.margin_gradient.row(k));
}

/// The rows of the index at an evaluated pose.
void fill_rows(const PreparedProblem& p, int pose, DesignEvaluation& out) {
  const Index index = p.problem.objective.index;
  const PoseSpectrum& s = out.spectra[at_index(pose)];
  const int row = p.first_row(pose);
  if (out.smoothing > 0.0 && p.has_kinks() && !s.closed)
    fill_soft_index(index, s, out.smoothing, row, out.objective_rows, out.row_gradient);
  else fill_index(index, s, row, out.objective_rows, out.row_gradient);
}

/// Those of chosen poses.
template <class Chosen>
void fill_rows(const PreparedProblem& p, const Chosen& chosen, DesignEvaluation& out) {
  for (int pose = 0; pose < p.evaluated_poses(); ++pose)
    if (chosen(pose)) fill_rows(p, pose, out);
}

/// The rows of a selection, with their derivatives.
void evaluate_alone(const PreparedProblem& p, const RowSelection& selection, DesignEvaluation& out) {
  const auto chosen = [&](int k) { return selection.spectra[at_index(k)]; };
  evaluate_spectra(p, chosen, true, out);
  fill_rows(p, chosen, out);
  std::vector<MarginRow> rows;
  for (const int k : selection.margins) rows.push_back(p.margins[at_index(k)]);
  std::vector<double> values(rows.size());
  evaluate_margins(p, out, rows, values.data());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    out.margins[selection.margins[n]] = values[n];
    differentiate_margin(p, selection.margins[n], out);
  }
}

/// The values of what was not chosen, of all margins, and of levels and objective.
template <class Chosen>
void evaluate_others(const PreparedProblem& p, const Chosen& chosen, DesignEvaluation& out) {
  const auto others = [&](int k) { return !chosen(k); };
  evaluate_spectra(p, others, false, out);
  fill_rows(p, others, out);
  out.levels.setConstant(p.levels, -infinity);
  for (const RowLevel& u : p.row_levels) out.levels[u.level] = std::max(out.levels[u.level], out.objective_rows[u.row]);
  out.log_objective = p.objective(out.levels);
  evaluate_margins(p, out, p.margins, out.margins.data());
}

}  // namespace

RowSelection selection_of(const PreparedProblem& p, std::vector<int> row_levels, std::vector<int> margins) {
  RowSelection out{std::move(row_levels), std::move(margins),
                   std::vector<bool>(at_index(p.evaluated_spectra()), false)};
  for (const int k : out.row_levels) out.spectra[at_index(p.pose_of(p.row_levels[at_index(k)].row))] = true;
  for (const int k : out.margins)
    if (const int constraint = p.margins[at_index(k)].constraint; constraint < 0)
      out.spectra[at_index(-1 - constraint)] = true;
  return out;
}

void evaluate_design(const PreparedProblem& p, const Eigen::VectorXd& y, DesignEvaluation& out,
                     const RowSelection* selection) {
  p.set_state(y, out.state);
  evaluate_rows(p, out, selection);
}

void evaluate_rows(const PreparedProblem& p, DesignEvaluation& out, const RowSelection* selection) {
  const auto margins = static_cast<Eigen::Index>(p.margins.size());
  const Eigen::Index columns = out.state.columns();
  out.spectra.resize(at_index(p.evaluated_spectra()));
  out.objective_rows.resize(p.rows);
  out.margins.resize(margins);
  const auto fit = [&](Rows& gradient, Eigen::Index rows) {
    if (gradient.rows() != rows || gradient.cols() != columns) gradient.setZero(rows, columns);
  };
  fit(out.row_gradient, p.rows);
  fit(out.margin_gradient, margins);
  if (selection != nullptr && selection->alone) return evaluate_alone(p, *selection, out);
  const auto chosen = [&](int k) { return selection == nullptr || selection->spectra[at_index(k)]; };
  evaluate_spectra(p, chosen, true, out);
  fill_rows(p, chosen, out);
  evaluate_others(p, chosen, out);
  if (selection == nullptr)
    for (Eigen::Index k = 0; k < margins; ++k) differentiate_margin(p, static_cast<int>(k), out);
  else
    for (const int k : selection->margins) differentiate_margin(p, k, out);
}

void evaluate_others(const PreparedProblem& p, DesignEvaluation& out, const RowSelection& selection) {
  evaluate_others(p, [&](int k) { return selection.spectra[at_index(k)]; }, out);
}

void differentiate_rows(const PreparedProblem& p, DesignEvaluation& out, const RowSelection& selection) {
  for (int k = 0; k < p.evaluated_spectra(); ++k) {
    if (!selection.spectra[at_index(k)]) continue;
    if (!p.closed[at_index(k)])
      differentiate_spectrum(out.state, pose_of_spectrum(p, out.state, k), out.spectra[at_index(k)]);
    if (k < p.evaluated_poses()) fill_rows(p, k, out);
  }
  for (const int k : selection.margins) differentiate_margin(p, k, out);
}

double evaluate_margin(const PreparedProblem& p, DesignEvaluation& out, int k, Row gradient) {
  const auto [constraint, row] = p.margins[at_index(k)];
  gradient.setZero();
  if (constraint < 0) {
    const int which = -1 - constraint, pose = pose_of_spectrum(p, out.state, which);
    const PoseSpectrum& s = spectrum_alone(p, which, out);
    const auto [top, bottom] = condition_pair(s, row);
    add_log_sigma(out.state, pose, s, bottom, 1.0, gradient);
    add_log_sigma(out.state, pose, s, top, -1.0, gradient);
  }
  double margin;
  evaluate_margins(p, out, {&p.margins[at_index(k)], 1}, &margin);
  if (constraint >= 0 && margin > worst_margin)
    p.constraints[at_index(constraint)]->add_gradient(out.state, row, gradient);
  if (!gradient.allFinite()) gradient.setZero();  // at a singularity
  return margin;
}

double evaluate_index(const PreparedProblem& p, DesignEvaluation& out, int pose, Row gradient) {
  gradient.setZero();
  const PoseSpectrum& s = spectrum_alone(p, pose, out);
  const double index = add_index(p.problem.objective.index, out.state, out.state.first_pose + pose, s, gradient);
  if (!gradient.allFinite()) gradient.setZero();
  return index;
}

int pose_of_margin(const PreparedProblem& p, const DesignState& state, int k) {
  const auto [constraint, row] = p.margins[at_index(k)];
  return constraint < 0 ? pose_of_spectrum(p, state, -1 - constraint)
                        : p.constraints[at_index(constraint)]->pose_of(state, row);
}

std::vector<int> poses_of_margin(const PreparedProblem& p, const DesignState& state, int k) {
  const auto [constraint, row] = p.margins[at_index(k)];
  if (constraint < 0) return {pose_of_margin(p, state, k)};
  return p.constraints[at_index(constraint)]->poses_of(state, row);
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
  if (on_axis(p.problem, p.pose_specs.front().pose))
    closed_spectrum(*p.family, design.state, p.pose_specs.front(), Machine::nine_legged, s);
  else general_spectra(design.state, std::array{0}, std::array{&s}, false);
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
