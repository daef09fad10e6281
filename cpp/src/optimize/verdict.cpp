#include "optimize/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ninedof {
namespace {

/// Variables without a serious upper bound are let run to these sizes, one round each: far beyond all that is bounded. The
/// last, wide step tells a flight from an optimum far out; beyond `largest` characteristic lengths it is left away, where
/// rounding in zp - zs blurs the index.
constexpr std::array<double, 4> stretches{1.0, 10.0, 100.0, 1e4};
constexpr double largest = 1e7;
/// Relative gain over the caps that counts as still improving, and a loss that is rounding.
constexpr double still_improving = 1e-7, rounding = 1e-8;

std::string join(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : ", ") + w;
  return out;
}

bool runs_to_cap(const Prepared& p, const Candidate& best) {
  const Eigen::VectorXd y = p.coordinates.coordinates(best.variables);
  for (int k = 0; k < p.coordinates.size(); ++k) {
    if (p.coordinates.info(k).ours || p.coordinates.info(k).kind == VariableKind::angle) continue;
    if (p.coordinates.capped_high(k) && p.coordinates.high()[k] - y[k] < 1e-3) return true;
    if (p.coordinates.capped_low(k) && y[k] - p.coordinates.low()[k] < 1e-3) return true;
  }
  return false;
}

/// Unbounded: the best design runs to every cap, none is worse than the one before, and together they improve the index.
/// (A variable of no use to the index may run to a cap by chance.)
bool keeps_improving(const std::vector<Leader>& leaders) {
  if (leaders.size() < 3) return false;
  for (std::size_t k = 0; k < leaders.size(); ++k) {
    if (!leaders[k].at_cap) return false;
    if (k > 0 && leaders[k].best.objective > leaders[k - 1].best.objective * (1.0 + rounding)) return false;
  }
  return leaders.back().best.objective < leaders.front().best.objective * (1.0 - still_improving);
}

/// Variables without a serious bound that grow from cap to cap.
std::vector<std::string> growing(const Problem& problem, const std::vector<Leader>& leaders) {
  std::vector<std::string> names;
  const auto& info = design_family(problem.family).variables();
  for (std::size_t v = 0; v < info.size(); ++v) {
    const auto at = [&](const Leader& l) { return std::abs(l.best.variables[static_cast<Eigen::Index>(v)]); };
    const Bounds& b = problem.variables[v];
    const bool open =
        !serious_bound(problem, b.high) || (info[v].kind == VariableKind::coordinate && !serious_bound(problem, b.low));
    bool grows = info[v].kind != VariableKind::angle && b.low < b.high && open;
    for (std::size_t k = 1; grows && k < leaders.size(); ++k) grows = at(leaders[k]) > 1.5 * at(leaders[k - 1]);
    if (grows) names.push_back(info[v].name);
  }
  return names;
}

std::string unbounded_reason(const std::vector<Leader>& leaders, const std::vector<std::string>& causes) {
  std::string text = "no least value: it keeps falling as " + join(causes) + " run away (";
  for (const Leader& l : leaders) {
    if (l.cap > leaders.front().cap) text += ", ";
    text += format_number(std::round(l.best.objective * 1e6) / 1e6) + " at size " + format_number(l.cap);
  }
  return text + "); a bound of a million characteristic lengths or more counts as none";
}

}  // namespace

std::vector<double> caps(const Problem& p) {
  const auto& info = design_family(p.family).variables();
  double size = p.unit();
  bool open = false;
  for (std::size_t k = 0; k < info.size(); ++k) {
    if (info[k].kind == VariableKind::angle) continue;
    const Bounds& b = p.variables[k];
    const bool coordinate = info[k].kind == VariableKind::coordinate;
    const bool serious = b.low == b.high || (serious_bound(p, b.high) && (!coordinate || serious_bound(p, b.low)));
    open |= !serious;
    size = std::max(size, serious ? std::abs(b.high) : std::abs(b.low) < 1e6 * p.unit() ? std::abs(b.low) : 0.0);
  }
  std::vector<double> out;
  const double first = std::max(10.0 * size, 100.0 * p.unit());
  for (const double stretch : stretches)
    if (stretch * first <= largest * p.unit() || out.size() < 3) out.push_back(stretch * first);
  if (!open) out.resize(1);
  return out;
}

