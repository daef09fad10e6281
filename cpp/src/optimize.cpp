#include "ninedof/optimize.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>

#include "minimax.hpp"
#include "ninedof/parallel.hpp"

namespace ninedof {
namespace {

/// Variables without a serious upper bound are let run to these sizes, one round each: far beyond all that is bounded, and
/// not so far that rounding in zp - zs blurs the index.
constexpr std::array<double, 3> stretches{1.0, 10.0, 100.0};
/// Relative gain over the caps that counts as still improving, and a loss that is rounding.
constexpr double still_improving = 1e-7, rounding = 1e-8;
/// A condition number beyond this is rounding away from a singular design.
constexpr double worst_regular = 1e14;

/// The caps of the rounds: one that does not matter where every variable has a serious bound.
std::vector<double> caps(const Problem& p) {
  const auto& info = design_family(p.family).variables();
  double size = p.characteristic_length;
  bool open = false;
  for (std::size_t k = 0; k < info.size(); ++k) {
    if (info[k].is_angle) continue;
    const Bounds& b = p.variables[k];
    const bool serious = b.low == b.high || serious_bound(p, b.high);
    open |= !serious;
    size = std::max(size, serious ? b.high : b.low);
  }
  std::vector<double> out;
  const double first = std::max(10.0 * size, 100.0 * p.characteristic_length);
  for (const double stretch : stretches) out.push_back(stretch * first);
  if (!open) out.resize(1);
  return out;
}

/// Runs of one round, and what they cost.
struct Round {
  std::vector<std::optional<Run>> runs;
  long evaluations = 0;
  int done = 0;
};

/// Counts finished starts over all rounds and passes on what is new, one caller at a time.
class Progress {
 public:
  Progress(const Control& control, int total) : control_(control), total_(total) {}
  void finished(const Candidate& c) {
    const std::lock_guard lock(guard_);
    ++done_;
    if (c.feasible()) best_ = std::min(best_, c.condition_number);
    if (control_.progress) control_.progress(done_, total_, best_);
  }

 private:
  const Control& control_;
  std::mutex guard_;
  int total_, done_ = 0;
  double best_ = std::numeric_limits<double>::infinity();
};

/// Starts of one round: a design without free variables is looked at once.
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
  return c.feasible() && c.stationary() && c.condition_number < worst_regular && !at_cut_angle(p, c);
}

/// Distinct acceptable ends, best first.
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

std::string join(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : ", ") + w;
  return out;
}

bool all_singular(const Round& round) {
  return std::none_of(round.runs.begin(), round.runs.end(), [](const std::optional<Run>& run) {
    return run && run->end.feasible() && run->end.condition_number < worst_regular;
  });
}

/// The height, zp or zs, that the bounds hold at zero; empty if none.
std::string flat_height(const Problem& problem) {
  const auto& info = design_family(problem.family).variables();
  for (std::size_t k = 0; k < info.size(); ++k)
    if ((info[k].name == "zp" || info[k].name == "zs") && problem.variables[k].high <= 0.0) return info[k].name;
  return {};
}

/// No start ended well: is there a design within the limits at all? If not, says which limits fight.
void explain_failure(const Prepared& p, const Round& round, const Settings& s, const Control& control, Result& result) {
  std::optional<Violation> least;
  const int count = std::min(start_count(p, s), 8);
  for (int k = 0; k < count && !control.stop.stop_requested(); ++k) {
    Violation v = least_violation(p, p.coordinates.start(k, s.seed), s.max_evaluations, control.stop);
    result.evaluations += v.evaluations;
    if (!least || v.end.constraint_violation < least->end.constraint_violation) least = std::move(v);
    if (least->end.feasible()) break;
  }
  if (!least || control.stop.stop_requested()) return;
  if (!least->end.feasible()) {
    result.status = Status::infeasible;
    result.causes = least->causes;
    result.reason = "no design satisfies all limits: these are in conflict, by at least " +
                    format_number(least->end.constraint_violation) +
                    " in the logarithm of a ratio: " + join(least->causes);
  } else if (all_singular(round)) {
    result.status = Status::infeasible;
    result.reason =
        "no design with a finite condition number was found within the limits: all that were reached are singular";
  } else {
    result.reason =
        "feasible designs exist, but no start passed the checks of optimality: raise starts or max_evaluations";
  }
}

/// The best design of a round, and whether it has run to a cap of ours.
struct Leader {
  double cap;
  Candidate best;
  bool at_cap;
};

bool runs_to_cap(const Prepared& p, const Candidate& best) {
  const Eigen::VectorXd y = p.coordinates.coordinates(best.variables);
  for (int k = 0; k < p.coordinates.size(); ++k)
    if (p.coordinates.capped_high(k) && p.coordinates.high()[k] - y[k] < 1e-3) return true;
  return false;
}

/// Unbounded: the best design runs to every cap, none is worse than the one before, and together they improve the index.
/// (A variable of no use to the index may run to a cap by chance.)
bool keeps_improving(const std::vector<Leader>& leaders) {
  if (leaders.size() < stretches.size()) return false;
  for (std::size_t k = 0; k < leaders.size(); ++k) {
    if (!leaders[k].at_cap) return false;
    if (k > 0 && leaders[k].best.condition_number > leaders[k - 1].best.condition_number * (1.0 + rounding))
      return false;
  }
  return leaders.back().best.condition_number < leaders.front().best.condition_number * (1.0 - still_improving);
}

