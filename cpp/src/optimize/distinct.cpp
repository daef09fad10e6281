/// Declared in optimize/search_round.hpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "math/sort_by.hpp"
#include "optimize/search_round.hpp"

namespace ninedof {
namespace {

/// Relative difference of objectives that count as equal, and difference of signatures of one design.
constexpr double same_objective = 1e-7, same_design = 1e-4;
/// Optima need not be isolated: of many designs with one objective this many are returned.
constexpr int most_alike = 4;

/// Lengths below this, in mean leg lengths, count as one.
constexpr double negligible = 1e-9;

/// Least slope of an objective row or margin, and least change, that counts as dependence on a variable.
constexpr double dependence = 1e-9;

/// The design at `y`, with every variable at its lower bound (or 0) that neither the objective nor a limit depends on.
DesignEvaluation evaluate_what_matters(const PreparedProblem& p, Eigen::VectorXd y) {
  DesignEvaluation design, moved;
  evaluate_design(p, y, design);
  const auto largest = [](const auto& m) { return m.size() > 0 ? m.cwiseAbs().maxCoeff() : 0.0; };
  for (int k = 0; k < p.coordinates.size(); ++k) {
    if (!(largest(design.row_gradient.col(k)) <= dependence && largest(design.margin_gradient.col(k)) <= dependence))
      continue;
    Eigen::VectorXd next = y;
    next[k] = std::isfinite(p.coordinates.low()[k]) ? p.coordinates.low()[k] : 0.0;
    evaluate_design(p, next, moved);
    if (p.coordinates.order_margin(next) < 0.0 || !(largest(moved.margins - design.margins) <= dependence) ||
        !(largest(moved.objective_rows - design.objective_rows) <= dependence))
      continue;
    y = next;
    std::swap(design, moved);
  }
  return design;
}

/// Numbers that agree for equal robots up to reflection, renumbering, a shift along z, size where only the shape
/// matters, and variables without effect: logarithms of neutral leg lengths, joint radii and the height of the platform
/// above O in mean leg lengths, and of condition numbers.
Eigen::VectorXd signature(const PreparedProblem& p, const Candidate& c) {
  const DesignEvaluation design = evaluate_what_matters(p, p.coordinates.coordinates(c.variables));
  std::vector<double> all(design.state.pose(0).legs.length.begin(), design.state.pose(0).legs.length.end());
  for (const Vec3& joint : design.state.blueprint.joint) all.push_back(joint.head<2>().norm());
  std::sort(all.begin(), all.begin() + 9);
  std::sort(all.begin() + 9, all.begin() + 15);
  std::sort(all.begin() + 15, all.end());
  all.push_back(design.state.blueprint.zp - design.state.blueprint.zs);
  const double size = design.state.pose(0).legs.length.mean();
  for (double& length : all) length = std::max(length / size, negligible);
  all.push_back(neutral_condition(p, design));
  all.push_back(c.objective);
  const std::vector<double> at_poses = conditions(p, design);
  const auto sorted_too = all.insert(all.end(), at_poses.begin(), at_poses.end());
  std::sort(sorted_too, all.end());
  Eigen::VectorXd out = Eigen::VectorXd::Map(all.data(), static_cast<Eigen::Index>(all.size()));
  return out.cwiseMax(1e-300).cwiseMin(1e300).array().log();
}

/// Distances of all points of the neutral robot from each other, in mean leg lengths, sorted by what they join: the
/// same for robots that differ by a rotation, a reflection or a numbering of the joints. External joints keep their
/// partners.
Eigen::VectorXd shape(const PreparedProblem& p, const Candidate& c) {
  DesignEvaluation design;
  evaluate_design(p, p.coordinates.coordinates(c.variables), design);
  const PoseState& neutral = design.state.pose(0);
  const auto kind = [](int point) { return point < point_p ? point / 3 : point; };
  std::map<std::array<int, 3>, std::vector<double>> groups;
  for (int a = 0; a < point_count; ++a)
    for (int b = 0; b < a; ++b) {
      const int partners = a == point_u + b - point_r && b < point_r_hat;
      const double apart = (neutral.at[at_index(a)] - neutral.at[at_index(b)]).norm();
      groups[{kind(a), kind(b), partners}].push_back(apart / neutral.legs.length.mean());
    }
  std::vector<double> all;
  for (auto& [points, distances] : groups) {
    std::ranges::sort(distances);
    all.insert(all.end(), distances.begin(), distances.end());
  }
  return Eigen::VectorXd::Map(all.data(), static_cast<Eigen::Index>(all.size()));
}

/// Whether `a` represents two end points of the same design: not worse, and first in the order of variables (the choice
/// between mirror images must not depend on rounding), or the same image and more nearly stationary.
bool represents(const Candidate& a, const Candidate& b) {
  if (a.objective > b.objective * (1.0 + 1e-9)) return false;
  for (Eigen::Index k = 0; k < a.variables.size(); ++k) {
    const double tolerance = 1e-4 * std::max(std::abs(a.variables[k]), std::abs(b.variables[k]));
    if (std::abs(a.variables[k] - b.variables[k]) > tolerance) return a.variables[k] < b.variables[k];
  }
  return a.optimality_residual < b.optimality_residual;
}

/// On an internal bound of an "optimal" length a run has found no optimum of the study.
bool acceptable(const PreparedProblem& p, const Candidate& c) {
  const auto counts = [](const Variable& v) { return v.kind == VariableKind::length && v.internal_bounds; };
  return c.feasible() && c.stationary() && c.regular() &&
         !near_internal_bound(p.coordinates, c.variables, 1e-6, counts);
}

bool same_value(double a, double b) {
  return std::abs(a - b) <= same_objective * b;
}

}  // namespace

std::vector<Candidate> distinct_candidates(const PreparedProblem& p, const SearchRound& round) {
  std::vector<Candidate> ends;
  std::vector<double> from_starts;  // objectives that starts ended at
  for (std::size_t k = 0; k < round.runs.size(); ++k) {
    if (!round.runs[k] || !acceptable(p, round.runs[k]->end)) continue;
    ends.push_back(round.runs[k]->end);
    if (round.from_start[k]) from_starts.push_back(ends.back().objective);
  }
  sort_by(ends, &Candidate::objective);
  std::vector<Candidate> out;
  std::vector<Eigen::VectorXd> signatures, shapes;
  int alike = 0;
  for (Candidate& end : ends) {
    const Eigen::VectorXd mark = signature(p, end), form = shape(p, end);
    // A mirror image may be worse at poses that do not decide: its condition numbers differ, its objective does not.
    const auto known = [&](std::size_t k) {
      return (signatures[k] - mark).cwiseAbs().maxCoeff() < same_design ||
             ((shapes[k] - form).cwiseAbs().maxCoeff() < same_design && same_value(end.objective, out[k].objective));
    };
    std::size_t k = 0;
    while (k < out.size() && !known(k)) ++k;
    if (k < out.size()) {
      if (represents(end, out[k])) out[k] = std::move(end);
      continue;
    }
    alike = !out.empty() && same_value(end.objective, out.back().objective) ? alike + 1 : 0;
    if (alike >= most_alike) continue;
    out.push_back(std::move(end));
    signatures.push_back(mark);
    shapes.push_back(form);
  }
  for (Candidate& c : out)
    c.reached =
        static_cast<int>(std::ranges::count_if(from_starts, [&](double f) { return same_value(f, c.objective); }));
  return out;
}

void discount_warm(const PreparedProblem& p, const SearchRound& round, std::vector<Candidate>& candidates) {
  for (std::size_t k = 0; k < std::min(at_index(round.warm), round.runs.size()); ++k) {
    if (!round.runs[k] || !acceptable(p, round.runs[k]->end)) continue;
    for (Candidate& c : candidates) c.reached -= same_value(round.runs[k]->end.objective, c.objective);
  }
}

std::optional<Candidate> best_feasible(const SearchRound& round) {
  std::optional<Candidate> best;
  for (const auto& run : round.runs) {
    if (!run || !run->end.feasible() || !run->end.regular()) continue;
    if (!best || run->end.objective < best->objective) best = run->end;
  }
  if (best) best->reached = 1;
  return best;
}

}  // namespace ninedof
