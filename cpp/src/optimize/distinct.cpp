/// Declared in optimize/rounds.hpp.

#include <algorithm>
#include <cmath>

#include "optimize/rounds.hpp"

namespace ninedof {
namespace {

/// Relative difference of objectives that counts as none.
constexpr double same_objective = 1e-7;
/// Optima need not be isolated: of many designs with one objective this many are shown.
constexpr int most_alike = 4;

/// Numbers that equal machines share up to reflection, renumbering and variables that do not matter: logarithms of neutral
/// leg lengths, of joint radii and heights, and of condition numbers.
Eigen::VectorXd signature(const Prepared& p, const Candidate& c) {
  Look l;
  look(p, p.coordinates.coordinates(c.variables), l);
  std::vector<double> all(l.view.pose(0).legs.length.begin(), l.view.pose(0).legs.length.end());
  for (int joint = 0; joint < 12; ++joint) all.push_back(joint_radius(l.view, joint));
  std::sort(all.begin(), all.begin() + 9);
  std::sort(all.begin() + 9, all.begin() + 15);
  std::sort(all.begin() + 15, all.end());
  all.push_back(l.view.blueprint.zp);
  all.push_back(l.view.blueprint.zs);
  all.push_back(c.condition_number);
  all.push_back(c.objective);
  const auto conditions = all.insert(all.end(), c.conditions.begin(), c.conditions.end());
  std::sort(conditions, all.end());
  Eigen::VectorXd out = Eigen::VectorXd::Map(all.data(), static_cast<Eigen::Index>(all.size()));
  return out.cwiseMax(1e-300).cwiseMin(1e300).array().log();
}

bool same_design(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff() < 1e-4;
}

/// Whether `a` is the one to show of two ends that are the same design: not worse, and first in the order of variables
/// (which of two mirror images is shown must not hang on rounding), or the same image and more nearly stationary.
bool stands_for(const Candidate& a, const Candidate& b) {
  if (a.objective > b.objective * (1.0 + 1e-9)) return false;
  for (Eigen::Index k = 0; k < a.variables.size(); ++k) {
    const double tolerance = 1e-4 * std::max(std::abs(a.variables[k]), std::abs(b.variables[k]));
    if (std::abs(a.variables[k] - b.variables[k]) > tolerance) return a.variables[k] < b.variables[k];
  }
  return a.optimality_residual < b.optimality_residual;
}

/// Whether a run has ended where we cut an angle without bounds, or on our range of an "optimal" length: no optimum of the study.
bool at_cut(const Prepared& p, const Candidate& c) {
  const Eigen::VectorXd y = p.coordinates.coordinates(c.variables);
  for (int k = 0; k < p.coordinates.size(); ++k) {
    const Variable& v = p.coordinates.info(k);
    if (v.kind != VariableKind::angle && !(v.kind == VariableKind::length && v.ours)) continue;
    if (p.coordinates.capped_low(k) && y[k] - p.coordinates.low()[k] < 1e-6) return true;
    if (p.coordinates.capped_high(k) && p.coordinates.high()[k] - y[k] < 1e-6) return true;
  }
  return false;
}

bool acceptable(const Prepared& p, const Candidate& c) {
  return c.feasible() && c.stationary() && c.regular() && !at_cut(p, c);
}

}  // namespace

std::vector<Candidate> distinct(const Prepared& p, const Round& round) {
  std::vector<Candidate> ends;
  std::vector<double> from_starts;  // objectives that starts ended at
  for (std::size_t k = 0; k < round.runs.size(); ++k) {
    if (!round.runs[k] || !acceptable(p, round.runs[k]->end)) continue;
    ends.push_back(round.runs[k]->end);
    if (k < round.from_starts) from_starts.push_back(ends.back().objective);
  }
  std::stable_sort(ends.begin(), ends.end(),
                   [](const Candidate& a, const Candidate& b) { return a.objective < b.objective; });
  const auto same = [](double a, double b) { return std::abs(a - b) <= same_objective * b; };
  std::vector<Candidate> out;
  std::vector<Eigen::VectorXd> signatures;
  int alike = 0;
  for (Candidate& end : ends) {
    const Eigen::VectorXd mark = signature(p, end);
    std::size_t k = 0;
    while (k < out.size() && !same_design(signatures[k], mark)) ++k;
    if (k < out.size()) {
      if (stands_for(end, out[k])) out[k] = std::move(end);
      continue;
    }
    alike = !out.empty() && same(end.objective, out.back().objective) ? alike + 1 : 0;
    if (alike >= most_alike) continue;
    out.push_back(std::move(end));
    signatures.push_back(mark);
  }
  for (Candidate& c : out)
    c.reached = static_cast<int>(std::ranges::count_if(from_starts, [&](double f) { return same(f, c.objective); }));
  return out;
}

std::optional<Candidate> best_allowed(const Round& round) {
  std::optional<Candidate> best;
  for (const auto& run : round.runs) {
    if (!run || !run->end.feasible() || !run->end.regular()) continue;
    if (!best || run->end.objective < best->objective) best = run->end;
  }
  if (best) best->reached = 1;
  return best;
}

}  // namespace ninedof