Leader leader(const Prepared& p, double cap, const Candidate& best) {
  return {cap, best, runs_to_cap(p, best)};
}

void judge_unbounded(const Problem& problem, std::vector<Leader> leaders, Result& result) {
  // A larger size allows all that a smaller one does: worse is a search that failed, for rounding in zp - zs, and tells nothing.
  while (leaders.size() > 3 &&
         leaders.back().best.objective > leaders[leaders.size() - 2].best.objective * (1.0 + rounding))
    leaders.pop_back();
  if (keeps_improving(leaders)) {
    result.status = Status::unbounded;
    result.causes = growing(problem, leaders);
    result.reason = unbounded_reason(leaders, result.causes);
    return;
  }
  const auto best = std::ranges::min_element(
      leaders, [](const Leader& a, const Leader& b) { return a.best.objective < b.best.objective; });
  if (!best->at_cap) return;
  result.status = Status::stopped;
  result.reason = "the best design found stands at size " + format_number(best->cap) +
                  ", where a search without bounds was cut off, and does not keep improving: bound the variables";
}

bool judge_order(const Problem& problem, Result& result) {
  const auto& info = design_family(problem.family).variables();
  for (std::size_t k = 0; k < info.size(); ++k) {
    if ((info[k].name != "zp" && info[k].name != "zs") || problem.variables[k].high > 0.0) continue;
    result.causes = {info[k].name, "zp > zs"};
    result.reason = "0 < zs < zp (eq. 9b) leaves no design: " + info[k].name + " is 0";
  }
  for (const Limit& limit : problem.limits) {
    if (limit.name != "zs_fraction" || limit.low < 1.0) continue;
    result.causes = {limit.name, "zp > zs"};
    result.reason = "0 < zs < zp (eq. 9b) leaves no design: zs_fraction must be at least " + format_number(limit.low) +
                    " against zp > zs";
  }
  if (!result.causes.empty()) result.status = Status::infeasible;
  return !result.causes.empty();
}

void explain_failure(const Prepared& p, const Round& round, const Settings& s, const Control& control, Result& result) {
  if (std::optional<Candidate> best = best_allowed(round)) {
    result.candidates.push_back(*std::move(best));
    result.reason = "no start passed the checks of optimality, so this is no optimum: raise starts or max_evaluations";
    return;
  }
  std::optional<Violation> least;
  const int count = std::min(start_count(p, s), 8);
  for (int k = 0; k < count && !control.stop.stop_requested(); ++k) {
    Violation v = least_violation(p, p.coordinates.start(k, s.seed), s.max_evaluations, control.stop);
    result.evaluations += v.evaluations;
    if (!least || v.end.constraint_violation < least->end.constraint_violation) least = std::move(v);
    if (least->end.feasible()) break;
  }
  if (!least || control.stop.stop_requested()) return;
  result.status = Status::infeasible;
  if (least->end.feasible()) {
    result.reason = "all designs reached within the limits are singular: none has a finite condition number";
    if (p.problem.objective.index == Index::speed && std::isinf(p.problem.objective.condition_limit))
      result.reason += "; the index speed needs a limit on it (condition_limit)";
    return;
  }
  result.causes = least->causes;
  const double amount = std::round(least->end.constraint_violation * 1e4) / 1e4;
  result.reason = "no design found satisfies all limits; at the least violation, " + format_number(amount) +
                  " in the logarithm of a ratio, these are in conflict: " + join(least->causes);
}

}  // namespace ninedof