/// Variables without a serious bound that grow from cap to cap.
std::vector<std::string> growing(const Problem& problem, const std::vector<Leader>& leaders) {
  std::vector<std::string> names;
  const auto& info = design_family(problem.family).variables();
  for (std::size_t v = 0; v < info.size(); ++v) {
    const auto at = [&](const Leader& l) { return l.best.variables[static_cast<Eigen::Index>(v)]; };
    const Bounds& b = problem.variables[v];
    bool grows = !info[v].is_angle && b.low < b.high && !serious_bound(problem, b.high);
    for (std::size_t k = 1; grows && k < leaders.size(); ++k) grows = at(leaders[k]) > 1.5 * at(leaders[k - 1]);
    if (grows) names.push_back(info[v].name);
  }
  return names;
}

std::string unbounded_reason(const std::vector<Leader>& leaders, const std::vector<std::string>& causes) {
  std::string text = "no least value: it keeps falling as " + join(causes) + " run away (";
  for (const Leader& l : leaders) {
    if (l.cap > leaders.front().cap) text += ", ";
    text += format_number(std::round(l.best.condition_number * 1e6) / 1e6) + " at size " + format_number(l.cap);
  }
  return text + ")";
}

}  // namespace

void Problem::validate() const {
  const auto& info = design_family(family).variables();
  require_positive("characteristic_length", characteristic_length);
  if (variables.size() != info.size())
    throw InvalidArgument("variables", std::to_string(variables.size()) + " bounds",
                          std::to_string(info.size()) + ", one for each variable of " + family);
  for (std::size_t k = 0; k < info.size(); ++k) {
    const Bounds& b = variables[k];
    const std::string text = format_interval(b.low, b.high);
    if (!(b.low <= b.high)) throw InvalidArgument(info[k].name, text, "low <= high, both numbers");
    if (b.low == b.high) require_finite(info[k].name, b.low);
    if (!info[k].is_angle && b.low < 0.0) throw InvalidArgument(info[k].name, text, "a length, low >= 0");
  }
  margins(limits);
  // A design of ordinary size within the bounds must be a robot: says so where both sides of a plate are held at zero.
  std::vector<double> ordinary;
  for (std::size_t k = 0; k < info.size(); ++k)
    ordinary.push_back(std::clamp(info[k].is_angle ? 0.0 : characteristic_length, variables[k].low, variables[k].high));
  design_family(family).geometry(ordinary);
}

void Settings::validate() const {
  if (starts < 1) throw InvalidArgument("starts", std::to_string(starts), "at least 1");
  if (max_evaluations < 1) throw InvalidArgument("max_evaluations", std::to_string(max_evaluations), "at least 1");
}

Result optimize(const Problem& problem, const Settings& settings, const Control& control) {
  problem.validate();
  settings.validate();
  Result result;
  if (const std::string flat = flat_height(problem); !flat.empty()) {
    result.status = Status::infeasible;
    result.causes = {flat};
    result.reason = "0 < zs < zp (eq. 9b) leaves no design: " + flat + " is 0";
    return result;
  }
  const std::vector<double> sizes = caps(problem);
  Progress progress(control, start_count(Prepared(problem, sizes.front()), settings) * static_cast<int>(sizes.size()));
  std::vector<Leader> leaders;
  for (const double cap : sizes) {
    const Prepared p(problem, cap);
    const Round round = run_round(p, settings, control, progress);
    result.evaluations += round.evaluations;
    result.starts_done += round.done;
    std::vector<Candidate> candidates = distinct(p, round);
    if (!candidates.empty()) {
      const Candidate& best = candidates.front();
      leaders.push_back({cap, best, runs_to_cap(p, best)});
      if (result.candidates.empty() || best.condition_number <= result.candidates.front().condition_number)
        result.candidates = std::move(candidates);
    }
    if (control.stop.stop_requested()) {
      result.interrupted = true;
      result.reason =
          "interrupted after " + std::to_string(result.starts_done) + " starts; the best so far is returned";
      return result;
    }
    if (cap == sizes.back() && result.candidates.empty()) explain_failure(p, round, settings, control, result);
  }
  if (result.candidates.empty()) return result;
  result.status = Status::optimal;
  result.reason = "feasible and stationary by our own checks";
  if (keeps_improving(leaders)) {
    result.status = Status::unbounded;
    result.causes = growing(problem, leaders);
    result.reason = unbounded_reason(leaders, result.causes);
  }
  return result;
}

Trace trace(const Problem& problem, const Eigen::VectorXd& start, Formulation formulation, const Settings& settings) {
  problem.validate();
  settings.validate();
  const Prepared p(problem, caps(problem).back());
  if (start.size() != static_cast<Eigen::Index>(problem.variables.size()) || !start.allFinite())
    throw InvalidArgument("start", std::to_string(start.size()) + " values",
                          std::to_string(problem.variables.size()) + " finite ones, one for each variable");
  Trace out;
  const auto observe = [&](const DesignPoint& point, double violation) {
    const double last = out.best.empty() ? std::numeric_limits<double>::infinity() : out.best.back();
    const double now = violation <= clearly_allowed ? std::exp(point.log_condition_number()) : last;
    out.best.push_back(std::min(last, now));
  };
  out.end = minimise(p, p.coordinates.coordinates(start), formulation, settings.max_evaluations, {}, observe).end;
  return out;
}

Eigen::MatrixXd starts(const Problem& problem, const Settings& settings) {
  problem.validate();
  settings.validate();
  const Prepared p(problem, caps(problem).back());
  Eigen::MatrixXd out(static_cast<Eigen::Index>(problem.variables.size()), settings.starts);
  for (int k = 0; k < settings.starts; ++k) out.col(k) = p.coordinates.variables(p.coordinates.start(k, settings.seed));
  return out;
}

}  // namespace ninedof
