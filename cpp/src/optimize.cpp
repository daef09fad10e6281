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

/// Sizes, in characteristic lengths, to which a variable without a serious upper bound is let run, one round each.
constexpr std::array<double, 3> caps{1e2, 1e3, 1e4};
/// A bound beyond this many characteristic lengths is no bound.
constexpr double absurd = 1e6;
/// Relative gain from one cap to the next that counts as still improving.
constexpr double still_improving = 1e-7;

bool is_open(const Problem& p) {
  const auto& info = design_family(p.family).variables();
  for (std::size_t k = 0; k < info.size(); ++k)
    if (!info[k].is_angle && p.variables[k].low != p.variables[k].high &&
        p.variables[k].high >= absurd * p.characteristic_length)
      return true;
  return false;
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
  /// Results of a smaller cap are no bound on those of the next.
  int done() const { return done_; }

 private:
  const Control& control_;
  std::mutex guard_;
  int total_, done_ = 0;
  double best_ = std::numeric_limits<double>::infinity();
};

Round run_round(const Prepared& p, const Settings& s, const Control& control, Progress& progress) {
  const int count = p.coordinates.size() == 0 ? 1 : s.starts;
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

/// Distinct acceptable ends, best first.
std::vector<Candidate> distinct(const Prepared& p, const Round& round) {
  std::vector<Candidate> ends;
  for (const auto& run : round.runs)
    if (run && run->end.feasible() && run->end.stationary()) ends.push_back(run->end);
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

/// No start ended well: is there a feasible design at all? If not, says which limits fight.
void explain_failure(const Prepared& p, const Settings& s, const Control& control, Result& result) {
  std::optional<Candidate> best;
  const int count = std::min(s.starts, 8);
  for (int k = 0; k < count && !control.stop.stop_requested(); ++k) {
    const Run run = least_violation(p, p.coordinates.start(k, s.seed), s.max_evaluations, control.stop);
    result.evaluations += run.evaluations;
    if (!best || run.end.constraint_violation < best->constraint_violation) best = run.end;
    if (best->feasible()) break;
  }
  if (!best || control.stop.stop_requested()) return;
  if (best->feasible()) {
    result.reason =
        "feasible designs exist, but no start passed the checks of optimality: raise starts or max_evaluations";
    return;
  }
  result.status = Status::infeasible;
  result.causes = best->active;
  result.reason = "no design satisfies all limits; at the least violation (" +
                  format_number(best->constraint_violation) +
                  " in the logarithm of a ratio) these bind: " + join(best->active);
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
    if (p.coordinates.capped(k) && p.coordinates.high()[k] - y[k] < 1e-3) return true;
  return false;
}

/// Unbounded: at every cap the best design runs to it, and every wider cap improves the index.
bool keeps_improving(const std::vector<Leader>& leaders) {
  if (leaders.size() < caps.size()) return false;
  for (std::size_t k = 0; k < leaders.size(); ++k) {
    if (!leaders[k].at_cap) return false;
    if (k > 0 && !(leaders[k].best.condition_number < leaders[k - 1].best.condition_number * (1.0 - still_improving)))
      return false;
  }
  return true;
}

/// Variables without a serious bound that grow from cap to cap.
std::vector<std::string> growing(const Problem& problem, const std::vector<Leader>& leaders) {
  std::vector<std::string> names;
  const auto& info = design_family(problem.family).variables();
  for (std::size_t v = 0; v < info.size(); ++v) {
    const auto at = [&](const Leader& l) { return l.best.variables[static_cast<Eigen::Index>(v)]; };
    bool grows = !info[v].is_angle && problem.variables[v].high >= absurd * problem.characteristic_length;
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
  return text + " characteristic lengths)";
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
}

void Settings::validate() const {
  if (starts < 1) throw InvalidArgument("starts", std::to_string(starts), "at least 1");
  if (max_evaluations < 1) throw InvalidArgument("max_evaluations", std::to_string(max_evaluations), "at least 1");
}

Result optimize(const Problem& problem, const Settings& settings, const Control& control) {
  problem.validate();
  settings.validate();
  const bool open = is_open(problem);
  const int rounds = open ? static_cast<int>(caps.size()) : 1;
  Progress progress(control, settings.starts * rounds);
  Result result;
  std::vector<Leader> leaders;
  for (int k = 0; k < rounds; ++k) {
    const double cap = open ? caps[static_cast<std::size_t>(k)] : absurd;
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
    if (k + 1 == rounds && result.candidates.empty()) explain_failure(p, settings, control, result);
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
  const Prepared p(problem, absurd);
  if (start.size() != static_cast<Eigen::Index>(problem.variables.size()) || !start.allFinite())
    throw InvalidArgument("start", std::to_string(start.size()) + " values",
                          std::to_string(problem.variables.size()) + " finite ones, one for each variable");
  Trace out;
  const auto observe = [&](const DesignPoint& point, double violation) {
    const double last = out.best.empty() ? std::numeric_limits<double>::infinity() : out.best.back();
    const double now = violation <= 1e-8 ? std::exp(point.log_condition_number()) : last;
    out.best.push_back(std::min(last, now));
  };
  out.end = minimise(p, p.coordinates.coordinates(start), formulation, settings.max_evaluations, {}, observe).end;
  return out;
}

Eigen::MatrixXd starts(const Problem& problem, const Settings& settings) {
  problem.validate();
  settings.validate();
  const Prepared p(problem, is_open(problem) ? caps.back() : absurd);
  Eigen::MatrixXd out(static_cast<Eigen::Index>(problem.variables.size()), settings.starts);
  for (int k = 0; k < settings.starts; ++k) out.col(k) = p.coordinates.variables(p.coordinates.start(k, settings.seed));
  return out;
}

}  // namespace ninedof
