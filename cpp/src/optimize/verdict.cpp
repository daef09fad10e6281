#include "optimize/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "limits/rows.hpp"
#include "math/sort_by.hpp"
#include "ninedof/math/error.hpp"
#include "ninedof/robot/architecture_singularity.hpp"
#include "optimize/conflict.hpp"

namespace ninedof {
namespace {

/// Size limits of variables without an effective upper bound, one round each, as multiples of the first, which lies far
/// above all bounded variables. The last, wide step separates an unbounded problem from an optimum far out. It is
/// omitted beyond `largest` characteristic lengths, where rounding in zp - zs disturbs the index.
constexpr std::array<double, 4> stretches{1.0, 10.0, 100.0, 1e4};
constexpr double largest = 1e7;
/// Relative gain over all rounds that counts as still improving, and a loss that is rounding.
constexpr double still_improving = 1e-7, rounding = 1e-8;

std::string join(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : ", ") + w;
  return out;
}

/// The few ends that violate the limits least.
std::vector<Eigen::VectorXd> nearest_ends(const SearchRound& round) {
  constexpr std::size_t few = 4;
  std::vector<const Candidate*> ends;
  for (const auto& run : round.runs)
    if (run) ends.push_back(&run->end);
  sort_by(ends, &Candidate::constraint_violation);
  std::vector<Eigen::VectorXd> out;
  for (std::size_t k = 0; k < std::min(few, ends.size()); ++k) out.push_back(ends[k]->variables);
  return out;
}

/// Why a design is singular at every pose, or at every position of one of its orientations; empty if it is not.
std::string architecture_reason(const Problem& problem, const Eigen::VectorXd& x) {
  try {
    const Geometry g = geometry(problem, x);
    for (const Configuration& c : configurations(problem, x))
      if (homothety_residual(g, c.rotation) <= 1e-9)
        return "its external triangles are similar and, at the orientation of the pose, parallel: det N is 0 at all "
               "positions, wherever O is";
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "";
}

/// Unbounded: the best design of every round is at its size limit, none is worse than the one before, and together they
/// improve the index. (A variable without effect on the index may be at its limit by chance.)
bool keeps_improving(const std::vector<RoundBest>& rounds) {
  if (rounds.size() < 3) return false;
  for (std::size_t k = 0; k < rounds.size(); ++k) {
    if (!rounds[k].at_size_limit) return false;
    if (k > 0 && rounds[k].best.objective > rounds[k - 1].best.objective * (1.0 + rounding)) return false;
  }
  return rounds.back().best.objective < rounds.front().best.objective * (1.0 - still_improving);
}

/// Whether a variable has no effective bound on a side that it needs.
bool open_ended(const Problem& problem, VariableKind kind, const Bounds& b) {
  return b.low < b.high && (!is_effective_bound(problem, b.high) ||
                            (kind == VariableKind::coordinate && !is_effective_bound(problem, b.low)));
}

/// Variables without an effective bound that grow from round to round.
std::vector<std::string> growing(const Problem& problem, const std::vector<RoundBest>& rounds) {
  std::vector<std::string> names;
  const auto& info = design_family(problem.family).variables();
  for (std::size_t v = 0; v < info.size(); ++v) {
    const auto at = [&](const RoundBest& r) { return std::abs(r.best.variables[static_cast<Eigen::Index>(v)]); };
    const Bounds& b = problem.variables[v];
    bool grows = info[v].kind != VariableKind::angle && open_ended(problem, info[v].kind, b);
    for (std::size_t k = 1; grows && k < rounds.size(); ++k) grows = at(rounds[k]) > 1.5 * at(rounds[k - 1]);
    if (grows) names.push_back(info[v].name);
  }
  return names;
}

std::string unbounded_reason(const std::vector<RoundBest>& rounds, const std::vector<std::string>& causes) {
  std::string text = "no least value: it keeps falling as " + join(causes) + " run away (";
  for (const RoundBest& r : rounds) {
    if (r.size_limit > rounds.front().size_limit) text += ", ";
    text += format_number(std::round(r.best.objective * 1e6) / 1e6) + " at size " + format_number(r.size_limit);
  }
  return text + "); a bound of a million characteristic lengths or more counts as none";
}

}  // namespace

const char* to_string(Status status) {
  switch (status) {
    case Status::optimal: return "optimal";
    case Status::unbounded: return "unbounded";
    case Status::infeasible: return "infeasible";
    case Status::stopped: return "stopped";
  }
  return "stopped";
}

std::vector<double> size_limits(const Problem& p) {
  const auto& info = design_family(p.family).variables();
  double size = p.unit();
  bool open = false;
  for (std::size_t k = 0; k < info.size(); ++k) {
    if (info[k].kind == VariableKind::angle) continue;
    const Bounds& b = p.variables[k];
    const bool without_end = open_ended(p, info[k].kind, b);
    open |= without_end;
    size = std::max(size, !without_end ? std::abs(b.high) : std::abs(b.low) < 1e6 * p.unit() ? std::abs(b.low) : 0.0);
  }
  std::vector<double> out;
  const double first = std::max(10.0 * size, 100.0 * p.unit());
  for (const double stretch : stretches)
    if (stretch * first <= largest * p.unit() || out.size() < 3) out.push_back(stretch * first);
  if (!open) out.resize(1);
  return out;
}

RoundBest round_best(const PreparedProblem& p, double size_limit, const Candidate& best) {
  const bool reached = near_internal_bound(p.coordinates, best.variables, 1e-3, [](const Variable& v) {
    return !v.internal_bounds && v.kind != VariableKind::angle;
  });
  return {size_limit, best, reached};
}

void detect_unbounded(const Problem& problem, std::vector<RoundBest> rounds, Result& result) {
  // A larger size limit admits every design of a smaller one. If the last round is worse, its search failed because of
  // rounding in zp - zs, and it is not counted.
  while (rounds.size() > 3 &&
         rounds.back().best.objective > rounds[rounds.size() - 2].best.objective * (1.0 + rounding))
    rounds.pop_back();
  if (keeps_improving(rounds)) {
    result.status = Status::unbounded;
    result.causes = growing(problem, rounds);
    result.reason = unbounded_reason(rounds, result.causes);
    return;
  }
  const auto best = std::ranges::min_element(
      rounds, [](const RoundBest& a, const RoundBest& b) { return a.best.objective < b.best.objective; });
  if (!best->at_size_limit) return;
  result.status = Status::stopped;
  result.reason = "the best design found stands at size " + format_number(best->size_limit) +
                  ", where a search without bounds was cut off, and does not keep improving: bound the variables";
}

bool detect_impossible_heights(const Problem& problem, Result& result) {
  const auto& info = design_family(problem.family).variables();
  const std::string order = "zp > zs";
  const auto bounds = [&](const char* name) {
    return problem.variables[at_index(design_family(problem.family).index(name))];
  };
  const Bounds zp = bounds("zp"), zs = bounds("zs");
  const std::string none = "0 < zs < zp (eq. 9b) leaves no design: ";
  for (const VariableInfo& variable : info) {
    if ((variable.name != "zp" && variable.name != "zs") || bounds(variable.name.c_str()).high > 0.0) continue;
    result.causes = {variable.name, order};
    result.reason = none + variable.name + " is 0";
  }
  if (result.causes.empty() && zp.high <= zs.low) {
    result.causes = {"zp", "zs", order};
    result.reason = none + "zp is at most " + format_number(zp.high) + ", zs at least " + format_number(zs.low) +
                    ", against zp > zs";
  }
  for (const Limit& limit : problem.limits) {
    if (limit_row(limit.name).design != &zs_fraction_row || limit.low < 1.0) continue;
    result.causes = {limit.label(), order};
    result.reason = none + limit.label() + " must be at least " + format_number(limit.low) + " against zp > zs";
  }
  if (!result.causes.empty()) result.status = Status::infeasible;
  return !result.causes.empty();
}

void explain_failure(const PreparedProblem& p, const SearchRound& round, const Settings& s, const Control& control,
                     Result& result) {
  if (std::optional<Candidate> best = best_feasible(round)) {
    result.candidates.push_back(*std::move(best));
    result.reason =
        "no start passed the checks of optimality, so this is no optimum: raise starts, or try another seed";
    return;
  }
  Conflict conflict = find_conflict(p.problem, nearest_ends(round), s, control);
  result.evaluations += conflict.evaluations;
  if (control.stop.stop_requested()) return;
  if (conflict.allowed.size() == 0) {
    result.status = Status::infeasible;
    result.causes = std::move(conflict.causes);
    result.cause_poses = std::move(conflict.poses);
    result.reason = std::move(conflict.reason);
    return;
  }
  Candidate allowed = candidate_at(p, p.coordinates.coordinates(conflict.allowed));
  if (allowed.regular() && allowed.feasible()) {
    const LocalRun run = run_from_start(p, p.coordinates.coordinates(conflict.allowed), Formulation::minimax,
                                        {s.max_evaluations}, control.stop);
    result.evaluations += run.evaluations;
    const bool solved = run.end.feasible() && run.end.regular() && run.end.stationary() &&
                        !round_best(p, infinity, run.end).at_size_limit;
    result.candidates.push_back(solved ? run.end : std::move(allowed));
    result.candidates.front().reached = 0;
    if (solved) result.status = Status::optimal;
    result.reason = solved
                        ? "feasible and stationary by our own checks"
                        : "no start ended within the limits, though designs are: this one is no optimum; raise starts";
    return;
  }
  result.status = Status::infeasible;
  result.reason = "all designs reached within the limits are singular: none has a finite condition number";
  if (const std::string why = architecture_reason(p.problem, conflict.allowed); !why.empty())
    result.reason += "; the last of them by its architecture: " + why;
  if (p.problem.objective.index == Index::speed && std::isinf(p.problem.objective.condition_limit))
    result.reason += "; the index speed needs a limit on it (condition_limit)";
}

}  // namespace ninedof
