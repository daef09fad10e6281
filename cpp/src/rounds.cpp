#include "rounds.hpp"

#include <algorithm>
#include <cmath>

#include "ninedof/parallel.hpp"

namespace ninedof {
namespace {

/// Equal machines up to reflection and to variables that do not matter: same quantities.
bool same_design(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff() < 1e-4;
}

/// Whether `a` is the one to show of two ends that are the same design: not worse, and first in the order of variables
/// (which of two mirror images is shown must not hang on rounding), or the same image and more nearly stationary.
bool stands_for(const Candidate& a, const Candidate& b) {
  if (a.condition_number > b.condition_number * (1.0 + 1e-9)) return false;
  for (Eigen::Index k = 0; k < a.variables.size(); ++k) {
    const double tolerance = 1e-4 * std::max(std::abs(a.variables[k]), std::abs(b.variables[k]));
    if (std::abs(a.variables[k] - b.variables[k]) > tolerance) return a.variables[k] < b.variables[k];
  }
  return a.optimality_residual < b.optimality_residual;
}

/// Whether a run has ended where we cut an angle without bounds: no optimum of the study.
bool at_cut_angle(const Prepared& p, const Candidate& c) {
  const Eigen::VectorXd y = p.coordinates.coordinates(c.variables);
  for (int k = 0; k < p.coordinates.size(); ++k) {
    if (!p.family->variables()[static_cast<std::size_t>(p.coordinates.variable(k))].is_angle) continue;
    if (p.coordinates.capped_low(k) && y[k] - p.coordinates.low()[k] < 1e-6) return true;
    if (p.coordinates.capped_high(k) && p.coordinates.high()[k] - y[k] < 1e-6) return true;
  }
  return false;
}

bool acceptable(const Prepared& p, const Candidate& c) {
  return c.feasible() && c.stationary() && c.regular() && !at_cut_angle(p, c);
}

}  // namespace

int start_count(const Prepared& p, const Settings& s) {
  return p.coordinates.size() == 0 ? 1 : s.starts;
}

Round run_round(const Prepared& p, const Settings& s, const Control& control, Progress& progress) {
  const int count = start_count(p, s);
  Round round;
  round.runs.resize(static_cast<std::size_t>(count));
  parallel_for(count, 1, s.threads, [&](long first, long) {
    if (control.stop.stop_requested()) return;
    Run run = minimise(p, p.coordinates.start(static_cast<int>(first), s.seed), Formulation::minimax, s.max_evaluations,
                       control.stop);
    progress.finished(run.end);
    round.runs[static_cast<std::size_t>(first)] = std::move(run);
  });
  for (const auto& run : round.runs) {
    if (!run) continue;
    round.evaluations += run->evaluations;
    ++round.done;
  }
  return round;
}

std::vector<Candidate> distinct(const Prepared& p, const Round& round) {
  std::vector<Candidate> ends;
  for (const auto& run : round.runs)
    if (run && acceptable(p, run->end)) ends.push_back(run->end);
  std::stable_sort(ends.begin(), ends.end(),
                   [](const Candidate& a, const Candidate& b) { return a.condition_number < b.condition_number; });
  std::vector<Candidate> out;
  std::vector<Eigen::VectorXd> signatures;
  for (Candidate& end : ends) {
    DesignPoint point;
    p.family->evaluate({end.variables.data(), static_cast<std::size_t>(end.variables.size())},
                       p.problem.characteristic_length, point);
    std::size_t k = 0;
    while (k < out.size() && !same_design(signatures[k], point.value)) ++k;
    if (k == out.size()) {
      out.push_back(std::move(end));
      signatures.emplace_back(point.value);
      out[k].reached = 1;
      continue;
    }
    const int reached = out[k].reached + 1;
    if (stands_for(end, out[k])) out[k] = std::move(end);
    out[k].reached = reached;
  }
  return out;
}

std::optional<Candidate> best_allowed(const Round& round) {
  std::optional<Candidate> best;
  for (const auto& run : round.runs) {
    if (!run || !run->end.feasible() || !run->end.regular()) continue;
    if (!best || run->end.condition_number < best->condition_number) best = run->end;
  }
  if (best) best->reached = 1;
  return best;
}

}  // namespace ninedof
